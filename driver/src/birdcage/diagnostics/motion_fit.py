"""Fits how fast an axis goes, and how hard it speeds up, to positions that were read while it moved."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias

from birdcage.kinematics import Slew, plan_slew

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array: TypeAlias = NDArray[np.float64]

AWAY_DEG = 0.15
"""A reading that is no further from either end was taken at rest: an axis overshoots by 0.06."""
FEWEST = 6
"""So many readings in motion are needed at least."""
FEWEST_EACH = 3
"""So many of them must lie where the axis goes at its greatest speed, to tell that; and so many on its ramps."""
GAIN = 8.0
"""That it reaches a greatest speed counts where it explains the readings so much better: F of one more number."""
MOST_SHARE = 0.25
"""A figure that is no surer than this share of itself is not told."""
STEPS = 40
FURTHEST = 5.0
"""Readings that lie so many times the usual residual off are left out: a digit was damaged on its way."""
LEAST_OUTLIER_DEG = 0.5
UNLIMITED_DEG_S = 1e6
MOST_DAMPED = 1e9
LEAST_SLOPE = 1e-9
"""Where no reading changes by more degrees for a number, they do not tell it."""


@dataclass(frozen=True, slots=True)
class TimedReading:
    """A position, and the exchange in which it was read: somewhere between the question and its answer."""

    asked_s: float
    answered_s: float
    deg: float

    @property
    def middle_s(self) -> float:
        """The middle of the exchange."""
        return (self.asked_s + self.answered_s) / 2.0


@dataclass(frozen=True, slots=True)
class MeasuredWay:
    """One way of an axis from rest to rest, and what was read on it."""

    start_deg: float
    end_deg: float
    """Where it came to rest, as read: not where it was sent."""
    readings: tuple[TimedReading, ...]

    @property
    def in_motion(self) -> tuple[TimedReading, ...]:
        """The readings between both ends, with one neighbour on either side."""
        moving = [
            index for index, each in enumerate(self.readings)
            if min(abs(each.deg - self.start_deg), abs(each.deg - self.end_deg)) > AWAY_DEG
        ]  # fmt: skip
        return self.readings[max(moving[0] - 1, 0) : moving[-1] + 2] if moving else ()


@dataclass(frozen=True, slots=True)
class MotionFit:
    """What the readings tell: degrees and seconds. A figure that they do not tell is None, and so is its sigma."""

    speed_deg_s: float | None
    speed_sigma: float | None
    acceleration_deg_s2: float | None
    acceleration_sigma: float | None
    rms_deg: float
    readings: int
    """How many of them it goes by."""


NOTHING = MotionFit(None, None, None, None, 0.0, 0)


def fit_motion(ways: Sequence[MeasuredWay]) -> MotionFit:
    """Fit one speed and one acceleration to ways of the same axis in the same direction; `NOTHING` of too few readings.

    Least squares of the readings against `plan_slew`, by Levenberg and Marquardt with a numeric Jacobian. Unknown are
    the speed, the acceleration, when each way began, and at which share of an exchange the dish takes its reading: that
    one counts for all. Where ways never reach a greatest speed there is none to be told, and only the acceleration is.
    """
    ways = [replace(way, readings=way.in_motion) for way in ways]
    ways = [way for way in ways if way.readings]
    if sum(len(way.readings) for way in ways) < FEWEST:
        return NOTHING
    found = _best(ways)
    limit_deg = max(FURTHEST * 1.48 * _median([abs(each) for each in found.residuals]), LEAST_OUTLIER_DEG)
    if any(abs(each) > limit_deg for each in found.residuals):
        off = iter(found.residuals)
        ways = [replace(way, readings=tuple(each for each in way.readings if abs(next(off)) <= limit_deg))
                for way in ways]  # fmt: skip
        if sum(len(way.readings) for way in ways) < FEWEST or not all(way.readings for way in ways):
            return NOTHING
        found = _best(ways)
    return found.told()


@dataclass(frozen=True)
class _Timed:
    """The readings of a way as numbers to count with."""

    way: MeasuredWay
    asked_s: Array
    lasted_s: Array
    deg: Array

    @classmethod
    def of(cls, way: MeasuredWay) -> _Timed:
        import numpy as np

        asked = np.array([each.asked_s for each in way.readings])
        answered = np.array([each.answered_s for each in way.readings])
        return cls(way, asked, answered - asked, np.array([each.deg for each in way.readings]))

    def after_s(self, values: Sequence[float], start_s: float) -> Array:
        """Return how long after its start each reading was taken."""
        return self.asked_s + values[1] * self.lasted_s - start_s

    def off(self, slew: Slew, after_s: Array) -> Array:
        """Return how far each reading lies from a plan."""
        import numpy as np

        at = np.where(after_s > 0.0, self.way.end_deg, self.way.start_deg)
        begin_s = 0.0
        for each in slew.segments:
            t = after_s - begin_s
            there = each.position_deg + each.velocity_deg_s * t + each.acceleration_deg_s2 * t * t / 2.0
            at = np.where((t > 0.0) & (t <= each.duration_s), there, at)
            begin_s += each.duration_s
        off: Array = at - self.deg
        return off


@dataclass(frozen=True)
class _Found:
    ways: Sequence[_Timed]
    values: tuple[float, ...]
    """log acceleration, share of the exchange, start of each way, and log speed unless it is not reached."""
    residuals: tuple[float, ...]
    sigmas: tuple[float, ...]

    @property
    def reaches_speed(self) -> bool:
        return len(self.values) > len(self.ways) + 2

    @property
    def square(self) -> float:
        return sum(each * each for each in self.residuals)

    def readings_where(self, *, at_speed: bool) -> int:
        """How many readings lie where it goes at its greatest speed; else, where it speeds up or brakes."""
        count = 0
        for way, slew, start_s in _planned(self.ways, self.values):
            ramp_s = slew.segments[0].duration_s if slew.segments else 0.0
            for after_s in way.after_s(self.values, start_s):
                if 0.0 < after_s < slew.duration_s:
                    count += bool(ramp_s <= after_s <= slew.duration_s - ramp_s) is at_speed
        return count

    def told(self) -> MotionFit:
        """Return it for others; what is not sure is left out."""
        acceleration, sigma = math.exp(self.values[0]), self.sigmas[0]
        sure = sigma <= MOST_SHARE and self.readings_where(at_speed=False) >= FEWEST_EACH
        speed = math.exp(self.values[-1]) if self.reaches_speed and self.sigmas[-1] <= MOST_SHARE else None
        return MotionFit(
            speed, None if speed is None else speed * self.sigmas[-1],
            acceleration if sure else None, acceleration * sigma if sure else None,
            math.sqrt(self.square / len(self.residuals)), len(self.residuals),
        )  # fmt: skip


def _best(ways: Sequence[MeasuredWay]) -> _Found:
    """Return the better of both models: with a greatest speed that is reached, or without."""
    pace_deg_s = _pace(ways)
    timed = [_Timed.of(way) for way in ways]
    without = min((_fit(timed, pace_deg_s / ramp_s, None) for ramp_s in (0.1, 0.4, 1.6)), key=lambda each: each.square)
    reached = [_fit(timed, pace_deg_s / ramp_s, pace_deg_s) for ramp_s in (0.05, 0.2, 0.8)]
    with_speed = min(reached, key=lambda each: each.square)
    left = len(with_speed.residuals) - len(with_speed.values)
    gain = (without.square - with_speed.square) / max(with_speed.square / max(left, 1), 1e-12)
    reaches = gain > GAIN and left > 0 and with_speed.readings_where(at_speed=True) >= FEWEST_EACH
    return with_speed if reaches else without


def _pace(ways: Sequence[MeasuredWay]) -> float:
    """Return the greatest mean rate over a third of the readings of a way: a first guess at its speed."""
    best = 1e-3
    for way in ways:
        several = max(len(way.readings) // 3, 1)
        for one, other in zip(way.readings, way.readings[several:], strict=False):
            apart_s = other.middle_s - one.middle_s
            best = max(best, abs(other.deg - one.deg) / apart_s if apart_s > 0.0 else 0.0)
    return best


def _planned(ways: Sequence[_Timed], values: Sequence[float]) -> Sequence[tuple[_Timed, Slew, float]]:
    """Return each way with its plan by these values, and when that begins."""
    acceleration = math.exp(min(values[0], 20.0))
    speed = math.exp(min(values[-1], 20.0)) if len(values) > len(ways) + 2 else UNLIMITED_DEG_S
    return [
        (each, plan_slew(each.way.start_deg, each.way.end_deg, speed, acceleration), values[2 + index])
        for index, each in enumerate(ways)
    ]


def _fit(ways: Sequence[_Timed], acceleration: float, speed: float | None) -> _Found:
    """Fit from a first guess: x + dx with (J'J + w diag(J'J)) dx = -J'r; w falls on a step that helps, else grows."""
    import numpy as np

    starts = [_begun(each.way, acceleration, speed or UNLIMITED_DEG_S) for each in ways]
    values = np.array([math.log(acceleration), 0.5, *starts, *([] if speed is None else [math.log(speed)])])

    def off(at: Array) -> Array:
        told = [float(each) for each in at]
        return np.concatenate([
            way.off(slew, way.after_s(told, start_s)) for way, slew, start_s in _planned(ways, told)
        ])  # fmt: skip

    residuals, weight = off(values), 1e-3
    slopes = _slopes(off, values)
    for _ in range(STEPS):
        square, steep = float(residuals @ residuals), slopes.T @ slopes
        damped = steep + weight * np.diag(np.maximum(np.diag(steep), 1e-9))
        step = np.clip(np.linalg.lstsq(damped, -slopes.T @ residuals, rcond=None)[0], -1.0, 1.0)
        tried = values + step
        tried[1] = min(max(tried[1], 0.0), 1.0)
        there = off(tried)
        gained = square - float(there @ there)
        if gained > 0.0:
            values, residuals, weight = tried, there, max(weight / 5.0, 1e-9)
            slopes = _slopes(off, values)
            if gained < 1e-9 * square:
                break
        elif weight > MOST_DAMPED:
            break
        else:
            weight *= 5.0
    left = len(residuals) - len(values)
    spread = float(residuals @ residuals) / left if left > 0 else math.inf
    inverse = np.linalg.pinv(slopes.T @ slopes)
    tells = np.abs(slopes).max(axis=0) > LEAST_SLOPE
    sigmas = [
        math.sqrt(max(spread * float(inverse[at, at]), 0.0)) if told else math.inf for at, told in enumerate(tells)
    ]
    return _Found(ways, tuple(map(float, values)), tuple(map(float, residuals)), tuple(sigmas))


def _begun(way: MeasuredWay, acceleration: float, speed: float) -> float:
    """Return when a way began if it passed its middle when the reading nearest to that was taken."""
    middle_deg = (way.start_deg + way.end_deg) / 2.0
    near = min(way.readings, key=lambda each: abs(each.deg - middle_deg))
    slew = plan_slew(way.start_deg, way.end_deg, speed, acceleration)
    passed_s = slew.duration_s / 2.0 + (near.deg - middle_deg) / max(abs(slew.at(slew.duration_s / 2.0)[1]), 1e-6) * (
        math.copysign(1.0, way.end_deg - way.start_deg)
    )
    return near.middle_s - passed_s


def _slopes(off: Callable[[Array], Array], values: Array) -> Array:
    import numpy as np

    columns = []
    for index in range(len(values)):
        step = np.zeros(len(values))
        step[index] = 1e-5
        columns.append((off(values + step) - off(values - step)) / 2e-5)
    return np.column_stack(columns)


def _median(values: Sequence[float]) -> float:
    return sorted(values)[len(values) // 2]
