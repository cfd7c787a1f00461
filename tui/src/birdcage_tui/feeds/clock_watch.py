"""Checks this machine's clock now and then, on a thread of its own: asking the system takes up to four seconds."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage_tui.shown.clock_told import ClockTold, clock_scaled, clock_told

if TYPE_CHECKING:
    from birdcage.base.clock import Clock
    from birdcage.base.paths import Paths

FIRST_S = 0.5
"""After the first frame: the dish comes first."""
AGAIN_S = 600.0

Check = Callable[[], ClockTold]
"""Finds out how good the clock is; may take some seconds."""


def make_check(clock: Clock, paths: Paths) -> Check:
    """Return how the clock of a running app is checked."""

    def check() -> ClockTold:
        from birdcage.gps.clock_check import check_clock

        return clock_told(check_clock(clock.utc(), paths.state))

    return check if clock.rate == 1.0 else lambda: clock_scaled(clock.rate)


class ClockWatch:
    """`now` is what was found last; None before."""

    def __init__(self, check: Check | None, show: Callable[[ClockTold], object]) -> None:
        self._check, self._show = check, show
        self._closed = threading.Event()
        self.now: ClockTold | None = None

    def begin(self) -> None:
        """Begin to check; after the first frame."""
        if self._check is not None:
            threading.Thread(target=self._work, args=(self._check,), name="clock-check", daemon=True).start()

    def close(self) -> None:
        """Check no more. A check that is under way ends by itself, unheard."""
        self._closed.set()

    def _work(self, check: Check) -> None:
        wait_s = FIRST_S
        while not self._closed.wait(wait_s):
            found = check()
            if not self._closed.is_set():
                self._show(found)
            wait_s = AGAIN_S
