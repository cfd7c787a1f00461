"""Where the skew is, or has taken to turn: a combined move names it too, and must not call it back."""

from __future__ import annotations

from birdcage.antenna.motion import plan_axis
from birdcage.rotator.axis import Axis
from birdcage.rotator.values import Position

THERE_DEG = 0.1


class SkewGoal:
    """Follows one axis that may turn while the others do."""

    def __init__(self) -> None:
        self._goal_deg: float | None = None
        """Where the skew has taken to turn, and has not been seen yet."""
        self._rests_at = 0.0
        """When it stands still at the latest, there or short of it; monotonic seconds."""

    def forget(self) -> None:
        """It may stand anywhere, and a command for it may not be taken."""
        self._goal_deg = None

    def taken(self, axis: Axis, deg: float, now: float, rate: float) -> None:
        """The dish has taken a command for it."""
        self._goal_deg = deg
        self._rests_at = now + plan_axis(axis, axis.min_deg, axis.max_deg).duration_s / rate

    def see(self, position: Position) -> None:
        """Take in a reading."""
        goal_deg = self._goal_deg
        if goal_deg is not None and position.skew is not None and abs(position.skew - goal_deg) < THERE_DEG:
            self._goal_deg = None

    def to_name(self, position: Position, now: float) -> float | None:
        """Return the angle that a combined move names: one that has stopped short is not driven on. None: unknown."""
        if self._goal_deg is not None and (position.skew is None or now < self._rests_at):
            return self._goal_deg
        return position.skew
