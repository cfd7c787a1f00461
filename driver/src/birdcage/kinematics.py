"""How an axis moves: trapezoidal velocity, for planning, arrival times and stopping points.

That a G2 moves so is assumed, from its settings 80, 81 and 85 (`docs/reference/g2-motors.md`, *Speeds*). The simulator
has its own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Segment:
    """A stretch of constant acceleration, from a state at its start."""

    duration_s: float
    position_deg: float
    velocity_deg_s: float
    acceleration_deg_s2: float

    def at(self, t_s: float) -> tuple[float, float]:
        """Return position and velocity `t_s` after the segment's start."""
        position = self.position_deg + self.velocity_deg_s * t_s + self.acceleration_deg_s2 * t_s * t_s / 2
        return position, self.velocity_deg_s + self.acceleration_deg_s2 * t_s


@dataclass(frozen=True, slots=True)
class Slew:
    """One axis on its way; `end_deg` is where it comes to rest."""

    end_deg: float
    segments: tuple[Segment, ...]

    @property
    def duration_s(self) -> float:
        """Return the time until the axis rests."""
        return sum(segment.duration_s for segment in self.segments)

    def at(self, t_s: float) -> tuple[float, float]:
        """Return position (deg) and velocity (deg/s) `t_s` after the start; at rest at the end ever after."""
        left = max(t_s, 0.0)
        for segment in self.segments:
            if left <= segment.duration_s:
                return segment.at(left)
            left -= segment.duration_s
        return self.end_deg, 0.0


def plan_slew(
    start_deg: float, end_deg: float, speed_deg_s: float, acceleration_deg_s2: float, velocity_deg_s: float = 0.0
) -> Slew:
    """Plan the quickest slew to rest at `end_deg`, from `start_deg` with `velocity_deg_s`.

    If the axis moves away from the target, or too fast to stop before it, it brakes first and comes back.
    """
    segments: list[Segment] = []
    position, velocity = start_deg, velocity_deg_s
    brake_deg = velocity * abs(velocity) / (2 * acceleration_deg_s2)
    way = end_deg - position
    if velocity and (way * velocity <= 0 or abs(way) < abs(brake_deg)):
        segments.append(
            Segment(
                abs(velocity) / acceleration_deg_s2, position, velocity, -math.copysign(acceleration_deg_s2, velocity)
            )
        )
        position, velocity = position + brake_deg, 0.0
        way = end_deg - position
    sign = math.copysign(1.0, way)
    v0 = abs(velocity)
    peak = min(speed_deg_s, math.sqrt(max(0.0, acceleration_deg_s2 * abs(way) + v0 * v0 / 2)))
    peak = max(peak, v0)
    ramp_up_deg = (peak * peak - v0 * v0) / (2 * acceleration_deg_s2)
    ramp_down_deg = peak * peak / (2 * acceleration_deg_s2)
    cruise_deg = max(0.0, abs(way) - ramp_up_deg - ramp_down_deg)
    for duration, v, a in (
        ((peak - v0) / acceleration_deg_s2, v0, acceleration_deg_s2),
        (cruise_deg / peak if peak else 0.0, peak, 0.0),
        (peak / acceleration_deg_s2, peak, -acceleration_deg_s2),
    ):
        if duration > 0:
            segment = Segment(duration, position, sign * v, sign * a)
            segments.append(segment)
            position = segment.at(duration)[0]
    return Slew(end_deg, tuple(segments))


def plan_timed(start_deg: float, end_deg: float, duration_s: float) -> Slew:
    """Plan a slew of which only the duration is known: half of it speeding up, half slowing down."""
    way = end_deg - start_deg
    if way == 0.0 or duration_s <= 0.0:
        return Slew(end_deg, ())
    half = duration_s / 2
    acceleration = way / (half * half)
    first = Segment(half, start_deg, 0.0, acceleration)
    return Slew(end_deg, (first, Segment(half, *first.at(half), -acceleration)))


def rest_point(position_deg: float, velocity_deg_s: float, acceleration_deg_s2: float, latency_s: float) -> float:
    """Return where an axis can come to rest: position + v x latency + v^2/2a, in the direction of travel."""
    return position_deg + velocity_deg_s * latency_s + velocity_deg_s * abs(velocity_deg_s) / (2 * acceleration_deg_s2)
