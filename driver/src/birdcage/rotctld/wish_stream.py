"""What a stream of wishes says of its target: whether it is one, and where it leads between two wishes."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from itertools import pairwise

from birdcage.base.geometry import separation, shortest_turn, wrap_360

KEPT = 6
"""How many wishes a fit goes by."""
FEWEST = 4
"""From how many wishes on they are a stream: three tell a rate, and one more that it holds."""
LONGEST_S = 3.5
"""The longest interval of an even stream. SatNOGS asks every 3 s, and is the slowest that is known."""
SHORTEST_S = 0.05
"""A wish that follows sooner takes the place of the one before."""
UNEVEN = 2.2
"""The longest interval of an even stream may be so many times the shortest."""
LONGEST_UNEVEN_S = 30.0
"""The longest interval of a stream that need not be even."""
FASTEST_DEG_S = 3.0
"""On the sky: twice what a satellite at 200 km does overhead."""
LEAST_DEG = 0.05
"""Wishes that lie closer together have nothing to be smoothed."""
MISFIT_DEG = 0.2
"""How far on the sky a wish may lie from the curve through all."""
ZENITH_DEG = 85.0
"""Above it the azimuth turns too fast for a curve through it."""
INTERVALS = 2.0
"""So many intervals after its last wish, and so many times its largest step, a stream is followed at most."""


@dataclass(frozen=True, slots=True)
class _Wish:
    """One wish; the azimuth is unrolled, so that north is nothing special."""

    at: float
    az_deg: float
    el_deg: float

    def steps_to(self, other: _Wish) -> tuple[float, float]:
        return other.az_deg - self.az_deg, other.el_deg - self.el_deg

    def sky_deg(self, other: _Wish) -> float:
        return separation(self.az_deg, self.el_deg, other.az_deg, other.el_deg)


class WishStream:
    """The wishes of one client, as far as they are one stream; times in monotonic seconds, true degrees.

    Azimuth and elevation are each taken for a polynomial of time through the last `KEPT` wishes, by least squares: of
    the second degree from five wishes on, else of the first (Savitzky and Golay, Anal. Chem. 36, 1627, 1964, evaluated
    after its last point). A wish is taken for where the target is at the moment at which it comes.

    What does not fit is no stream, and nothing is foreseen: a jump, a target that stands, one that is faster than any
    satellite, and uneven intervals.
    """

    def __init__(self, *, even: bool = True) -> None:
        """`even`: whether intervals have to be even, and short."""
        self._longest_s, self._uneven = (LONGEST_S, UNEVEN) if even else (LONGEST_UNEVEN_S, math.inf)
        self._wishes: deque[_Wish] = deque(maxlen=KEPT)
        self._curves: tuple[tuple[float, ...], tuple[float, ...]] | None = None

    def end(self) -> None:
        """Forget all wishes."""
        self._wishes.clear()
        self._curves = None

    def take(self, at: float, az_deg: float, el_deg: float) -> None:
        """Take in a wish. One that does not belong to the stream begins another; one that is no number ends it."""
        if not (math.isfinite(at) and math.isfinite(az_deg) and math.isfinite(el_deg)):
            self.end()
            return
        wish = _Wish(at, az_deg, el_deg)
        if self._wishes:
            last = self._wishes[-1]
            wish = _Wish(at, last.az_deg + shortest_turn(last.az_deg, az_deg), el_deg)
            if last.at <= at < last.at + SHORTEST_S:
                self._wishes.pop()
            if self._wishes and not self._goes_on_with(wish):
                self._wishes.clear()
        self._wishes.append(wish)
        self._curves = self._fitted()

    def _goes_on_with(self, wish: _Wish) -> bool:
        last = self._wishes[-1]
        interval_s = wish.at - last.at
        if not 0.0 < interval_s <= self._longest_s:
            return False
        stands = self._curves is not None and last.sky_deg(wish) < 0.01
        return not stands and last.sky_deg(wish) <= FASTEST_DEG_S * interval_s

    def _fitted(self) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
        wishes = tuple(self._wishes)
        if len(wishes) < FEWEST or max(abs(wish.el_deg) for wish in wishes) > ZENITH_DEG:
            return None
        intervals = [later.at - earlier.at for earlier, later in pairwise(wishes)]
        if max(intervals) > self._uneven * min(intervals) or wishes[0].sky_deg(wishes[-1]) < LEAST_DEG:
            return None
        degree, times = 2 if len(wishes) > FEWEST else 1, [wish.at - wishes[-1].at for wish in wishes]
        az = fitted(times, [wish.az_deg for wish in wishes], degree)
        el = fitted(times, [wish.el_deg for wish in wishes], degree)
        for time, wish in zip(times, wishes, strict=True):
            lift = math.cos(math.radians(wish.el_deg))
            if math.hypot((value(az, time) - wish.az_deg) * lift, value(el, time) - wish.el_deg) > MISFIT_DEG:
                return None
        return az, el

    @property
    def interval_s(self) -> float | None:
        """The mean interval; None where it is no stream."""
        if self._curves is None:
            return None
        return (self._wishes[-1].at - self._wishes[0].at) / (len(self._wishes) - 1)

    @property
    def until(self) -> float | None:
        """Until when it is followed if no other wish comes; None where it is no stream."""
        interval_s = self.interval_s
        return None if interval_s is None else self._wishes[-1].at + INTERVALS * interval_s

    def foreseen(self, at: float) -> tuple[float, float] | None:
        """Return the azimuth (0 to 360) and elevation of its target at a time; None where it is no stream.

        No time after `until` is looked at, and neither angle lies further from the last wish than `INTERVALS` times its
        largest step.
        """
        until = self.until
        if self._curves is None or until is None or not math.isfinite(at):
            return None
        wishes = tuple(self._wishes)
        last, time = wishes[-1], min(max(at, wishes[0].at), until) - wishes[-1].at
        steps = [earlier.steps_to(later) for earlier, later in pairwise(wishes)]
        most_az, most_el = (INTERVALS * max(abs(step[axis]) for step in steps) for axis in (0, 1))
        az_deg = _within(value(self._curves[0], time), last.az_deg, most_az)
        el_deg = _within(value(self._curves[1], time), last.el_deg, most_el)
        return wrap_360(az_deg), min(max(el_deg, -90.0), 90.0)


def _within(deg: float, middle_deg: float, most_deg: float) -> float:
    return min(max(deg, middle_deg - most_deg), middle_deg + most_deg)


def fitted(times: list[float], angles: list[float], degree: int) -> tuple[float, ...]:
    """Return the coefficients of the polynomial of least squares, lowest first. Times must differ.

    Forsythe's orthogonal polynomials (J. SIAM 5, 74, 1957) need no matrix: p0 = 1, and
    p[k+1] = (t - <t p[k], p[k]> / <p[k], p[k]>) p[k] - <p[k], p[k]> / <p[k-1], p[k-1]> p[k-1].
    """
    before, now = [0.0] * (degree + 2), [1.0] + [0.0] * (degree + 1)
    found, norm_before = [0.0] * (degree + 1), 1.0
    for _ in range(degree + 1):
        at = [value(tuple(now), time) for time in times]
        norm = sum(each * each for each in at)
        share = sum(each * angle for each, angle in zip(at, angles, strict=True)) / norm
        found = [total + share * part for total, part in zip(found, now, strict=False)]
        mean = sum(time * each * each for time, each in zip(times, at, strict=True)) / norm
        ratio, norm_before = norm / norm_before, norm
        later = [low - mean * same - ratio * old for low, same, old in zip([0.0, *now], now, before, strict=False)]
        before, now = now, later
    return tuple(found)


def value(coefficients: tuple[float, ...], time: float) -> float:
    """Return a polynomial's value (Horner)."""
    result = 0.0
    for each in reversed(coefficients):
        result = result * time + each
    return result
