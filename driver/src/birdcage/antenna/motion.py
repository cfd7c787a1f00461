"""A motion under way, as modelled: when it arrives, and where STOP must aim."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, replace

from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.kinematics import Slew, plan_slew, plan_timed, rest_point
from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import MOTOR_AZIMUTH, Position

STOP_LATENCY_S = 0.1
"""The longest that a STOP line normally takes to act on a retargetable dish (20 to 100 ms, assumed)."""
AGAINST_DEG_S = 2.0
"""A mean rate above this tells the direction: noise and overshoot are slower."""
MODEL_TRUST_DEG = 1.0
"""A position that was read within this of the model's confirms the model."""
STREAM_AGAINST_DEG = 2.0
"""In a stream the dish is now ahead of its target and now behind: only so far from it the direction tells anything."""


def plan_axis(axis: Axis, start_deg: float, end_deg: float, velocity_deg_s: float = 0.0) -> Slew:
    """Plan the way of one axis: by the times that were measured for it, else by its speed and acceleration."""
    if axis.times is not None:
        return plan_timed(start_deg, end_deg, axis.times.seconds(end_deg - start_deg))
    return plan_slew(start_deg, end_deg, axis.speed_deg_s, axis.acceleration_deg_s2, velocity_deg_s)


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
    streamed: bool = False
    """Whether it was sent as one of a stream, with a new target before the last one was reached."""
    trusted: bool = True
    """Whether the last reading before a streamed command was where the model had the axis."""
    longest_s: float = 0.0
    """How long its way takes at the longest, where the turn of the cable is not known; mechanical seconds."""

    def modelled(self, now: float, rate: float) -> tuple[float, float]:
        """Return where the model has the axis, and its velocity, in mechanical seconds."""
        return self.slew.at((now - self.started) * rate)

    @property
    def least_speed_deg_s(self) -> float | None:
        """The least speed that it goes at, by its readings; infinite if it was not sent, None if they do not tell."""
        if not self.slew.segments:
            return math.inf
        return abs(self.rate_deg_s) / 2 if self.rate_deg_s and abs(self.rate_deg_s) > AGAINST_DEG_S else None

    def with_reading(self, angle_deg: float, at: float, rate: float) -> AxisMotion:
        """Take in an angle that was read at `at`."""
        unrolled = self.read_deg + shortest_turn(self.read_deg, angle_deg)
        elapsed_s = (at - self.read_at) * rate
        mean = (unrolled - self.read_deg) / elapsed_s if elapsed_s > 0 else None
        seen = replace(self, read_deg=unrolled, read_at=at, rate_deg_s=mean)
        return seen.other_way_round(mean) if mean is not None and self._turns_against(unrolled, mean) else seen

    def _turns_against(self, now_deg: float, mean_deg_s: float) -> bool:
        """Return whether the azimuth turns the other way than modelled: the turn of the cable was not known.

        It left the target behind with the reading before, and clearly: an axis that overshoots is a little beyond it.
        """
        left_deg, left_before_deg = self.slew.end_deg - now_deg, self.slew.end_deg - self.read_deg
        return (
            self.axis.index == MOTOR_AZIMUTH
            and abs(mean_deg_s) > AGAINST_DEG_S
            and (not self.streamed or abs(left_deg) > STREAM_AGAINST_DEG)
            and left_deg * mean_deg_s < 0
            and left_before_deg * mean_deg_s < 0
            and abs(left_before_deg) >= MODEL_TRUST_DEG
        )

    def other_way_round(self, mean_deg_s: float) -> AxisMotion:
        """Return the motion to the same azimuth on the next turn of the cable, in the direction of `mean_deg_s`."""
        end = self.slew.end_deg + math.copysign(360.0, mean_deg_s)
        axis = self.axis
        velocity = max(-axis.speed_deg_s, min(axis.speed_deg_s, mean_deg_s))
        return replace(self, slew=plan_axis(axis, self.read_deg, end, velocity), started=self.read_at)

    def is_as_modelled(self, rate: float) -> bool:
        """Return whether the last reading lies where the model has the axis, give or take the latency."""
        if self.streamed and self.read_at < self.started:
            return self.trusted
        low, high = sorted(self.modelled(self.read_at - early_s, rate)[0] for early_s in (0.0, STOP_LATENCY_S))
        return low - MODEL_TRUST_DEG <= self.read_deg <= high + MODEL_TRUST_DEG

    def eta(self, rate: float) -> float:
        """Return the monotonic time of arrival: as modelled, or at the mean rate that was seen if that contradicts."""
        modelled = self.started + self.slew.duration_s / rate
        if self.is_as_modelled(rate) or not self.rate_deg_s:
            return modelled
        return max(modelled, self.read_at + abs(self.slew.end_deg - self.read_deg) / abs(self.rate_deg_s) / rate)

    def ends_by(self, rate: float) -> float:
        """Return the monotonic time at which it stands whichever way round it goes."""
        return max(self.eta(rate), self.started + self.longest_s / rate)

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
        if not self.is_as_modelled(rate) and self.rate_deg_s is not None:
            elapsed_s = (now - self.read_at) * rate
            sign = math.copysign(1.0, self.rate_deg_s)
            speed = min(axis.speed_deg_s, abs(self.rate_deg_s) + axis.acceleration_deg_s2 * elapsed_s)
            # However long nothing was read, the axis is not beyond where it was sent.
            left_deg = max(0.0, sign * (end - self.read_deg))
            position, velocity = self.read_deg + sign * min(speed * elapsed_s, left_deg), sign * speed
        aim = rest_point(position, velocity, axis.acceleration_deg_s2, latency_s)
        return min(aim, end) if end >= position else max(aim, end)


def move_axis(axis: Axis, begin_deg: float, end_deg: float, now: float, velocity_deg_s: float = 0.0) -> AxisMotion:
    """Return one axis that begins its way now."""
    return AxisMotion(axis, plan_axis(axis, begin_deg, end_deg, velocity_deg_s), now, begin_deg, now)


@dataclass(frozen=True, slots=True)
class DishMotion:
    """The axes on their way, in the dish's frame."""

    azimuth: AxisMotion
    elevation: AxisMotion
    skew: AxisMotion | None = None
    """None unless the skew turns."""
    silent: bool = False
    """All axes were sent in one go: nothing may be asked while it lasts, as any byte may end it."""
    longest_s: float = 0.0
    """How long it may take at the longest, whichever way round its azimuth goes; mechanical seconds."""
    together: bool = False
    """Whether its axes are known to turn at once."""
    start_known: bool = True
    """Whether it was known where it began; else its times are those of the longest way, and where it is stays unknown.
    """

    @property
    def axes(self) -> tuple[AxisMotion, ...]:
        """Azimuth, elevation and, where it turns, the skew."""
        return tuple(axis for axis in (self.azimuth, self.elevation, self.skew) if axis is not None)

    @property
    def eta_known(self) -> bool:
        """Whether the speeds of what moves are known: else `eta` is only when it should rest at the latest."""
        return all(axis.axis.speed_known for axis in self.axes if axis.slew.segments)

    def over_by(self, rate: float) -> float:
        """Return the monotonic time at which it is over at the latest: whichever way round, and in turn."""
        last = max(axis.started for axis in self.axes)
        times = [max(axis.slew.duration_s, axis.longest_s) for axis in self.axes]
        return last + (max(times) if self.together else sum(times)) / rate

    def begun(self, motor: int, now: float) -> DishMotion:
        """Return the motion with one axis beginning its way only now."""
        if motor == MOTOR_AZIMUTH:
            return replace(self, azimuth=replace(self.azimuth, started=now))
        return replace(self, elevation=replace(self.elevation, started=now))

    def keeping(self, before: DishMotion, sent: Collection[int]) -> DishMotion:
        """Return it with the axes that are not `sent` anywhere going on as they did before."""
        azimuth = self.azimuth if self.azimuth.axis.index in sent else before.azimuth
        return replace(
            self, azimuth=azimuth, elevation=self.elevation if self.elevation.axis.index in sent else before.elevation
        )

    def eta(self, rate: float) -> float:
        """Return the monotonic time at which all axes should rest."""
        return max(axis.eta(rate) for axis in self.axes)

    def at(self, now: float, rate: float) -> Position:
        """Return where the model has the dish: azimuth in [0, 360); skew None unless it turns."""
        skew = None if self.skew is None else self.skew.modelled(now, rate)[0]
        az_deg, el_deg = self.azimuth.modelled(now, rate)[0], self.elevation.modelled(now, rate)[0]
        return Position(az_deg % 360.0, el_deg, skew)

    def with_reading(self, position: Position, at: float, rate: float) -> DishMotion:
        """Take in a position that was read at `at`."""
        skew = self.skew
        if skew is not None and position.skew is not None:
            skew = skew.with_reading(position.skew, at, rate)
        return replace(
            self,
            azimuth=self.azimuth.with_reading(position.azimuth, at, rate),
            elevation=self.elevation.with_reading(position.elevation, at, rate),
            skew=skew,
        )

    def stopped(self, now: float, rate: float) -> DishMotion:
        """Return the motion that a retarget to where the axes can come to rest makes of this one."""
        azimuth, elevation = (
            replace(axis, slew=axis.stopping_slew(now, rate), started=now) for axis in (self.azimuth, self.elevation)
        )
        return replace(self, azimuth=azimuth, elevation=elevation)

    @property
    def rest(self) -> tuple[float, float]:
        """Where both axes come to rest: dish azimuth in [0, 360), and elevation."""
        return self.azimuth.slew.end_deg % 360.0, self.elevation.slew.end_deg


def start_motion(
    model: Facts,
    start: Position,
    az_turn_deg: float,
    el_deg: float,
    now: float,
    velocity_deg_s: tuple[float, float] = (0.0, 0.0),
    *,
    first: int = MOTOR_AZIMUTH,
    rate: float = 1.0,
    turn_known: bool = True,
) -> DishMotion:
    """Model a motion from `start`, turning the azimuth by `az_turn_deg` and the elevation to `el_deg`.

    Where the axes move in turn, the motor `first` goes first. Unless `turn_known`, the azimuth may go round the other
    way.
    """
    azimuth = move_axis(model.azimuth, start.azimuth, start.azimuth + az_turn_deg, now, velocity_deg_s[0])
    if not turn_known and azimuth.slew.segments:
        round_deg = 360.0 - abs(az_turn_deg)
        azimuth = replace(azimuth, longest_s=plan_axis(model.azimuth, 0.0, round_deg).duration_s)
    elevation = move_axis(model.elevation, start.elevation, el_deg, now, velocity_deg_s[1])
    if not model.axes_together and first == model.azimuth.index:
        elevation = replace(elevation, started=now + azimuth.slew.duration_s / rate)
    elif not model.axes_together:
        azimuth = replace(azimuth, started=now + elevation.slew.duration_s / rate)
    longest_s = max(azimuth.slew.duration_s, azimuth.longest_s) + elevation.slew.duration_s
    return DishMotion(azimuth, elevation, longest_s=longest_s)


def longest_s(model: Facts) -> float:
    """Return how long a motion takes at the longest, from wherever to wherever, and in turn; mechanical seconds."""
    return sum(plan_axis(axis, axis.min_deg, axis.max_deg).duration_s for axis in (model.azimuth, model.elevation))


def stop_power_s(model: Facts) -> float:
    """Return how long a retarget needs to bring the faster axis to rest from top speed."""
    return STOP_LATENCY_S + max(
        axis.speed_deg_s / axis.acceleration_deg_s2 for axis in (model.azimuth, model.elevation)
    )


def rest_seen(
    facts: Facts, earlier: Position, earlier_at: float, later: Position, later_at: float, now: float, rate: float
) -> tuple[float, float]:
    """Return where both axes can come to rest, by two readings: dish azimuth in [0, 360), and elevation."""
    elapsed_s = max((later_at - earlier_at) * rate, 1e-3)
    lead_s = (now - later_at) * rate + STOP_LATENCY_S * rate
    az_rate = shortest_turn(earlier.azimuth, later.azimuth) / elapsed_s
    el_rate = (later.elevation - earlier.elevation) / elapsed_s
    az_deg = rest_point(later.azimuth, az_rate, facts.azimuth.acceleration_deg_s2, lead_s)
    return wrap_360(az_deg), rest_point(later.elevation, el_rate, facts.elevation.acceleration_deg_s2, lead_s)
