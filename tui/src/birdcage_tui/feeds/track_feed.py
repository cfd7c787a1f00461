"""What the app knows of the pursuit desk: owns it, and hears from it on the app's own thread.

Nothing of the desk is loaded before the first frame, and no call waits: it works on a thread of its own.
"""

from __future__ import annotations

from abc import abstractmethod
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from birdcage.pursuit.now import NO_PLACE
from birdcage.pursuit.orders import PursuitOrders
from birdcage.station.events import Event, Followed, PursuitChanged, TaskChanged
from birdcage.station.pursuit_state import Phase, PointingSample
from birdcage.station.task_state import TaskPhase

from birdcage_tui.shown.unready import NO_LOCATION

if TYPE_CHECKING:
    from birdcage.pursuit.now import DeskNow
    from birdcage.sky.horizon import HorizonMask

    from birdcage_tui.shown.offer import Offer
    from birdcage_tui.shown.options import SitePlace

KEPT_LOOKS = 3600
"""Looks at how well the dish points that are kept: an hour of them."""
ShowTrack = Callable[["DeskNow"], object]
"""Takes what the desk shows, on whichever thread made it."""


class TrackSource(PursuitOrders):
    """The pursuit desk as the app has it: its orders, a beginning and an end. No call waits but `wait`."""

    @abstractmethod
    def start(self) -> None:
        """Begin, on a thread of its own."""

    @abstractmethod
    def keep(self, place: SitePlace | None, horizon: HorizonMask | None = None, feed: str = "") -> None:
        """Take where the dish stands, the horizon there as it is now (None: what the settings said), and its feed."""

    @abstractmethod
    def close(self) -> None:
        """End soon; nothing is told any more. A second time does nothing."""

    @abstractmethod
    def wait(self, timeout_s: float) -> None:
        """Wait until it has left on disk what is to be remembered, where there is such a thing."""


MakeTrack = Callable[[ShowTrack], TrackSource]


def _with_our_keys(now: DeskNow) -> DeskNow:
    """Name the key of this app where the desk names a command that sets the location."""
    if now.problem == NO_PLACE:
        now = replace(now, problem=NO_LOCATION)
    if now.located is not None and now.located.problem == NO_PLACE:
        now = replace(now, located=replace(now.located, problem=NO_LOCATION))
    return now


class TrackFeed:
    """The app's end. `now` is what the desk told last, `looks` how well the dish has pointed in this pursuit."""

    def __init__(self, make: MakeTrack | None, soon: Callable[[Callable[[], None]], object],
                 changed: Callable[[], object], bell: Callable[[], object]) -> None:  # fmt: skip
        self._make, self._soon, self._changed, self._bell = make, soon, changed, bell
        self.source: TrackSource | None = None
        self.now: DeskNow | None = None
        self.looks: deque[PointingSample] = deque(maxlen=KEPT_LOOKS)
        self.offer: Offer | None = None
        """The pass that was picked on F7 last."""
        self._number: int | None = None
        self._phase: Phase | None = None
        self._closed = False

    def begin(self, place: SitePlace | None = None, horizon: HorizonMask | None = None) -> None:
        """Open the desk for where the dish stands; after the first frame."""
        if self._make is not None and not self._closed:
            self.source = self._make(lambda now: self._soon(lambda: self._take(now)))
            self.source.keep(place, horizon)
            self.source.start()

    def _take(self, now: DeskNow) -> None:
        self.now = _with_our_keys(now)
        self._changed()

    def keep(self, place: SitePlace | None, horizon: HorizonMask | None, feed: str) -> None:
        """Take where the dish stands, the horizon there, and the name of its feed."""
        if self.source is not None:
            self.source.keep(place, horizon, feed)

    def set_autotrack(self, on: bool) -> None:
        """Follow what the schedule says, or no longer."""
        if self.source is not None:
            self.source.set_autotrack(on)

    def hear(self, event: Event) -> None:
        """Take an event of the station: keep the looks of this pursuit, and ring when it is about to move by itself."""
        if isinstance(event, PursuitChanged):
            self._begun(event.pursuit.number)
            if event.pursuit.phase is Phase.COUNTDOWN and self._phase is not Phase.COUNTDOWN:
                self._bell()
            self._phase = event.pursuit.phase
        elif isinstance(event, TaskChanged):
            if event.task.phase is TaskPhase.COUNTDOWN and event.task.kind != "pursuit":
                self._bell()
        elif isinstance(event, Followed):
            self._begun(event.number)
            self.looks.append(event.sample)

    def _begun(self, number: int) -> None:
        if number != self._number:
            self._number = number
            self.looks.clear()

    def close(self) -> None:
        """End."""
        self._closed = True
        if self.source is not None:
            self.source.close()

    def wait(self, timeout_s: float) -> None:
        """Wait until what was followed is remembered, after `close`."""
        if self.source is not None:
            self.source.wait(timeout_s)
