"""An elliptical beam with free flanks, fitted to powers around the Sun; `sun_lesson` has the formula."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.skymap.map_levels import GAUSS, LessonRefused

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

CORE, OUTSIDE = 0.9, 1.3
"""Fitted is what lies so many widths from the middle at most, or so many at least: the first side lobes lie between."""
MOST_STEPS, ROUNDS = 40, 4
LEAST_CORE, LEAST_OUTSIDE = 9, 8
LEAST_SIGMAS = 6.0
LEAST_SIDE = 0.35
"""In each direction the beam must have been heard so many widths from its middle."""
X, Y, WIDE, TALL, FLANK, RISE, FLOOR, SLOPE = range(8)


@dataclass(frozen=True, slots=True)
class SunPoint:
    """A power, in degrees on the sky right of the Sun and above it."""

    right_deg: float
    up_deg: float
    power: float


@dataclass(frozen=True, slots=True)
class SunFit:
    """What was fitted; widths at half power as seen, the disc of the Sun within."""

    right_deg: float
    up_deg: float
    az_deg: float
    el_deg: float
    az_sigma_deg: float
    el_sigma_deg: float
    rise: float
    floor: float
    ratio_sigma: float
    """Standard deviation of rise over floor."""


def fit_sun(points: Sequence[SunPoint]) -> SunFit:
    """Return the fit. LessonRefused where the points do not tell it."""
    import numpy as np

    x, y, power = (np.array([getattr(each, name) for each in points]) for name in ("right_deg", "up_deg", "power"))
    if len(points) < LEAST_CORE + LEAST_OUTSIDE:
        raise LessonRefused(f"{len(points)} directions around the Sun are too few. Map it with a smaller step.")
    values = _begin(x, y, power)
    for _ in range(ROUNDS):
        away = np.hypot((x - values[X]) / values[WIDE], (y - values[Y]) / values[TALL])
        core, outside = away < CORE, away > OUTSIDE
        _check(x[core] - values[X], y[core] - values[Y], values, int(core.sum()), int(outside.sum()))
        used = core | outside
        values, covariance = _solve(x[used], y[used], power[used], core[used], values)
    rise, floor = float(values[RISE]), float(values[FLOOR])
    if not rise > LEAST_SIGMAS * math.sqrt(covariance[RISE, RISE]) or floor <= 0.0:
        raise LessonRefused("The Sun does not stand out of this map.")
    half = _half_power(float(values[FLANK]))
    by_flank = (_half_power(float(values[FLANK]) + 1e-4) - half) / 1e-4
    wide, tall = (
        math.sqrt(_variance(covariance, {axis: half, FLANK: float(values[axis]) * by_flank})) for axis in (WIDE, TALL)
    )
    ratio_sigma = math.sqrt(_variance(covariance, {RISE: 1.0 / floor, FLOOR: -rise / floor**2}))
    return SunFit(
        float(values[X]), float(values[Y]), float(values[WIDE]) * half, float(values[TALL]) * half,
        wide, tall, rise, floor, ratio_sigma,
    )  # fmt: skip


def _variance(covariance: Floats, parts: dict[int, float]) -> float:
    """Return the variance of a sum of unknowns, each so many times."""
    return sum(a * b * float(covariance[i, j]) for i, a in parts.items() for j, b in parts.items())


def _half_power(flank: float) -> float:
    """Return the width at half power in parts of the fitted one: q + k q^2 = ln 2 there."""
    log2 = math.log(2.0)
    q = log2 if abs(flank) < 1e-9 else (math.sqrt(1.0 + 4.0 * flank * log2) - 1.0) / (2.0 * flank)
    return math.sqrt(q / log2)


def _begin(x: Floats, y: Floats, power: Floats) -> Floats:
    """Return where to begin: the middle and size of what is above half of the rise."""
    import numpy as np

    floor, top = float(np.percentile(power, 25.0)), float(np.sort(power)[-3:].mean())
    high = power > floor + (top - floor) / 2.0
    if int(high.sum()) < 3 or top - floor <= LEAST_SIGMAS * _noise(x, y, power):
        raise LessonRefused("The Sun does not stand out of this map.")
    # Points spread evenly over an ellipse scatter by a quarter of its width.
    wide, tall = 4.0 * float(np.std(x[high])), 4.0 * float(np.std(y[high]))
    size = max(wide, tall, 0.3)
    middle = float(x[high].mean()), float(y[high].mean())
    return np.array([*middle, max(wide, size / 5.0), max(tall, size / 5.0), 0.0, top - floor, floor, 0.0])


def _noise(x: Floats, y: Floats, power: Floats) -> float:
    """Return the standard deviation of a power, by how each of some differs from its nearest neighbour."""
    import numpy as np

    some = np.arange(0, len(x), max(1, len(x) // 400))
    away = np.hypot(x[some, None] - x[None, :], y[some, None] - y[None, :])
    away[np.arange(len(some)), some] = np.inf
    return GAUSS * float(np.median(np.abs(power[some] - power[away.argmin(axis=1)]))) / math.sqrt(2.0)


def _check(x: Floats, y: Floats, values: Floats, core: int, outside: int) -> None:
    if core < LEAST_CORE:
        raise LessonRefused(f"{core} directions within the beam are too few. Map the Sun with a smaller step.")
    sides = [(x / values[WIDE]).max(), -(x / values[WIDE]).min(), (y / values[TALL]).max(), -(y / values[TALL]).min()]
    if min(sides) < LEAST_SIDE:
        raise LessonRefused("The map ends before the beam does. Map the Sun with its beam to all four sides.")
    if outside < LEAST_OUTSIDE:
        raise LessonRefused(
            f"The map ends less than {OUTSIDE:g} beams from the Sun. The sky beside it is needed: map a wider region."
        )


def _model(values: Floats, x: Floats, y: Floats, core: NDArray[np.bool_]) -> Floats:
    """Return the powers of the formula; outside of the core the beam counts nothing, whatever its flanks."""
    import numpy as np

    q = 4.0 * math.log(2.0) * (((x - values[X]) / values[WIDE]) ** 2 + ((y - values[Y]) / values[TALL]) ** 2)
    beam = np.where(core, np.exp(-np.clip(q + values[FLANK] * q * q, -5.0, 50.0)), 0.0)
    return np.asarray(values[FLOOR] + values[SLOPE] * (y - values[Y]) + values[RISE] * beam)


def _solve(x: Floats, y: Floats, power: Floats, core: NDArray[np.bool_], values: Floats) -> tuple[Floats, Floats]:
    """Return unknowns and covariance, by damped Gauss-Newton steps with a numerical derivative."""
    import numpy as np

    scale = np.array([values[WIDE], values[TALL], values[WIDE], values[TALL], 1.0, values[RISE], values[RISE],
                      values[RISE] / values[TALL]])  # fmt: skip
    # The noise of a receiver goes with its power.
    damping, rest = 1e-3, 1.0 - _model(values, x, y, core) / power
    cost = float(rest @ rest)
    for _ in range(MOST_STEPS):
        columns = []
        for index in range(len(values)):
            moved = values.copy()
            moved[index] += 1e-5 * scale[index]
            columns.append((_model(moved, x, y, core) / power - (1.0 - rest)) / 1e-5)
        rows = np.array(columns).T  # by each unknown in parts of its scale
        normal = rows.T @ rows
        step = np.linalg.solve(normal + np.diag(damping * np.diag(normal) + 1e-12), rows.T @ rest)
        tried = values + step * scale
        tried[[WIDE, TALL]] = np.clip(tried[[WIDE, TALL]], values[[WIDE, TALL]] / 2.0, values[[WIDE, TALL]] * 2.0)
        tried[FLANK] = min(max(float(tried[FLANK]), -0.15), 1.0)
        tried_rest = 1.0 - _model(tried, x, y, core) / power
        tried_cost = float(tried_rest @ tried_rest)
        if tried_cost > cost:
            damping *= 10.0
            if damping > 1e8:
                break
            continue
        done = cost - tried_cost <= 1e-9 * cost
        values, rest, cost, damping = tried, tried_rest, tried_cost, damping / 10.0
        if done:
            break
    variance = cost / max(1, len(power) - len(values))
    covariance = np.linalg.pinv(normal) * variance * np.outer(scale, scale)
    return values, np.asarray(covariance, dtype=np.float64)
