"""A motion under way, as modelled: when it arrives, and where STOP must aim."""

from __future__ import annotations

from dataclasses import dataclass, replace

from birdcage.kinematics import Slew, plan_slew, rest_point
from birdcage.protocol.model import Axis, DishModel
from birdcage.protocol.types import Position

STOP_LATENCY_S = 0.1
"""The longest that a STOP line normally takes to act on a retargetable dish (SEAMS *Figures*: 20 to 100 ms)."""
MODEL_TRUST_DEG = 1.0
"""A position that was read within this of the model's confirms the model."""


@dataclass(frozen=True, slots=True)
class AxisMotion:
    """One axis on its way, unrolled: `slew` may run beyond 0..360."""

    axis: Axis
    slew: Slew
    started: float
    read_deg: float
    """The last angle that was read, on the same unrolled scale."""
    read_at: float
    rate_deg_s: float | None = None
    """Mean rate between the last two readings; None before there were two."""

    def modelled(self, now: float, rate: float) -> tuple[float, float]:
        """Return where the model has the axis, and its velocity, in mechanical seconds."""
        return self.slew.at((now - self.started) * rate)

    def with_reading(self, angle_deg: float, at: float, rate: float) -> AxisMotion:
        """Take in an angle that was read at `at`."""
        unrolled = self.read_deg + (angle_deg - self.read_deg + 180.0) % 360.0 - 180.0
        expected = self.modelled(at, rate)[0]
        unrolled += 360.0 * round((expected - unrolled) / 360.0) if self.axis.index == 0 else 0.0
        elapsed_s = (at - self.read_at) * rate
        mean = (unrolled - self.read_deg) / elapsed_s if elapsed_s > 0 else None
        return replace(self, read_deg=unrolled, read_at=at, rate_deg_s=mean)

    def stopping_slew(self, now: float, rate: float) -> Slew:
        """Return the slew that brings the axis to rest at `stop_at`."""
        position, velocity = self.modelled(now, rate)
        axis = self.axis
        return plan_slew(position, self.stop_at(now, rate), axis.speed_deg_s, axis.acceleration_deg_s2, velocity)

    def stop_at(self, now: float, rate: float) -> float:
        """Return where to retarget so that the axis comes to rest ahead of itself, never behind, never beyond.

        The model leads the real axis by the latency, so its rest point is ahead. If the last reading contradicts the
        model (a slower or disturbed axis), the bound is taken from that reading and the greatest acceleration.
        """
        position, velocity = self.modelled(now, rate)
        latency_s = STOP_LATENCY_S * rate
        axis, end = self.axis, self.slew.end_deg
        if velocity == 0.0 and abs(self.read_deg - end) <= MODEL_TRUST_DEG:
            return end
        modelled_then = self.modelled(self.read_at, rate)[0]
        modelled_before = self.modelled(self.read_at - STOP_LATENCY_S, rate)[0]
        low, high = sorted((modelled_then, modelled_before))
        if not low - MODEL_TRUST_DEG <= self.read_deg <= high + MODEL_TRUST_DEG and self.rate_deg_s is not None:
            elapsed_s = (now - self.read_at) * rate
            sign = 1.0 if end >= self.read_deg else -1.0
            speed = min(axis.speed_deg_s, abs(self.rate_deg_s) + axis.acceleration_deg_s2 * elapsed_s)
            position, velocity = self.read_deg + sign * speed * elapsed_s, sign * speed
        aim = rest_point(position, velocity, axis.acceleration_deg_s2, latency_s)
        return min(aim, end) if end >= position else max(aim, end)


@dataclass(frozen=True, slots=True)
class DishMotion:
    """Both axes on their way, in the dish's frame."""

    azimuth: AxisMotion
    elevation: AxisMotion

    def eta(self, rate: float) -> float:
        """Return the monotonic time at which both axes should rest."""
        return max(axis.started + axis.slew.duration_s / rate for axis in (self.azimuth, self.elevation))

    def with_reading(self, position: Position, at: float, rate: float) -> DishMotion:
        """Take in a position that was read at `at`."""
        return DishMotion(
            self.azimuth.with_reading(position.azimuth, at, rate),
            self.elevation.with_reading(position.elevation, at, rate),
        )

    def stopped(self, now: float, rate: float) -> DishMotion:
        """Return the motion that a retarget to where the axes can come to rest makes of this one."""
        return DishMotion(
            *(replace(axis, slew=axis.stopping_slew(now, rate), started=now) for axis in (self.azimuth, self.elevation))
        )

    @property
    def rest(self) -> tuple[float, float]:
        """Where both axes come to rest: dish azimuth in [0, 360), and elevation."""
        return self.azimuth.slew.end_deg % 360.0, self.elevation.slew.end_deg


def start_motion(
    model: DishModel,
    start: Position,
    az_turn_deg: float,
    el_deg: float,
    now: float,
    velocity_deg_s: tuple[float, float] = (0.0, 0.0),
) -> DishMotion:
    """Model a motion from `start`, turning the azimuth by `az_turn_deg` and the elevation to `el_deg`."""

    def axis_motion(axis: Axis, begin: float, end: float, velocity: float) -> AxisMotion:
        slew = plan_slew(begin, end, axis.speed_deg_s, axis.acceleration_deg_s2, velocity)
        return AxisMotion(axis, slew, now, begin, now)

    return DishMotion(
        axis_motion(model.azimuth, start.azimuth, start.azimuth + az_turn_deg, velocity_deg_s[0]),
        axis_motion(model.elevation, start.elevation, el_deg, velocity_deg_s[1]),
    )


def stop_power_s(model: DishModel) -> float:
    """Return how long a retarget needs to bring the faster axis to rest from top speed."""
    return STOP_LATENCY_S + max(
        axis.speed_deg_s / axis.acceleration_deg_s2 for axis in (model.azimuth, model.elevation)
    )
