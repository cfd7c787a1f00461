"""What the app knows of the calibration: owns it from the first visit of its tab on, and hears from it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future
from typing import TYPE_CHECKING, Protocol

from birdcage_tui.shown.calibration import CalibrateNow

if TYPE_CHECKING:
    from birdcage.calibration.candidates import CalibrationObject
    from birdcage.calibration.peak import MeasuredPeak


ABSENT = "This app has no file for calibrations. Use `birdcage calibrate` in a terminal."
Show = Callable[[CalibrateNow], object]
"""Takes what is to be shown, on whichever thread made it."""


class CalibrateSource(Protocol):
    """The guide on a thread of its own. No call waits; what came of it is told later."""

    def start(self) -> None:
        """Begin."""

    def look(self) -> None:
        """Somebody looks at it now: it is kept fresh for some seconds."""

    def go(self, candidate: CalibrationObject | None, done: Future[object]) -> None:
        """Turn the dish to an object; None: to the present one, as it moves on. `done` at the end of the way."""

    def nudge(self, right_deg: float, up_deg: float, done: Future[object]) -> None:
        """Step so far on the sky. `done` at the end of the way."""

    def find(self, source: str, done: Future[object]) -> None:
        """Have the station find the peak by that source of the signal, and save it. `done` at the end of the way."""

    def take(self) -> None:
        """Peaked here."""

    def put(self, peaks: Sequence[MeasuredPeak]) -> None:
        """Save peaks that were measured elsewhere, as on a map of the sky."""

    def remove(self, *numbers: int) -> None:
        """Forget peaks, all of them without a number."""

    def undo(self) -> None:
        """Bring back what was forgotten last."""

    def apply(self, name: str) -> None:
        """Keep the fit under a name, and point by it."""

    def use(self, name: str) -> None:
        """Point by a set that was kept before."""

    def refresh(self) -> None:
        """Find out again what is best to peak on."""

    def close(self) -> None:
        """End soon; nothing is told any more."""


MakeCalibrate = Callable[[Show], CalibrateSource]


class CalibrateFeed:
    """The app's end. `now` is what was told last; None before the tab was visited."""

    def __init__(self, make: MakeCalibrate | None, soon: Callable[[Callable[[], None]], object],
                 changed: Callable[[], object]) -> None:  # fmt: skip
        self._make, self._soon, self._changed = make, soon, changed
        self.source: CalibrateSource | None = None
        self.now: CalibrateNow | None = None
        self._closed = False

    def open(self) -> None:
        """Open the guide, once."""
        if self._make is None:
            self.now = CalibrateNow(wrong=ABSENT)
        elif self.source is None and not self._closed:
            self.now = CalibrateNow(searching=True)
            self.source = self._make(lambda now: self._soon(lambda: self._take(now)))
            self.source.start()

    def _take(self, now: CalibrateNow) -> None:
        if now != self.now:
            self.now = now
            self._changed()

    def close(self) -> None:
        """End."""
        self._closed = True
        if self.source is not None:
            self.source.close()
