"""The guide of the calibration on a thread of its own: what it computes takes some tenths of a second."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError, ConfigError

from birdcage_tui.shown.calibration import CalibrateNow, KeptSet
from birdcage_tui.shown.unready import NO_LOCATION
from birdcage_tui.shown.view import YOU

if TYPE_CHECKING:
    from birdcage.base.config import Settings
    from birdcage.base.paths import Paths
    from birdcage.calibration.candidates import CalibrationObject
    from birdcage.calibration.guide import Guide
    from birdcage.calibration.peak import MeasuredPeak
    from birdcage.sky.targets.model import Target
    from birdcage.station.access import FaceSession

    from birdcage_tui.feeds.calibrate_feed import MakeCalibrate, Show

TICK_S = 0.1
SHOW_S = 0.5
"""Between two looks at where the dish and its object are."""
UNSEEN_S = 3.0
"""So long after the last look at the tab nothing is computed any more, unless something is under way."""
PROPOSE_S = 120.0
"""After so long Sun and Moon have moved on enough to look again what is best."""
LEAST_ENOUGH = 3
"""With fewer peaks the tilt is not known, whatever another one is worth."""
Deed = Callable[["Guide"], str]
"""Does something, and says what it did."""


def make_calibrate(session: FaceSession, load: Callable[[], Settings], paths: Paths, *,
                   environ: Mapping[str, str] | None = None, flags: Mapping[str, object] | None = None,
                   threads: bool = True) -> MakeCalibrate:  # fmt: skip
    """Return what opens the calibration of a session; `load` reads the settings. `threads=False`: a test steps it."""

    def make(show: Show) -> GuideDesk:
        def open_guide(settings: Settings) -> Guide:
            from birdcage.calibration.guide import Guide

            return Guide(session, settings, paths, environ=environ, flags=flags, holder=YOU, watch=False,
                         over_pursuit=True)  # fmt: skip

        return GuideDesk(open_guide, load, session, paths, show, threads=threads)

    return make


class GuideDesk:
    """The `CalibrateSource` of a running app. Everything but `look` and the orders runs on its own thread."""

    def __init__(self, open_guide: Callable[[Settings], Guide], load: Callable[[], Settings], session: FaceSession,
                 paths: Paths, show: Show, *, threads: bool) -> None:  # fmt: skip
        self._open_guide, self._load, self._paths, self._show = open_guide, load, paths, show
        self._clock, self._threads = session.clock, threads
        self._orders: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._looked_at = self._clock.monotonic()
        self._guide: Guide | None = None
        self._target: Target | None = None
        self._ways: list[Future[object]] = []
        self._removed: list[tuple[MeasuredPeak, ...]] = []
        self._told = self._wrong = ""
        self._stale = True
        """Whether what is proposed does not fit the peaks any more."""
        self._proposed_at = self._shown_at = float("-inf")
        self._closed = threading.Event()

    # For the app's thread.

    def start(self) -> None:
        """Begin."""
        self._orders.put(self._arrive)
        if self._threads:
            threading.Thread(target=self._work, name="calibration", daemon=True).start()

    def look(self) -> None:
        """Keep it fresh; after a while unseen the settings may be others, which the setup has changed."""
        now = self._clock.monotonic()
        if now - self._looked_at > UNSEEN_S:
            self._orders.put(self._arrive)
        self._looked_at = now

    def go(self, candidate: CalibrationObject | None, done: Future[object]) -> None:
        """Turn the dish to an object."""

        def deed(guide: Guide) -> str:
            if candidate is not None:
                self._target = candidate.target
            guide.go(candidate)
            return ""

        self._move(deed, done)

    def nudge(self, right_deg: float, up_deg: float, done: Future[object]) -> None:
        """Step so far on the sky."""

        def deed(guide: Guide) -> str:
            guide.nudge(right_deg, up_deg)
            return ""

        self._move(deed, done)

    def find(self, source: str, done: Future[object]) -> None:
        """Have the station find the peak by that source of the signal, and save it."""

        def deed(guide: Guide) -> str:
            guide.find_peak(source)
            return ""

        self._move(deed, done)

    def take(self) -> None:
        """Peaked here."""

        def deed(guide: Guide) -> str:
            peak = guide.take()
            self._stale = True
            return f"Peak {peak.number} saved, ±{peak.sigma_deg:.2f}°."

        self._order(deed)

    def put(self, peaks: Sequence[MeasuredPeak]) -> None:
        """Save peaks that were measured elsewhere, as on a map of the sky."""

        def deed(guide: Guide) -> str:
            kept = [guide.put_back(peak) for peak in peaks]
            self._stale = True
            return f"Saved {len(kept)} peaks of the map, {kept[0].number} to {kept[-1].number}." if kept else ""

        self._order(deed)

    def remove(self, *numbers: int) -> None:
        """Forget peaks, all of them without a number."""

        def deed(guide: Guide) -> str:
            gone = tuple(peak for peak in guide.peaks if not numbers or peak.number in numbers)
            guide.remove(*numbers)
            self._removed.append(gone)
            self._stale = True
            what = f"peak {gone[0].number} ({gone[0].target})" if len(gone) == 1 else f"{len(gone)} peaks"
            return f"Deleted {what}. u: restore."

        self._order(deed)

    def undo(self) -> None:
        """Bring back what was forgotten last."""

        def deed(guide: Guide) -> str:
            if not self._removed:
                return "No deleted peaks."
            kept = [guide.put_back(peak) for peak in self._removed[-1]]
            self._removed.pop()
            self._stale = True
            return f"Restored as {', '.join(str(peak.number) for peak in kept)}."

        self._order(deed)

    def apply(self, name: str) -> None:
        """Keep the fit under a name, and point by it."""
        self._order(lambda guide: f"Saved {guide.apply(name).name}. The dish uses it now.")

    def use(self, name: str) -> None:
        """Point by a set that was kept before."""
        self._order(lambda guide: f"The dish uses {guide.use(name).name} now.")

    def refresh(self) -> None:
        """Find out again what is best to peak on, by the settings as they are now."""
        self._orders.put(self._arrive)

        def deed(_guide: Guide) -> str:
            self._stale = True
            return ""

        self._order(deed)

    def close(self) -> None:
        """End."""
        self._closed.set()
        self._orders.put(None)

    def _order(self, deed: Deed) -> None:
        self._orders.put(lambda: self._do(deed))

    def _move(self, deed: Deed, done: Future[object]) -> None:
        def order() -> None:
            self._ways.append(done)
            self._do(deed)

        self._orders.put(order)

    # For its own thread.

    def step(self) -> None:
        """Do what there is to do now, on the calling thread."""
        while not self._orders.empty():
            order = self._orders.get()
            if order is not None:
                order()
        self._go_on()

    def _work(self) -> None:
        while not self._closed.is_set():
            try:
                order = self._orders.get(timeout=TICK_S)
            except queue.Empty:
                order = self._go_on
            if order is not None:
                order()

    def _arrive(self) -> None:
        """Open the guide, or open it anew where the settings are others than those that it knows."""

        def deed() -> None:
            settings = self._load()
            if self._guide is None or (settings != self._guide.settings and not self._ways):
                self._guide = self._open_guide(settings)
                if self._target is not None:
                    self._guide.choose(self._target)
                self._stale = True

        self._try(deed)

    def _do(self, deed: Deed) -> None:
        guide = self._guide
        if guide is None:
            self._end_ways()
            return  # why it could not be opened is told already
        self._told = ""

        def told() -> None:
            self._told = deed(guide)

        self._try(told)
        self._go_on()
        self._tell()

    def _try(self, deed: Callable[[], None]) -> None:
        self._wrong = ""
        try:
            deed()
        except BirdcageError as error:
            self._wrong = str(error)

    def _go_on(self) -> None:
        guide = self._guide
        now = self._clock.monotonic()
        if guide is not None:
            guide.tick()
            peak = guide.take_found()
            if peak is not None:
                self._told, self._stale = f"Peak {peak.number} found and saved, ±{peak.sigma_deg:.2f}°.", True
            if not guide.busy and self._ways:
                self._end_ways()
                self._shown_at = float("-inf")
        if now - self._looked_at > UNSEEN_S and not self._ways:
            return
        if guide is not None and (self._stale or now - self._proposed_at > PROPOSE_S):
            self._tell(searching=True)
            self._stale, self._proposed_at = False, now
            wrong = self._wrong
            self._try(lambda: self._refresh(guide))
            self._wrong = self._wrong or wrong
            self._tell()
        elif now - self._shown_at >= SHOW_S:
            self._tell()

    def _end_ways(self) -> None:
        for way in self._ways:
            way.set_result(None)
        self._ways.clear()

    @staticmethod
    def _refresh(guide: Guide) -> None:
        here = guide.settings.place
        if here.latitude_deg is None or here.longitude_deg is None:
            raise ConfigError(NO_LOCATION)  # the driver's own words name a command, not the key of this app
        guide.refresh()

    def _tell(self, *, searching: bool = False) -> None:
        from birdcage.base.alignments import is_in_force, load_sets
        from birdcage.calibration.next_best import enough

        self._shown_at = self._clock.monotonic()
        if self._closed.is_set():
            return
        guide = self._guide
        if guide is None:
            self._show(CalibrateNow(wrong=self._wrong))
            return
        try:
            view = guide.view()
        except BirdcageError as error:
            self._show(CalibrateNow(wrong=str(error)))
            return
        kept, in_use = load_sets(self._paths.alignments_file), guide.settings.alignment
        self._show(CalibrateNow(
            view,
            tuple(KeptSet(each, is_in_force(each, in_use)) for each in kept.entries),
            self._told,
            self._wrong or view.failure or next(iter((*guide.problems, *kept.problems)), ""),
            sum(map(len, self._removed[-1:])),
            searching,
            not searching and len(view.peaks) >= LEAST_ENOUGH and enough(view.proposals),
        ))  # fmt: skip
