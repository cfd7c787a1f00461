"""Watches the sky for the app: `SkyWatch` behind values that panes draw, and a thread for files and the Moon.

The catalogue is opened by whoever asks on the thread that asks; the app's own thread never waits for any of it.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path as File
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.errors import BirdcageError
from birdcage.base.paths import Paths
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.observer import Observer
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.watch import SkyWatch
from birdcage.sky.watch_model import SkyNow
from birdcage.station.reach_limits import reach_limits_of

from birdcage_tui.feeds.demo_radio import lay_beacons
from birdcage_tui.feeds.demo_sky import lay_demo_sky
from birdcage_tui.feeds.sky_convert import Converter
from birdcage_tui.feeds.sky_hearing import heard_by, hearing_of, naming_of, tuning_of
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.sky_picture import DopplerFrequency, ShownPass

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.sky.export.fields import Heard
    from birdcage.station.state import StationState

    from birdcage_tui.feeds.sky_feed import Say, Show, ShowWorld, TellAdded
    from birdcage_tui.feeds.world_ask import Ask

MOON_S = 20.0
"""Seconds of the clock between two looks at the Moon: it goes a tenth of a degree in that."""
MOON_FIRST_S = 3.0
"""Real seconds after the start before the library that knows it is loaded: the passes come first."""


@dataclass(frozen=True, slots=True)
class SkySetup:
    """What a sky is made from."""

    catalogue: File
    exports: File
    """The folder that files of passes go to."""
    clock: Clock
    observer: Observer | None
    limits: Callable[[StationState], ReachLimits]
    demo: bool = False
    feed: str = ""
    """The name of the feed in use."""
    feed_is_set: bool = False
    """Whether the user has said which one that is."""
    hearing: Callable[[], Callable[[int, str], str] | None] | None = None
    """Reads what the feed hears; takes some milliseconds."""
    tuning: Callable[[], Callable[[int, str], DopplerFrequency | None]] | None = None
    """Reads at which frequency Doppler is told; takes some milliseconds."""
    naming: Callable[[], Callable[[int, str], tuple[str, ...]]] | None = None
    """Reads what else satellites are called; takes some milliseconds."""
    heard: Callable[[], Heard] | None = None
    """Reads which downlink of a satellite the feed listens to; takes some milliseconds."""


class WatchedSky:
    """The `SkySource` of a running app. With `threads=False` a test calls `step` instead."""

    def __init__(self, setup: SkySetup, show: Show, say: Say, *, threads: bool = True) -> None:
        self._setup, self._show, self._say = setup, show, say
        self._threads = threads
        self._observer = setup.observer
        self._limits: ReachLimits | None = None
        self._watch = SkyWatch(setup.catalogue, self._seen, setup.clock, observer=setup.observer, apart=threads)
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._converter = Converter()
        self._converter.feed, self._converter.hear_first = setup.feed, setup.feed_is_set
        self._sky: SkyNow | None = None
        self._moon: tuple[float, float, float] | None = None
        """When it was looked at, azimuth, elevation."""
        self._closed = threading.Event()
        self._lock = threading.Lock()
        """Over the converter: every thread but the app's shows the sky again after a change."""

    # For the app's thread.

    def start(self) -> None:
        """Begin."""
        if self._setup.demo:
            self._jobs.put(self._fill_catalogue)
        if self._threads:
            self._jobs.put(self._watch.start)
        if self._setup.demo:
            self._jobs.put(self._lay_beacons)  # they are the last thing that anybody waits for
        if self._threads:
            threading.Thread(target=self._work, name="sky-desk", daemon=True).start()
            threading.Thread(target=self._follow_moon, name="moon", daemon=True).start()

    def keep(self, state: StationState, place: SitePlace | None, horizon: HorizonMask | None = None) -> None:
        """Take what is known of the dish, where it stands, and the horizon there (None: the settings')."""
        limits = self._setup.limits(state)
        if horizon is not None:
            limits = replace(limits, horizon=horizon if horizon.is_line else None)
        if limits != self._limits:
            self._limits = limits
            self._converter.mask = limits.horizon
            self._watch.set_limits(limits)
        if place is not None:
            here, there = self._observer, (place.latitude_deg, place.longitude_deg)
            if here is None or (here.latitude_deg, here.longitude_deg) != there:
                self._observer = Observer(place.latitude_deg, place.longitude_deg, name=place.name)
                self._watch.set_observer(self._observer)

    def set_favourite(self, satellite: int | str, favourite: bool) -> None:
        """Mark or unmark a satellite: seen at once, and kept in the catalogue."""
        self._converter.favourites[satellite] = favourite
        self._jobs.put(self._show_again)
        self._jobs.put(lambda: self._keep_favourite(satellite, favourite))

    def export(self, rows: Sequence[ShownPass]) -> None:
        """Write passes to files, and tell where."""
        self._jobs.put(lambda: self._write(tuple(rows)))

    def look_down(self, ask: Ask, show: ShowWorld) -> None:
        """Work out what a map of the world shows, and show it."""
        self._jobs.put(lambda: self._look_down(ask, show))

    def add_elements(self, typed: str, tell: TellAdded) -> None:
        """Take elements into the catalogue; their passes are searched at once."""
        self._jobs.put(lambda: self._add_elements(typed, tell))

    def close(self) -> None:
        """End."""
        self._closed.set()
        self._jobs.put(None)
        self._watch.close(0.0)

    def step(self) -> None:
        """Do all that is to do now, on the calling thread."""
        while not self._jobs.empty():
            job = self._jobs.get()
            if job is not None:
                job()
        now = self._setup.clock.monotonic()
        for _ in range(10_000):
            if self._watch.step() > now:
                break

    # For the other threads.

    def _work(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()

    def _seen(self, sky: SkyNow) -> None:
        """Show a look at the sky; on the watch's thread."""
        before, self._sky = self._sky, sky
        if before is None or before.satellites != sky.satellites:
            self._jobs.put(self._read_groups)
        self._show_again()

    def _show_again(self) -> None:
        sky = self._sky
        if sky is not None and not self._closed.is_set():
            with self._lock:
                self._show(self._converter.picture(sky, self._moon, demo=self._setup.demo))

    def _follow_moon(self) -> None:
        if self._closed.wait(MOON_FIRST_S):
            return
        while not self._closed.is_set():
            self.look_at_moon()
            if self._closed.wait(MOON_S / self._setup.clock.rate):
                return

    def look_at_moon(self) -> None:
        """Look where the Moon stands; outside the years of the ephemeris it is not drawn."""
        from birdcage.sky.ephemeris.bodies import BODIES

        observer, now = self._observer, self._setup.clock.utc()
        if observer is None:
            return
        try:
            look = BODIES["moon"].look(observer, now)
        except BirdcageError:
            self._moon = None
            return
        self._moon = (now.timestamp(), look.az_deg, look.el_deg)

    def _fill_catalogue(self) -> None:
        """Lay the demo's orbits over its place."""
        lay_demo_sky(self._setup.catalogue, self._setup.clock.utc(), self._observer)

    def _lay_beacons(self) -> None:
        """Lay what the demo's receiver hears of them."""
        lay_beacons(self._setup.catalogue, self._setup.clock.utc(), self._observer)

    def _read_groups(self) -> None:
        """Read which groups and tags satellites have, and what the feed hears, to filter by."""
        from birdcage.sky.catalogue import Catalogue

        if self._setup.hearing is not None and self._converter.hears is None:
            self._converter.hears = self._setup.hearing()
        if self._setup.tuning is not None and self._converter.tuned is None:
            self._converter.tuned = self._setup.tuning()
        if self._setup.naming is not None and self._converter.also is None:
            self._converter.also = self._setup.naming()
        if not self._setup.catalogue.exists():
            return
        try:
            with Catalogue(self._setup.catalogue) as catalogue:
                entries = catalogue.entries()
        except BirdcageError:
            return  # the watch says so, with what to do
        self._converter.groups = {one.key: (*one.groups, *one.tags) for one in entries if one.groups or one.tags}
        self._show_again()

    def _keep_favourite(self, satellite: int | str, favourite: bool) -> None:
        from birdcage.sky.catalogue import Catalogue

        try:
            with Catalogue(self._setup.catalogue) as catalogue:
                catalogue.set_favourite(satellite, favourite)
        except BirdcageError as problem:
            self._converter.favourites.pop(satellite, None)
            self._show_again()
            self._say(f"The favourite was not saved. {problem}")
            return
        self._watch.refresh()

    def _add_elements(self, typed: str, tell: TellAdded) -> None:
        from birdcage_tui.feeds.sky_add import AddOutcome, add_elements

        try:
            added = add_elements(self._setup.catalogue, typed)
        except BirdcageError as problem:
            added = AddOutcome(str(problem), whole=False)
        self._watch.refresh()
        tell(added)

    def _look_down(self, ask: Ask, show: ShowWorld) -> None:
        from birdcage_tui.feeds.world_ask import world_of

        if not self._closed.is_set():
            show(world_of(ask, self._observer))

    def _write(self, rows: tuple[ShownPass, ...]) -> None:
        from birdcage_tui.feeds.pass_files import write_passes

        found = [row.found for row in rows]
        sky = self._sky
        if sky is None or sky.observer is None or not found:
            self._say("No passes to export. No file was written.")
            return
        note = "DEMO: these orbits are made up." if self._setup.demo else sky.note
        try:
            heard = None if self._setup.heard is None else self._setup.heard()
            words = write_passes(found, sky.observer, self._setup.clock.utc(), self._setup.exports, note, heard)
        except OSError as problem:
            words = f"Cannot write to {self._setup.exports}: {problem.strerror or problem}."
        self._say(words)


def open_sky(
    settings: Settings, paths: Paths, clock: Clock, show: Show, say: Say, *, demo: bool, threads: bool
) -> WatchedSky:
    """Return the sky by the settings; files of passes go beside the catalogue."""
    place = settings.place
    observer = None
    if place.latitude_deg is not None and place.longitude_deg is not None:
        observer = Observer(place.latitude_deg, place.longitude_deg, place.height_m, place.name or "")
    setup = SkySetup(
        paths.catalogue, paths.catalogue.parent / "passes", clock, observer,
        lambda state: reach_limits_of(state, settings), demo,
        settings.feed.active, "feed.active" in settings.sources,
        lambda: hearing_of(settings.active_feed, paths.downlinks_file, clock.utc()),
        lambda: tuning_of(settings.active_feed, paths.downlinks_file, clock.utc()),
        lambda: naming_of(paths.downlinks_file),
        lambda: heard_by(settings.active_feed, paths.downlinks_file),
    )  # fmt: skip
    return WatchedSky(setup, show, say, threads=threads)
