"""A line of trees around a simulated dish: it hides what stands behind it, and is as warm as the ground."""

from __future__ import annotations

import math
from itertools import pairwise

from birdcage.base.geometry import wrap_360
from birdcage.sim.beam import COMPRESSION, MEASURED_IN, gain

TREES_K = 280.0
"""How much warmer trees are than the sky that they hide: some 290 K against 10 (assumed)."""
NOTHING = -90.0
EDGE = 6
"""The beam is looked at on a grid of so many points to each side of its middle."""


class TreeLine:
    """Points of true azimuth and elevation, straight lines between them, and no trees beyond the first and last.

    Written `150:5,160:22,190:22`, from left to right: an azimuth that is less than the one before lies beyond north.
    """

    def __init__(self, text: str, reflector_in: tuple[float, float] = MEASURED_IN) -> None:
        """Raise ValueError, with a sentence, for a text that is no such line."""
        self._points = _read(text)
        self._highest = max((el_deg for _az_deg, el_deg in self._points), default=NOTHING)
        right, up = (MEASURED_IN[axis] / reflector_in[axis] for axis in (0, 1))
        steps = range(-EDGE, EDGE + 1)
        looks = [(x * right, y * up, _power(x * right, y * up, reflector_in)) for x in steps for y in steps]
        whole = math.fsum(power for _right, _up, power in looks)
        self._looks = [(x, y, power / whole) for x, y, power in looks if power > 0.0]
        self._reach_deg = EDGE * up

    def at(self, az_deg: float) -> float:
        """Return up to which elevation trees stand there; `NOTHING` where there are none."""
        if not self._points:
            return NOTHING
        az_deg = self._points[0][0] + wrap_360(az_deg - self._points[0][0])
        for (left, low), (right, high) in pairwise(self._points):
            if left <= az_deg <= right:
                return low + (high - low) * (az_deg - left) / (right - left)
        return NOTHING

    def hides(self, az_deg: float, el_deg: float) -> bool:
        """Return whether trees stand before what is in that direction."""
        return el_deg <= self.at(az_deg)

    def kelvins(self, az_deg: float, el_deg: float) -> float:
        """Return how much warmer they make what a beam hears that looks there."""
        if el_deg - self._reach_deg > self._highest:
            return 0.0
        level = math.cos(math.radians(el_deg))
        return TREES_K * math.fsum(
            share for right, up, share in self._looks if self.hides(az_deg + right / level, el_deg + up)
        )


def _power(right_deg: float, up_deg: float, reflector_in: tuple[float, float]) -> float:
    return math.pow(max(gain(right_deg, up_deg, reflector_in), 0.0), COMPRESSION)


def _read(text: str) -> list[tuple[float, float]]:
    points: list[tuple[float, float]] = []
    for each in filter(None, text.split(",")):
        try:
            az_deg, el_deg = map(float, each.split(":"))
        except ValueError:
            raise ValueError(f"trees={text}: write azimuth:elevation, as 150:5,160:22") from None
        if points:
            az_deg = points[-1][0] + wrap_360(az_deg - points[-1][0])
        if not abs(el_deg) <= 80.0 or not math.isfinite(az_deg) or (points and az_deg - points[0][0] > 360.0):
            raise ValueError(f"trees={text}: elevations lie from -80 to 80, azimuths within one turn")
        points.append((az_deg, el_deg))
    if len(points) == 1:
        raise ValueError(f"trees={text}: a line of trees has two points")
    return points
