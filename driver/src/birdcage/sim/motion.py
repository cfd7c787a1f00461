"""Motion of one axis in closed form: trapezoids that start from any position and speed.

Nothing here ticks. A motion is planned once; where the axis is at an instant is computed when somebody looks.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

TOUCH_DEG = 1e-9
"""An axis that comes to rest at a position does not go beyond it, whatever the last digit says."""


@dataclass(frozen=True, slots=True)
class MotionPhase:
    """A stretch of constant acceleration."""

    start_s: float
    position_deg: float
    rate_deg_s: float
    accel_deg_s2: float


@dataclass(frozen=True, slots=True)
class MotionProfile:
    """From where the axis was to where it comes to rest. Times are seconds of dish time."""

    legs: tuple[MotionPhase, ...]
    end_s: float
    rest_deg: float
    direction: int
    """Of the final approach: +1, -1, or 0 for no motion at all."""

    @property
    def start_s(self) -> float:
        """When it begins; before that the axis stands where it begins."""
        return self.legs[0].start_s if self.legs else self.end_s

    def at(self, time_s: float) -> tuple[float, float]:
        """Return position in degrees and rate in degrees per second."""
        if time_s >= self.end_s:
            return self.rest_deg, 0.0
        current = self.legs[0]
        for leg in self.legs[1:]:
            if leg.start_s > time_s:
                break
            current = leg
        elapsed = max(time_s - current.start_s, 0.0)
        rate = current.rate_deg_s + current.accel_deg_s2 * elapsed
        return current.position_deg + (current.rate_deg_s + rate) / 2 * elapsed, rate

    def turning_point(self) -> tuple[float, float] | None:
        """Return (time, position) where it reverses, or None when it goes one way all along."""
        if not self.legs:
            return None
        first = self.legs[0]
        if first.rate_deg_s * self.direction >= 0.0 or first.accel_deg_s2 == 0.0:
            return None
        elapsed = -first.rate_deg_s / first.accel_deg_s2
        if first.start_s + elapsed >= self.end_s:
            return None
        return first.start_s + elapsed, first.position_deg + first.rate_deg_s * elapsed / 2

    def passes(self, position_deg: float, direction: int) -> float | None:
        """Return when it first goes beyond a position in a direction (+1 or -1); None when it never does."""
        ends = [*(leg.start_s for leg in self.legs[1:]), self.end_s]
        for leg, end_s in zip(self.legs, ends, strict=False):
            ahead = (position_deg - leg.position_deg) * direction + TOUCH_DEG
            rate, accel = leg.rate_deg_s * direction, leg.accel_deg_s2 * direction
            after = _crossing(ahead, rate, accel)
            if after is not None and leg.start_s + after < end_s:
                return leg.start_s + after
        return None

    def cut(self, time_s: float, position_deg: float, direction: int) -> MotionProfile:
        """Return it as it ends when it runs into something."""
        return MotionProfile(tuple(leg for leg in self.legs if leg.start_s < time_s), time_s, position_deg, direction)

    def travelled(self, from_s: float, to_s: float) -> tuple[float, float]:
        """Return how many degrees it turned, to and fro, and for how many seconds, between two instants."""
        start, end = max(from_s, self.start_s), min(to_s, self.end_s)
        if end <= start:
            return 0.0, 0.0
        places = [self.at(start)[0], self.at(end)[0]]
        turn = self.turning_point()
        if turn is not None and start < turn[0] < end:
            places.insert(1, turn[1])
        return sum(abs(b - a) for a, b in itertools.pairwise(places)), end - start


def _crossing(ahead_deg: float, rate_deg_s: float, accel_deg_s2: float) -> float | None:
    """Return the time after which something `ahead_deg` away is passed, going outward; None for never."""
    if ahead_deg <= 0.0 and (rate_deg_s > 0.0 or (rate_deg_s == 0.0 and accel_deg_s2 > 0.0)):
        return 0.0
    if accel_deg_s2 == 0.0:
        return ahead_deg / rate_deg_s if rate_deg_s > 0.0 else None
    square = rate_deg_s**2 + 2 * accel_deg_s2 * ahead_deg
    if square < 0.0 and accel_deg_s2 < 0.0:
        return None
    after = (math.sqrt(max(square, 0.0)) - rate_deg_s) / accel_deg_s2
    return after if after >= 0.0 else None


def at_rest(time_s: float, position_deg: float) -> MotionProfile:
    """Return a motion that stands still."""
    return MotionProfile((), time_s, position_deg, 0)


def stopping_point(position_deg: float, rate_deg_s: float, accel_deg_s2: float) -> float:
    """Return where the axis comes to rest if it brakes now."""
    return position_deg + rate_deg_s * abs(rate_deg_s) / (2 * accel_deg_s2)


def plan(
    time_s: float, position_deg: float, rate_deg_s: float, target_deg: float, max_rate_deg_s: float, accel_deg_s2: float
) -> MotionProfile:
    """Plan the quickest motion to `target_deg` that changes its rate by `accel_deg_s2` only: no jumps in rate.

    An axis that cannot stop in time passes the target and comes back.
    """
    overrun = target_deg - stopping_point(position_deg, rate_deg_s, accel_deg_s2)
    lead = overrun or rate_deg_s
    sign = 1 if lead > 0 else -1
    if lead == 0.0:
        return at_rest(time_s, target_deg)
    distance = (target_deg - position_deg) * sign
    rate = rate_deg_s * sign
    peak = math.sqrt(max(accel_deg_s2 * distance + rate * rate / 2, 0.0))
    cruise_s = 0.0
    if peak > max_rate_deg_s:
        peak = max_rate_deg_s
        to_peak_deg = abs(peak * peak - rate * rate) / (2 * accel_deg_s2)
        to_rest_deg = peak * peak / (2 * accel_deg_s2)
        cruise_s = max(distance - to_peak_deg - to_rest_deg, 0.0) / peak
    legs: list[MotionPhase] = []
    now, where = time_s, position_deg
    spans = (
        (abs(peak - rate) / accel_deg_s2, rate, math.copysign(accel_deg_s2, peak - rate)),
        (cruise_s, peak, 0.0),
        (peak / accel_deg_s2, peak, -accel_deg_s2),
    )
    for span_s, start_rate, accel in spans:
        if span_s > 0.0:
            legs.append(MotionPhase(now, where, start_rate * sign, accel * sign))
            where += (start_rate + accel * span_s / 2) * span_s * sign
            now += span_s
    return MotionProfile(tuple(legs), now, target_deg, sign)
