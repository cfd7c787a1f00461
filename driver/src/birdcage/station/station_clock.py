"""The clock of a station in another program."""

from __future__ import annotations

from birdcage.base.clock import RealClock

SAME_CLOCK_S = 0.005
"""Two clocks that agree within this, and within the time that asking takes, are one."""


class StationClock(RealClock):
    """The monotonic clock of another program, by this one's: on one machine both are the same, as a rule."""

    def __init__(self) -> None:
        self.ahead_s = 0.0
        """How far that clock is ahead of ours."""

    def meet(self, at: float, asked: float, heard: float) -> None:
        """Take in that it showed `at` at a moment between `asked` and `heard` of ours."""
        is_same = asked - SAME_CLOCK_S <= at <= heard + SAME_CLOCK_S
        self.ahead_s = 0.0 if is_same else at - (asked + heard) / 2.0

    def monotonic(self) -> float:
        """Return seconds as that program counts them."""
        return super().monotonic() + self.ahead_s
