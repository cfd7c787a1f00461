"""Learns how far past its target each axis comes to rest, from readings at rest (decision 0035)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.antenna.motion import AxisMotion, DishMotion
from birdcage.base.geometry import shortest_turn
from birdcage.rotator.values import Position

SETTLED_S = 0.1
"""An axis that should have come to rest so long before it was asked stands."""
LEAST_WAY_DEG = 0.12
"""On a shorter way an axis that stands beyond its last target may really have gone back."""
MOST_DEG = 0.1
"""What lies further off is something else: a command that was not taken, a hand, a reading that was misread."""
ENOUGH = 6
"""So many readings tell something."""
SURE_DEG = 0.008
"""And if their mean is that good: the scatter over the root of the count."""
MOST_COUNTED = 100
"""Later ones count as if there had been so many before: a gear wears."""


@dataclass(slots=True)
class OvershootTally:
    """How far past its target an axis rested, in one direction."""

    count: int = 0
    mean_deg: float = 0.0
    squares: float = 0.0
    """Sum of the squares of what lay off the mean."""

    def take(self, past_deg: float) -> None:
        """Count one reading in."""
        if self.count >= MOST_COUNTED:
            self.squares *= 1.0 - 1.0 / self.count
            self.count -= 1
        self.count += 1
        off = past_deg - self.mean_deg
        self.mean_deg += off / self.count
        self.squares += off * (past_deg - self.mean_deg)

    @property
    def is_sure(self) -> bool:
        """Whether there are enough, and they agree."""
        if self.count < ENOUGH:
            return False
        return math.sqrt(self.squares / (self.count - 1) / self.count) <= SURE_DEG


class OvershootWatch:
    """One reading for each move that the dish has told that it took."""

    def __init__(self) -> None:
        self.tallies: dict[tuple[str, bool], OvershootTally] = {}
        """By name of the axis, and whether it went to a greater angle."""
        self._sure: dict[int, float] = {}
        """When each move began, by motor, of which the dish has told that it took it and no reading was counted yet."""

    def taken(self, motor: int, motion: DishMotion | None) -> None:
        """Take in that the dish has told that it took the last command of a motor."""
        for axis in () if motion is None or motion.silent else (motion.azimuth, motion.elevation):
            if axis.axis.index == motor:
                self._sure[motor] = axis.started

    def see(self, dish: Position, motion: DishMotion, asked_at: float, rate: float) -> None:
        """Take in where the dish stands, that was asked at a monotonic time."""
        for axis, here_deg in ((motion.azimuth, dish.azimuth), (motion.elevation, dish.elevation)):
            if self._sure.get(axis.axis.index) != axis.started:
                continue  # other motion than was commanded: a STOP's, or the other way round
            if asked_at >= axis.started + (axis.slew.duration_s + SETTLED_S) / rate:
                del self._sure[axis.axis.index]
                self._count(axis, here_deg)

    def _count(self, axis: AxisMotion, here_deg: float) -> None:
        way_deg = axis.slew.end_deg - axis.slew.segments[0].position_deg if axis.slew.segments else 0.0
        past_deg = math.copysign(1.0, way_deg) * shortest_turn(axis.slew.end_deg, here_deg)
        if abs(way_deg) >= LEAST_WAY_DEG and abs(past_deg) <= MOST_DEG:
            self.tallies.setdefault((axis.axis.role.value, way_deg > 0.0), OvershootTally()).take(past_deg)
