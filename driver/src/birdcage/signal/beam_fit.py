"""Where the middle of a source is, by levels in several directions: a Gaussian beam on a floor, fitted to them all.

    level = floor + rise exp(-4 ln 2 r^2 / width^2)

r is the distance on the sky between the direction and the source; the width is the full width at half height, the same
both ways. Weighted least squares by damped Gauss-Newton steps (D. Marquardt, SIAM J. Appl. Math. 11, 431, 1963), with a
prior on the logarithm of the width. The highest of the same readings is ten times worse
(`tests/signal/test_beam_fit.py`). Plain Python: five unknowns and some dozens of points take about a millisecond.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from birdcage.base.geometry import shortest_turn, wrap_360

FALL = 4.0 * math.log(2.0)
LEAST_POINTS = 6
"""One more than there are unknowns."""
ASSUMED_WIDTH_DEG = 5.0
"""Of a beam that is not known."""
WIDTH_PRIOR, UNKNOWN_PRIOR = 0.5, 1.2
"""Standard deviation of the logarithm of a width that is known by theory, and of the assumed one."""
MOST_STEPS = 40
LEAST_RISE_SIGMAS = 6.0
"""A source must stand so many standard deviations over the floor."""
MOST_SIGMA = 0.15
"""A middle that is less sure than this part of the beam's width is none."""
MOST_BEYOND = 0.35
"""The middle may lie so many widths outside of where it was listened."""

Row = list[float]


@dataclass(frozen=True, slots=True)
class BeamPoint:
    """A level in one direction. Angles in degrees."""

    az_deg: float
    el_deg: float
    value: float
    sigma: float
    """Its standard deviation."""


@dataclass(frozen=True, slots=True)
class BeamFit:
    """What was found. Angles in degrees; values in the unit of the points."""

    az_deg: float
    el_deg: float
    sigma_deg: float
    """Standard deviation of the middle on the sky, of the worse of its two directions: by noise, not by neighbours."""
    rise: float
    floor: float
    width_deg: float
    """Full width at half height, as the source of the signal shows it: in counts it is no beam in decibels."""
    points: int


def fit_beam(points: Sequence[BeamPoint], width_deg: float | None) -> BeamFit | None:
    """Return the fit; None where the points do not tell the middle of a source.

    `width_deg` is the width that is expected, by theory or by an earlier measurement.
    """
    if len(points) < LEAST_POINTS:
        return None
    best = max(points, key=lambda each: each.value)
    cos = math.cos(math.radians(best.el_deg))
    offsets = [(shortest_turn(best.az_deg, each.az_deg) * cos, each.el_deg - best.el_deg) for each in points]
    low = min(each.value for each in points)
    expected = math.log(ASSUMED_WIDTH_DEG if width_deg is None else width_deg)
    prior = (expected, UNKNOWN_PRIOR if width_deg is None else WIDTH_PRIOR)
    found = _solve(points, offsets, [0.0, 0.0, best.value - low, low, expected], prior)
    if found is None:
        return None
    (across, up, rise, floor, log_width), covariance, cost = found
    width, scale = math.exp(log_width), max(1.0, cost / max(1, len(points) - 5))
    sigma = math.sqrt(scale * max(covariance[0][0], covariance[1][1]))
    clear = rise > LEAST_RISE_SIGMAS * math.sqrt(scale * covariance[2][2])
    beyond = MOST_BEYOND * width
    inside = (
        min(x for x, _ in offsets) - beyond <= across <= max(x for x, _ in offsets) + beyond
        and min(y for _, y in offsets) - beyond <= up <= max(y for _, y in offsets) + beyond
    )
    if not (clear and inside and sigma < MOST_SIGMA * width):
        return None
    az_deg = wrap_360(best.az_deg + across / cos)
    return BeamFit(az_deg, best.el_deg + up, sigma, rise, floor, width, len(points))


def _solve(
    points: Sequence[BeamPoint], offsets: Sequence[tuple[float, float]], start: Row, prior: tuple[float, float]
) -> tuple[Row, list[Row], float] | None:
    """Return unknowns, their covariance, and chi squared; None where that does not converge."""
    unknowns, damping = start, 1e-3
    cost, normal, gradient = _normal(points, offsets, unknowns, prior)
    for _ in range(MOST_STEPS):
        damped = [[each * (1.0 + damping * (i == j)) for j, each in enumerate(row)] for i, row in enumerate(normal)]
        step = _eliminated(damped, [[each] for each in gradient])
        if step is None:
            return None
        tried = [each + change[0] for each, change in zip(unknowns, step, strict=True)]
        if abs(tried[4] - prior[0]) > 3.0:  # a width of a twentieth, or twenty times what is expected
            damping *= 10.0
            continue
        tried_cost, tried_normal, tried_gradient = _normal(points, offsets, tried, prior)
        if tried_cost > cost:
            damping *= 10.0
            if damping > 1e8:
                break
            continue
        gained, cost = cost - tried_cost, tried_cost
        unknowns, normal, gradient, damping = tried, tried_normal, tried_gradient, damping / 10.0
        if gained < 1e-6 * (1.0 + cost):
            break
    identity = [[float(i == j) for j in range(5)] for i in range(5)]
    covariance = _eliminated(normal, identity)
    return None if covariance is None else (unknowns, covariance, cost)


def _normal(
    points: Sequence[BeamPoint], offsets: Sequence[tuple[float, float]], unknowns: Row, prior: tuple[float, float]
) -> tuple[float, list[Row], Row]:
    """Return chi squared, the normal matrix and the right side of the next step."""
    across, up, rise, floor, log_width = unknowns
    inverse = math.exp(-2.0 * log_width)
    normal, right = [[0.0] * 5 for _ in range(5)], [0.0] * 5
    cost = ((log_width - prior[0]) / prior[1]) ** 2
    normal[4][4] += 1.0 / prior[1] ** 2
    right[4] += (prior[0] - log_width) / prior[1] ** 2
    for point, (x, y) in zip(points, offsets, strict=True):
        dx, dy = x - across, y - up
        far = FALL * (dx * dx + dy * dy) * inverse
        bell = math.exp(-far)
        slope = 2.0 * FALL * inverse * rise * bell
        row = (slope * dx, slope * dy, bell, 1.0, 2.0 * far * rise * bell)
        weight = 1.0 / point.sigma**2
        rest = point.value - floor - rise * bell
        cost += weight * rest * rest
        for i, one in enumerate(row):
            right[i] += weight * one * rest
            for j in range(i, 5):
                normal[i][j] += weight * one * row[j]
    for i in range(5):
        for j in range(i):
            normal[i][j] = normal[j][i]
    return cost, normal, right


def _eliminated(matrix: list[Row], right: list[Row]) -> list[Row] | None:
    """Solve a system by Gauss's elimination with pivots; None where it is singular."""
    rows = [[*row, *more] for row, more in zip(matrix, right, strict=True)]
    size = len(rows)
    for column in range(size):
        pivot = max(range(column, size), key=lambda index: abs(rows[index][column]))
        if abs(rows[pivot][column]) < 1e-12:
            return None
        rows[column], rows[pivot] = rows[pivot], rows[column]
        rows[column] = [each / rows[column][column] for each in rows[column]]
        for index in range(size):
            if index != column:
                factor = rows[index][column]
                rows[index] = [a - factor * b for a, b in zip(rows[index], rows[column], strict=True)]
    return [row[size:] for row in rows]
