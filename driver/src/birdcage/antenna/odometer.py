"""How far each axis was sent: what wears gears, motors and cables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.antenna.motion import AxisMotion, DishMotion


@dataclass(frozen=True, slots=True)
class AxisWay:
    """One command of one axis: by how much its target was moved on, in degrees; negative is back."""

    axis: int
    deg: float


class Odometer:
    """Tells the way of each axis in every motion that the dish has taken. A STOP on the way is not taken off."""

    def __init__(self) -> None:
        self.on_way: Callable[[AxisWay], None] = lambda _way: None

    def take(self, before: DishMotion | None, now: DishMotion) -> None:
        """Take in that the dish has taken `now` instead of what it did before."""
        old = (None, None, None) if before is None else (before.azimuth, before.elevation, before.skew)
        for earlier, later in zip(old, (now.azimuth, now.elevation, now.skew), strict=True):
            if later is not None and later is not earlier and later.slew.segments:
                self.on_way(AxisWay(later.axis.index, _way_deg(earlier, later)))


def _way_deg(earlier: AxisMotion | None, later: AxisMotion) -> float:
    start_deg = later.slew.segments[0].position_deg
    if earlier is not None and earlier.slew.segments and later.streamed:
        start_deg = earlier.slew.end_deg  # on one unrolled scale: what is left of it is counted already
    return later.slew.end_deg - start_deg
