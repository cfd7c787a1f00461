"""Where a frame's data come from: every feed of the app, begun together, kept up to date, and ended together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from birdcage.station.access import FaceSession

from birdcage_tui.feeds.calibrate_feed import CalibrateFeed
from birdcage_tui.feeds.clock_watch import ClockWatch
from birdcage_tui.feeds.horizon_book import HorizonBook
from birdcage_tui.feeds.map_feed import MapFeed
from birdcage_tui.feeds.preset_book import PresetBook
from birdcage_tui.feeds.ready_watch import ReadyWatch
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.feeds.signal_feed import SignalFeed
from birdcage_tui.feeds.sky_feed import Show, SkyFeed
from birdcage_tui.feeds.system_feeds import SystemFeeds
from birdcage_tui.feeds.track_feed import TrackFeed
from birdcage_tui.shell.motions import Motions
from birdcage_tui.shell.page_stage import PageStage
from birdcage_tui.shown.clock_told import ClockTold
from birdcage_tui.shown.link_book import LinkBook
from birdcage_tui.shown.notes import Notes
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.shown.view import View

Soon = Callable[[Callable[[], None]], None]
"""Does something soon on the app's thread. Any thread."""


class FrameFeeds:
    """Makes the feeds by the settings. `changed` is told on the app's thread; `news`, too, for what a pursuit tells."""

    def __init__(
        self, session: FaceSession, settings: AppOptions, soon: Soon, changed: Callable[[], None], *,
        news: Callable[[], None], show_sky: Show, say: Callable[[str], None], bell: Callable[[], None],
    ) -> None:  # fmt: skip
        self._session, self._settings, self._changed = session, settings, changed
        self.presets = PresetBook(settings.presets_file)
        """Directions with names; read after the first frame."""
        self.horizon = HorizonBook(settings.horizon)
        """The line of trees and roofs."""
        self.sky = SkyFeed(settings.sky, show_sky, lambda words: soon(partial(say, words)))
        self.track = TrackFeed(settings.track, soon, news, bell)
        self.calibrate = CalibrateFeed(settings.calibrate, soon, changed)
        self.clock_watch = ClockWatch(settings.clock_check, lambda told: soon(partial(self.hear_clock, told)))
        self.ready = ReadyWatch(settings.ready, soon, changed, settings.setup_steps)
        self.signals = SignalFeed(settings.signal, session.station, soon, changed, settings.recordings_file,
                                  settings.levels_file)  # fmt: skip
        self.system = SystemFeeds(
            session.station, session.clock, soon, changed, say, backups=settings.backups_folder,
            journal=settings.journal_file,
        )  # fmt: skip
        """What the System page reads and does."""
        self.maps = MapFeed(session.station, session.clock, soon, changed, settings.recordings_file)
        if settings.sound is not None:
            self.signals.sound, self.signals.no_sound = settings.sound()
        self.link_book = LinkBook()
        self.notes = Notes()

    def begin(self, place: SitePlace | None) -> None:
        """Begin what needs a thread or a file; after the first frame."""
        self.sky.begin(self._session.station.state, place, self.horizon.known)
        self.track.begin(place, self.horizon.known)
        self.clock_watch.begin()
        self.ready.begin()
        self.maps.begin()

    def keep(self, place: SitePlace | None) -> None:
        """Tell the feeds what has become of the dish, its place and the horizon there."""
        state = self._session.station.state
        self.sky.keep(state, place, self.horizon.known)
        self.track.keep(place, self.horizon.known, state.feed_name)

    def close(self) -> None:
        """End all of them."""
        for each in (self.signals, self.maps, self.sky, self.track, self.calibrate, self.clock_watch, self.ready):
            each.close()

    def hear_clock(self, told: ClockTold) -> None:
        """Take how good this machine's clock is."""
        self.clock_watch.now = told
        self._changed()

    def is_late(self, *, watched: bool) -> bool:
        """Return whether a dish that is watched owes an answer."""
        clock = self._session.clock
        view = View(
            self._session.station.state, clock.monotonic(), clock.utc(), self._settings, watched=watched
        )  # fmt: skip
        return view.late

    def glance(self, settings: AppOptions, motions: Motions, *, tour: str, tag: str) -> View:
        """Return what a row shows of this dish while another one's pages are seen."""
        clock = self._session.clock
        return View(
            self._session.station.state, clock.monotonic(), clock.utc(), settings, tour=tour, watched=True,
            asked=bool(motions.under_way), track=self.track.now, via=self._session.via,
            detached=self._session.detached, tag=tag,
        )  # fmt: skip

    def frame(
        self, settings: AppOptions, stage: PageStage, motions: Motions, *, tour: str, typing: bool,
        aim: tuple[float, float] | None, tag: str, others: Sequence[View],
    ) -> View:  # fmt: skip
        """Return what one frame shows, now; see `View` for what the shell itself gives to it."""
        clock, crash = self._session.clock, self._session.crash
        return View(
            self._session.station.state,
            clock.monotonic(),
            clock.utc(),
            settings,
            self.signals.book.samples,
            tour,
            "" if crash is None else f"{type(crash).__name__}: {crash}",
            self.notes.last,
            stage.watched,
            tuple(scope.scope for scope in stage.scopes()),
            motions.step_deg,
            asked=bool(motions.under_way),
            typing=typing,
            presets=self.presets.entries,
            aim=aim,
            told=self.notes.told,
            sky=self.sky.now,
            horizon=self.horizon.state,
            clock=self.clock_watch.now,
            track=self.track.now,
            followed=tuple(self.track.looks),
            heard=self.signals.book.heard,
            level=self.signals.book.level_in(self._session.station.state),
            scale=self.signals.scale,
            markers=self.signals.book.markers,
            recorded=self.signals.recorded,
            spectra=tuple(self.signals.book.spectra),
            sweeps=self.signals.sweeps.shown,
            map=self.maps.book.shown,
            map_ended=self.maps.ended_words,
            map_trouble=self.maps.problem,
            sheet=self.system.sheets.now,
            own_settings=self.system.own_settings.now,
            health=self.system.health.now,
            polarisations=self.signals.polarisations.levels,
            signal_trouble=self.signals.trouble,
            trips=self.link_book.trips,
            calibrate=self.calibrate.now,
            ready=self.ready.now,
            setup_steps=self.ready.steps,
            via=self._session.via,
            detached=self._session.detached,
            tag=tag,
            others=others,
        )
