"""Where the middle of a source is, by levels in several directions: a Gaussian beam on a floor, fitted to them all.

    level = floor + sum of rise_k exp(-4 ln 2 r_k^2 / width^2)

r_k is the distance on the sky between the direction and a source: the one that is sought, and its neighbours. The width
is the full width at half height, the same both ways. Weighted least squares by damped Gauss-Newton steps (D. Marquardt,
SIAM J. Appl. Math. 11, 431, 1963), with a prior on the logarithm of the width. The highest of the same readings is ten
times worse (`tests/signal/test_beam_fit.py`). Plain Python: some dozens of points take about a millisecond.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from statistics import fmean
from typing import Literal

from birdcage.base.geometry import shortest_turn, wrap_360

FALL = 4.0 * math.log(2.0)
LEAST_POINTS = 6
"""One more than there are unknowns."""
ASSUMED_WIDTH_DEG = 5.0
"""Of a beam that is not known."""
WIDTH_PRIOR, UNKNOWN_PRIOR = 0.5, 1.2
"""Standard deviation of the logarithm of a width that is known by theory, and of the assumed one."""
MOST_STEPS = 40
NO_FLOOR = 1e-4
"""A floor of powers is taken to be no lower than this part of the highest level."""
LEAST_RISE_SIGMAS = 6.0
"""A source must stand so many standard deviations over the floor."""
MOST_SIGMA = 0.15
"""A middle that is less sure than this part of the beam's width is none."""
LEAST_NOISE = 0.002
"""The noise of one reading counts as this part of the range of levels at least: a source may tell in coarse steps."""
MOST_BEYOND = 0.35
"""The middle may lie so many widths outside of where it was listened."""

Cut = Literal["az", "el"]
CUTS: tuple[Cut, Cut] = ("az", "el")
"""Along which axis a line of directions lies; in the order of the unknowns."""
HELD_DEG = 1e-3
EQUAL = 6.0
"""Fits whose criteria differ by no more are equals."""

FLOOR, WIDTH, RISE = 2, 3, 4
"""Where these stand among the unknowns; the strengths of neighbours follow the source's own."""
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
class HeardDirection:
    """Readings in one direction. Angles in degrees, true."""

    az_deg: float
    el_deg: float
    values: Sequence[float]

    @property
    def mean(self) -> float:
        """Their mean."""
        return fmean(self.values)


def beam_points(heard: Sequence[HeardDirection], noise: float, *, decibels: bool = False) -> list[BeamPoint]:
    """Return what to fit; `noise` is the standard deviation of one reading, decibels become powers.

    Nothing where all levels are alike and without noise, as those of a tuner that is off.
    """
    means = [each.mean for each in heard]
    noise = max(noise, LEAST_NOISE * (max(means, default=0.0) - min(means, default=0.0)))
    if not noise:
        return []
    points = []
    for each, mean in zip(heard, means, strict=True):
        sigma = noise / math.sqrt(len(each.values))
        level = 10.0 ** ((mean - max(means)) / 10.0) if decibels else mean
        points.append(
            BeamPoint(each.az_deg, each.el_deg, level, sigma * level * math.log(10.0) / 10.0 if decibels else sigma)
        )
    return points


def noise_of(heard: Sequence[HeardDirection]) -> float:
    """Return the standard deviation of one reading, by the scatter within each direction; 0 if that is not known."""
    squares = [(value - each.mean) ** 2 for each in heard for value in each.values]
    free = len(squares) - len(heard)
    return math.sqrt(sum(squares) / free) if free > 0 else 0.0


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
    unit: str = ""
    """Of rise and floor, with a blank before it; counts have none."""

    def in_decibels(self, highest: float) -> BeamFit:
        """Return it for powers in parts of the `highest` level, which is in decibels."""
        floor = max(self.floor, NO_FLOOR)
        rise_db = 10.0 * math.log10(1.0 + self.rise / floor)
        return replace(self, rise=rise_db, floor=highest + 10.0 * math.log10(floor), unit=" dB")

    @property
    def rise_words(self) -> str:
        """How far it rises."""
        return f"{self.rise:.{1 if self.unit else 0}f}{self.unit} over the floor"

    @property
    def words(self) -> str:
        """Say where the middle is, how sure that is, and how far the signal rises."""
        return f"Peak at {self.az_deg:.2f}°/{self.el_deg:.2f}° ±{self.sigma_deg:.2f}°, {self.rise_words}."

    def values(self) -> dict[str, float | str]:
        """Return all by name, for other programs."""
        return {
            "az_deg": self.az_deg, "el_deg": self.el_deg, "sigma_deg": self.sigma_deg, "rise": self.rise,
            "floor": self.floor, "width_deg": self.width_deg, "points": self.points,
            "unit": self.unit.strip() or "counts",
        }  # fmt: skip


Pattern = Sequence[tuple[float, float]]
"""Sources beside the one that is sought: how far right of it each stands, and above it, in degrees on the sky."""


def fit_beam(
    points: Sequence[BeamPoint], width_deg: float | None, patterns: Sequence[Pattern] = ((),), cut: Cut | None = None
) -> BeamFit | None:
    """Return the fit; None where the points do not tell the middle of a source.

    `width_deg` is the width that is expected, by theory or by an earlier measurement. `patterns` are what may be heard
    beside the source, each source with a strength of its own: one where it is known which source is sought, several
    where it is not. Then the pattern that fits best counts, as Akaike's criterion weighs what is free in it; among
    equals the stronger source. `cut`: the points lie on a line along that axis, and so does the source then; the
    standard deviation is that along the line.
    """
    fits = [
        (cost + 2.0 * len(pattern), fit) for pattern in patterns for cost, fit in _fits(points, width_deg, pattern, cut)
    ]
    if not fits:
        return None
    least = min(cost for cost, _fit in fits)
    return max((fit for cost, fit in fits if cost <= least + EQUAL), key=lambda fit: fit.rise)


def _fits(
    points: Sequence[BeamPoint], width_deg: float | None, neighbours: Pattern, cut: Cut | None
) -> Iterator[tuple[float, BeamFit]]:
    """Yield chi squared and fit, for each source of a pattern being the strongest that was heard."""
    if len(points) < LEAST_POINTS + len(neighbours):
        return
    best = max(points, key=lambda each: each.value)
    cos = math.cos(math.radians(best.el_deg))
    offsets = [(shortest_turn(best.az_deg, each.az_deg) * cos, each.el_deg - best.el_deg) for each in points]
    beyond = MOST_BEYOND * (width_deg or ASSUMED_WIDTH_DEG)
    for strongest in range(len(neighbours) + 1):
        model = _Model(points, offsets, ((0.0, 0.0), *neighbours), strongest, width_deg, cut)
        if not model.holds(model.start[0], model.start[1], beyond):
            continue
        found = _solve(model)
        if found is None:
            continue
        (across, up, floor, log_width, rise, *_), covariance, cost = found
        width, scale = math.exp(log_width), max(1.0, cost / max(1, len(points) - len(covariance)))
        sigma = math.sqrt(scale * max(covariance[axis][axis] for axis in (0, 1) if axis != model.held))
        clear = rise > LEAST_RISE_SIGMAS * math.sqrt(scale * covariance[RISE][RISE])
        if clear and model.holds(across, up, MOST_BEYOND * width) and sigma < MOST_SIGMA * width:
            az_deg = wrap_360(best.az_deg + across / cos)
            yield cost, BeamFit(az_deg, best.el_deg + up, sigma, rise, floor, width, len(points))


class _Model:
    """What is fitted: two offsets, floor, logarithm of the width, and the strength of each source, in this order."""

    def __init__(
        self, points: Sequence[BeamPoint], offsets: Sequence[tuple[float, float]],
        sources: Sequence[tuple[float, float]], strongest: int, width_deg: float | None, cut: Cut | None,
    ) -> None:  # fmt: skip
        """`offsets` of the points from the strongest of them, which is taken to be the source of that number."""
        self.points, self._offsets, self._sources = points, offsets, sources
        low, high = min(each.value for each in points), max(each.value for each in points)
        expected = math.log(ASSUMED_WIDTH_DEG if width_deg is None else width_deg)
        right_deg, above_deg = sources[strongest]
        rises = [(high - low) * (index == strongest) for index in range(len(sources))]
        self.start = [-right_deg, -above_deg, low, expected, *rises]
        self._priors = {WIDTH: (expected, UNKNOWN_PRIOR if width_deg is None else WIDTH_PRIOR)}
        self.held = None if cut is None else 1 - CUTS.index(cut)
        """The unknown that a cut does not tell."""
        if self.held is not None:
            self.start[self.held] = 0.0
            self._priors[self.held] = (0.0, HELD_DEG)
        # A neighbour out of hearing has the strength of nothing, and no more than the strongest level.
        self._priors |= {RISE + each: (0.0, high - low or 1.0) for each in range(1, len(sources))}

    def holds(self, across_deg: float, up_deg: float, beyond_deg: float) -> bool:
        """Return whether that is where it was listened, or so little beyond."""
        return all(
            min(each) - beyond_deg <= value <= max(each) + beyond_deg
            for value, each in zip((across_deg, up_deg), zip(*self._offsets, strict=True), strict=True)
        )

    def allows(self, unknowns: Row) -> bool:
        """Return whether the width is not a twentieth, or twenty times what is expected."""
        return abs(unknowns[WIDTH] - self._priors[WIDTH][0]) <= 3.0

    def normal(self, unknowns: Row) -> tuple[float, list[Row], Row]:
        """Return chi squared, the normal matrix and the right side of the next step."""
        size = len(unknowns)
        inverse = math.exp(-2.0 * unknowns[WIDTH])
        normal, right, cost = [[0.0] * size for _ in range(size)], [0.0] * size, 0.0
        for index, (expected, sigma) in self._priors.items():
            normal[index][index] += 1.0 / sigma**2
            right[index] += (expected - unknowns[index]) / sigma**2
            cost += ((unknowns[index] - expected) / sigma) ** 2
        for point, (x, y) in zip(self.points, self._offsets, strict=True):
            row = [0.0, 0.0, 1.0, 0.0] + [0.0] * len(self._sources)
            level = unknowns[FLOOR]
            for index, (right_deg, above_deg) in enumerate(self._sources, RISE):
                dx, dy = x - unknowns[0] - right_deg, y - unknowns[1] - above_deg
                far = FALL * (dx * dx + dy * dy) * inverse
                row[index] = math.exp(-far)
                heard = unknowns[index] * row[index]
                level += heard
                row[0] += 2.0 * FALL * inverse * heard * dx
                row[1] += 2.0 * FALL * inverse * heard * dy
                row[WIDTH] += 2.0 * far * heard
            weight, rest = 1.0 / point.sigma**2, point.value - level
            cost += weight * rest * rest
            for i, one in enumerate(row):
                right[i] += weight * one * rest
                for j in range(i, size):
                    normal[i][j] += weight * one * row[j]
        for i in range(size):
            for j in range(i):
                normal[i][j] = normal[j][i]
        return cost, normal, right


def _solve(model: _Model) -> tuple[Row, list[Row], float] | None:
    """Return unknowns, their covariance, and chi squared; None where that does not converge."""
    unknowns, damping = model.start, 1e-3
    cost, normal, right = model.normal(unknowns)
    for _ in range(MOST_STEPS):
        damped = [[each * (1.0 + damping * (i == j)) for j, each in enumerate(row)] for i, row in enumerate(normal)]
        step = _eliminated(damped, [[each] for each in right])
        if step is None:
            return None
        tried = [each + change[0] for each, change in zip(unknowns, step, strict=True)]
        tried_cost, tried_normal, tried_right = (
            model.normal(tried) if model.allows(tried) else (math.inf, normal, right)
        )
        if tried_cost > cost:
            damping *= 10.0
            if damping > 1e8:
                break
            continue
        gained, cost = cost - tried_cost, tried_cost
        unknowns, normal, right, damping = tried, tried_normal, tried_right, damping / 10.0
        if gained < 1e-6 * (1.0 + cost):
            break
    size = len(unknowns)
    covariance = _eliminated(normal, [[float(i == j) for j in range(size)] for i in range(size)])
    return None if covariance is None else (unknowns, covariance, cost)


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
