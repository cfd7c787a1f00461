"""The line of trees, roofs and hills: below it nothing is heard. It never refuses a motion."""

from __future__ import annotations

import bisect
import math
from collections.abc import Iterable, Sequence
from functools import cached_property

from birdcage.base.geometry import wrap_360

SAME_AZ_DEG = 0.05
"""Two points closer than this are one that was measured again."""


class HorizonMask:
    """Points in true degrees, straight lines between them, all the way round; at one azimuth only, flat at 0.

    Immutable. Azimuths are folded into [0, 360) and sorted. Two points at one azimuth make a step, as the edge of a
    wall is: at the edge itself the higher one counts.
    """

    def __init__(self, points: Iterable[tuple[float, float]] = ()) -> None:
        """Take points as (az_deg, el_deg). ValueError for one that is none (elevation -90 to 90)."""
        folded = []
        for az_deg, el_deg in points:
            if not (math.isfinite(az_deg) and math.isfinite(el_deg) and abs(el_deg) <= 90.0):
                raise ValueError(f"no point of a horizon: azimuth {az_deg}, elevation {el_deg}")
            folded.append((wrap_360(az_deg), float(el_deg)))
        # A stable sort by azimuth alone: the order of the two ends of a step says which side is the wall.
        folded.sort(key=lambda point: point[0])
        self._points = tuple(folded)

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """All points, sorted by azimuth."""
        return self._points

    def __bool__(self) -> bool:
        """Return whether a point is kept; see `is_line`."""
        return bool(self._points)

    @cached_property
    def is_line(self) -> bool:
        """Whether there are points at two azimuths or more: one point alone says nothing of the rest."""
        return any(_apart(each[0], self._points[0][0]) > SAME_AZ_DEG for each in self._points[1:])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, HorizonMask) and self._points == other._points

    def __hash__(self) -> int:
        return hash(self._points)

    def __repr__(self) -> str:
        return f"HorizonMask({list(self._points)})"

    def at(self, az_deg: float) -> float:
        """Return the lowest elevation that is free at an azimuth (any number of turns), in degrees."""
        if not self.is_line:
            return 0.0
        az_deg = wrap_360(az_deg)
        azimuths, elevations = self._round
        index = bisect.bisect_left(azimuths, az_deg)
        here = [elevations[k] for k in range(index, len(azimuths)) if azimuths[k] == az_deg]
        if here:
            return max(here)
        low, high = index - 1, index
        share = (az_deg - azimuths[low]) / (azimuths[high] - azimuths[low])
        return elevations[low] + share * (elevations[high] - elevations[low])

    def insert(self, az_deg: float, el_deg: float) -> HorizonMask:
        """Return a mask with one more point: a point at the same azimuth was measured again and is replaced."""
        az_deg = wrap_360(az_deg)
        kept = [point for point in self._points if _apart(point[0], az_deg) > SAME_AZ_DEG]
        return HorizonMask([*kept, (az_deg, el_deg)])

    def remove(self, az_deg: float) -> HorizonMask:
        """Return a mask without the point nearest to an azimuth. LookupError when there is none within 1 degree."""
        near = min(self._points, key=lambda point: _apart(point[0], az_deg), default=None)
        if near is None or _apart(near[0], az_deg) > 1.0:
            raise LookupError(f"There is no point of the horizon within 1° of {az_deg:g}°.")
        return HorizonMask([point for point in self._points if point != near])

    @cached_property
    def _round(self) -> tuple[list[float], list[float]]:
        """Azimuths and elevations with the last point before north and the first one after a whole turn."""
        first, last = self._points[0], self._points[-1]
        points = [(last[0] - 360.0, last[1]), *self._points, (first[0] + 360.0, first[1])]
        return [each[0] for each in points], [each[1] for each in points]


def _apart(one_deg: float, other_deg: float) -> float:
    return abs((one_deg - other_deg + 180.0) % 360.0 - 180.0)


def horizon_words(points: Sequence[tuple[float, float]]) -> str:
    """Return a horizon in a few words."""
    if not points:
        return "flat horizon"
    if not HorizonMask(points).is_line:
        return f"flat horizon: a line needs a second point, not at {points[0][0]:.0f}°"
    az_deg, el_deg = max(points, key=lambda point: point[1])
    return f"horizon of {len(points)} points, up to {el_deg:.1f}° at {az_deg:.0f}°"
