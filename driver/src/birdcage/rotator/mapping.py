"""Between the axes of a machine that has no azimuth and elevation of its own, and the sky.

`docs/decisions/0047-axes-and-mappings.md`.
"""

from __future__ import annotations

import itertools
import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from operator import itemgetter
from typing import Protocol

from birdcage.base.errors import CommandRefused
from birdcage.base.geometry import separation, shortest_turn, wrap_360
from birdcage.base.reason import Reason
from birdcage.rotator.axis import Axis, Role

_ROUGH_DEG = 2.0
"""How far apart the points of an arc are among which the nearest one is looked for first."""
_FINE_DEG = 1e-5
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
_SPAN_STEPS = {1: 720, 2: 60, 3: 12}
"""Into how many steps each axis is cut to see how far the machine reaches, by the number of axes."""
_BEYOND_DEG = 0.05
"""How much wider the reach counts than the steps showed."""
_NORTH_DEG = 10.0
"""A field that comes so near to north from both sides counts as lying across it."""
_LEAST_SHARE = 0.01


@dataclass(frozen=True, slots=True)
class Site:
    """Where the machine stands, in WGS84."""

    latitude_deg: float
    """North positive."""
    longitude_deg: float
    """East positive."""
    height_m: float = 0.0
    """Above the ellipsoid."""


class SkyMapping(Protocol):
    """Where the beam points by the angles of the axes, in the machine's own azimuth and elevation. Any thread."""

    def to_axes(self, az_deg: float, el_deg: float) -> tuple[Mapping[str, float], float]:
        """Return the angles, by axis name, that bring the beam nearest to a direction, and by how far they miss it."""

    def to_sky(self, angles: Mapping[str, float]) -> tuple[float, float]:
        """Return azimuth and elevation of the beam."""


@dataclass(frozen=True, slots=True)
class Arc:
    """The `SkyMapping` of one axis, from where each of its angles points: the nearest point is searched for."""

    axis: str
    min_deg: float
    max_deg: float
    point: Callable[[float], tuple[float, float]]
    """Returns azimuth and elevation at an angle of the axis."""

    def to_sky(self, angles: Mapping[str, float]) -> tuple[float, float]:
        """See `SkyMapping`."""
        return self.point(angles[self.axis])

    def to_axes(self, az_deg: float, el_deg: float) -> tuple[Mapping[str, float], float]:
        """See `SkyMapping`. The best of rough steps, then by golden section between its neighbours."""

        def miss(deg: float) -> float:
            return separation(az_deg, el_deg, *self.point(deg))

        count = max(2, math.ceil((self.max_deg - self.min_deg) / _ROUGH_DEG))
        step_deg = (self.max_deg - self.min_deg) / count
        best = min((self.min_deg + step_deg * k for k in range(count + 1)), key=miss)
        low, high = max(self.min_deg, best - step_deg), min(self.max_deg, best + step_deg)
        while high - low > _FINE_DEG:
            left, right = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
            low, high = (low, right) if miss(left) <= miss(right) else (left, high)
        nearest = min((low, high, (low + high) / 2.0), key=miss)
        return {self.axis: nearest}, miss(nearest)


@dataclass(frozen=True, slots=True)
class MappingOutline:
    """A `SkyMapping` as another program is told of it: how far it reaches, and the curve of a single axis.

    `to_axes` and `to_sky` go by the points of the curve; with more than one axis they raise CommandRefused
    (`unsupported`).
    """

    sky: tuple[Axis, Axis]
    """Azimuth and elevation as the machine reaches them (`mapped_axes`)."""
    axis: str = ""
    """Of the curve; empty with more than one axis."""
    points: tuple[tuple[float, float, float], ...] = ()
    """Angle of that axis, azimuth and elevation there, from its least angle to its greatest."""

    @classmethod
    def of(cls, axes: Sequence[Axis], mapping: SkyMapping) -> MappingOutline:
        """Return the outline of a mapping; an outline is its own."""
        if isinstance(mapping, MappingOutline):
            return mapping
        own = [axis for axis in axes if axis.role is not Role.SKEW]
        sky = mapped_axes(axes, mapping)
        if len(own) > 1:
            return cls(sky)
        count = max(2, math.ceil((own[0].max_deg - own[0].min_deg) / _ROUGH_DEG))
        degs = [own[0].min_deg + (own[0].max_deg - own[0].min_deg) * k / count for k in range(count + 1)]
        return cls(sky, own[0].name, tuple((deg, *mapping.to_sky({own[0].name: deg})) for deg in degs))

    def to_axes(self, az_deg: float, el_deg: float) -> tuple[Mapping[str, float], float]:
        """See `SkyMapping`."""
        self._require_curve()
        curve = Arc(self.axis, self.points[0][0], self.points[-1][0], lambda deg: self.to_sky({self.axis: deg}))
        return curve.to_axes(az_deg, el_deg)

    def to_sky(self, angles: Mapping[str, float]) -> tuple[float, float]:
        """See `SkyMapping`. On a straight line between two points of the curve."""
        self._require_curve()
        deg = angles[self.axis]
        at = min(max(bisect_right(self.points, deg, key=itemgetter(0)), 1), len(self.points) - 1)
        (low, az_low, el_low), (high, az_high, el_high) = self.points[at - 1], self.points[at]
        share = (deg - low) / (high - low)
        return wrap_360(az_low + shortest_turn(az_low, az_high) * share), el_low + (el_high - el_low) * share

    def _require_curve(self) -> None:
        if len(self.points) < 2:
            raise CommandRefused(
                "Only the program that has the port of this machine knows where it points.", reason=Reason.UNSUPPORTED
            )


def mapped_axes(axes: Sequence[Axis], mapping: SkyMapping) -> tuple[Axis, Axis]:
    """Return azimuth and elevation as such a machine reaches them: ranges of the sky, and speeds on the mean.

    An azimuth range across north is given as the whole circle.
    """
    if isinstance(mapping, MappingOutline):
        return mapping.sky
    own = [axis for axis in axes if axis.role is not Role.SKEW]
    sky = list(_directions(own, mapping))
    azimuths, elevations = [az for az, _ in sky], [el for _, el in sky]
    crosses = any(abs(one - other) > 180.0 for one, other in itertools.pairwise(azimuths))
    if len(own) > 1:  # from one step to the next then other axes may jump back
        crosses = min(azimuths) < _NORTH_DEG and max(azimuths) > 360.0 - _NORTH_DEG
    low_az, high_az = (0.0, 360.0) if crosses else (min(azimuths), max(azimuths))
    az_span = max(0.0, low_az - _BEYOND_DEG), min(360.0, high_az + _BEYOND_DEG)
    el_span = max(-90.0, min(elevations) - _BEYOND_DEG), min(90.0, max(elevations) + _BEYOND_DEG)
    slowest = max(own, key=lambda axis: (axis.max_deg - axis.min_deg) / axis.speed_deg_s)
    return (
        _as_seen(slowest, "azimuth", Role.AZ, az_span, known=all(axis.speed_known for axis in own)),
        _as_seen(slowest, "elevation", Role.EL, el_span, known=all(axis.speed_known for axis in own)),
    )


def _directions(axes: Sequence[Axis], mapping: SkyMapping) -> Iterator[tuple[float, float]]:
    steps = _SPAN_STEPS[len(axes)]
    spans = [[axis.min_deg + (axis.max_deg - axis.min_deg) * k / steps for k in range(steps + 1)] for axis in axes]
    for angles in itertools.product(*spans):
        az_deg, el_deg = mapping.to_sky({axis.name: deg for axis, deg in zip(axes, angles, strict=True)})
        yield wrap_360(az_deg), el_deg


def _as_seen(axis: Axis, name: str, role: Role, span: tuple[float, float], *, known: bool) -> Axis:
    share = max((span[1] - span[0]) / (axis.max_deg - axis.min_deg), _LEAST_SHARE)
    return replace(
        axis, name=name, role=role, min_deg=span[0], max_deg=span[1], times=None, speed_known=known,
        speed_deg_s=axis.speed_deg_s * share, acceleration_deg_s2=axis.acceleration_deg_s2 * share,
    )  # fmt: skip
