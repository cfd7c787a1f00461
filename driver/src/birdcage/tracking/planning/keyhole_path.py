"""The way through the keyhole: where the target's azimuth sweeps faster than the dish turns.

`docs/tracking.md`, *The keyhole*, has what it is for.

A dish within `eps` of the target may stand anywhere in an interval of azimuth, which grows towards the zenith. A path
at a limited rate through all intervals exists if a running minimum and maximum say so; bisection finds the least
`eps`, and of the paths that keep it (nearly), the one nearest to the target in the least squares is taken.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.reach_speed import azimuth_room
from birdcage.tracking.curve import Floats

_HALVINGS = 22
_WIDEST_DEG = 90.0
_EASE, _EASE_DEG = 1.02, 0.02
"""How much more than the least error is allowed for the sake of a smaller one on average."""


@dataclass(frozen=True, slots=True, eq=False)
class Corridor:
    """Where a target stands over time, and where the azimuth may be at each: dish degrees, unrolled."""

    t_s: Floats
    az_deg: Floats
    el_deg: Floats
    """Within what the elevation may be."""
    low_deg: Floats
    high_deg: Floats
    """Azimuths that the cable and the no-go sectors leave."""
    ceiling_deg: Floats
    wanted: NDArray[np.bool_]
    """Whether it matters where the dish points; elsewhere any azimuth within `low_deg` and `high_deg` will do."""


def through(corridor: Corridor, rates_deg_s: Floats) -> Floats:
    """Return the azimuths of the best path at limited rates; the target's own wherever that can be followed."""
    way = _ways(corridor.t_s, rates_deg_s)
    target = np.clip(corridor.az_deg, corridor.low_deg, corridor.high_deg)
    if (np.abs(np.diff(target)) <= np.diff(way) + 1e-9).all():
        return target
    eps = least_error_deg(corridor, rates_deg_s)
    tube = _tube(corridor, way, eps * _EASE + _EASE_DEG)
    if tube is None:
        # Nothing within 90 degrees of the target: whatever the rate allows and is nearest.
        tube = envelope(corridor.low_deg, corridor.high_deg, way)
    weight = np.where(corridor.wanted, np.cos(np.radians(corridor.el_deg)) ** 2 + 1e-4, 1e-6)
    path = np.clip(_nearest(target, way, weight), *tube)
    return limited(path, way)


def least_error_deg(corridor: Corridor, rates_deg_s: Floats) -> float:
    """Return the least greatest error with which the target can be followed, with the best elevation at each time."""
    way = _ways(corridor.t_s, rates_deg_s)
    low, high = 0.0, _WIDEST_DEG
    if _tube(corridor, way, 1e-6) is not None:
        return 0.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2.0
        if _tube(corridor, way, middle) is None:
            low = middle
        else:
            high = middle
    return high


def best_elevation(az_off_deg: Floats, el_deg: Floats) -> Floats:
    """Return the elevation nearest to the target for an azimuth that is off by so much: nearer to the zenith."""
    off, el = np.radians(az_off_deg), np.radians(el_deg)
    best = np.degrees(np.arctan2(np.sin(el), np.cos(el) * np.cos(off)))
    found: Floats = np.where(np.abs(az_off_deg) < 1e-9, el_deg, np.minimum(best, 90.0))
    return found


def envelope(low: Floats, high: Floats, way: Floats) -> tuple[Floats, Floats]:
    """Return what of the intervals between `low` and `high` can be reached from all others at the rate of `way`."""
    upper = np.minimum(np.minimum.accumulate(high - way) + way, np.minimum.accumulate((high + way)[::-1])[::-1] - way)
    lower = np.maximum(np.maximum.accumulate(low + way) - way, np.maximum.accumulate((low - way)[::-1])[::-1] + way)
    return lower, upper


def limited(values: Floats, way: Floats) -> Floats:
    """Return the path at the rate of `way` whose greatest distance from `values` is the least."""
    if (np.abs(np.diff(values)) <= np.diff(way) + 1e-9).all():
        return values
    above, below = envelope(values, values, way)
    middle: Floats = (above + below) / 2.0
    return middle


def _ways(t: Floats, rates: Floats) -> Floats:
    """Return how far the axis can have turned by each time, in all."""
    between = np.minimum(rates[1:], rates[:-1]) * np.diff(t)
    return np.concatenate(([0.0], np.cumsum(between)))


def _tube(corridor: Corridor, way: Floats, eps: float) -> tuple[Floats, Floats] | None:
    room = np.where(corridor.wanted, azimuth_room(corridor.el_deg, eps, corridor.ceiling_deg), np.inf)
    low = np.maximum(corridor.az_deg - room, corridor.low_deg)
    high = np.minimum(corridor.az_deg + room, corridor.high_deg)
    lower, upper = envelope(low, high, way)
    return (lower, upper) if (lower <= upper + 1e-9).all() else None


def _nearest(target: Floats, way: Floats, weight: Floats) -> Floats:
    """Return the path that rises, and falls, no faster than `way` and is nearest to `target` in the least squares.

    With one bound on the slope that is isotonic regression, which pooling adjacent violators solves exactly; in a
    keyhole the azimuth sweeps one way only.
    """
    rising = _pooled(target - way, weight) + way
    falling: Floats = -(_pooled(-rising - way, weight) + way)
    return falling


def _pooled(values: Floats, weights: Floats) -> Floats:
    """Return the falling sequence nearest to `values`."""
    if (np.diff(values) <= 0.0).all():
        return values
    means: list[float] = []
    sums: list[float] = []
    counts: list[int] = []
    for value, weight in zip(values.tolist(), weights.tolist(), strict=True):
        mean, total, count = value, weight, 1
        while means and means[-1] < mean:
            before = sums.pop()
            mean = (mean * total + means.pop() * before) / (total + before)
            total += before
            count += counts.pop()
        means.append(mean)
        sums.append(total)
        counts.append(count)
    return np.repeat(means, counts)
