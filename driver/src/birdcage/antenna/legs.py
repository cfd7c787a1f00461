"""The way to a direction on a dish whose moves queue: one command at a time, none that can't be called back for long.

What is under way when STOP comes must end by itself soon, or at a byte: so an axis that has further to go than the
model's `slew.least_deg` goes by one silent slew, and shorter ways go one axis after the other
(`docs/decisions/0011-queued-dish.md`). Pure.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.antenna.mapped_way import mapped_motion, mapped_s
from birdcage.antenna.motion import DishMotion, move_axis, plan_axis
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.rotator.axis import Axis
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, Position


@dataclass(frozen=True, slots=True)
class Leg:
    """One command: where the dish stands after it, in its own degrees."""

    az_deg: float
    el_deg: float
    motor: int | None
    """The axis that moves; None for a silent slew of azimuth and elevation."""
    seconds: float
    """Mechanical seconds that it should take."""
    longest_s: float
    """The longest that it may take: the azimuth may turn the other way round where the cable demands it."""
    skew_deg: float | None = None
    """Where the skew stands after it, for the leg that turns it."""

    @property
    def is_silent(self) -> bool:
        """Whether nothing is sent while it lasts, as any byte may end it."""
        return self.motor is None

    @property
    def target_deg(self) -> float:
        """The angle of the axis that moves."""
        if self.skew_deg is not None:
            return self.skew_deg
        return self.az_deg if self.motor == MOTOR_AZIMUTH else self.el_deg


def plan_legs(
    model: Facts, start: Position, az_deg: float, el_deg: float, az_turn_deg: float | None, first: int
) -> tuple[Leg, ...]:
    """Return the legs from `start` to dish angles; empty when the dish is there, to a step.

    `az_turn_deg` is how far the azimuth turns where the turn of the cable tells, else None: then a way across north
    may be gone the other way round. Of two single moves, the motor `first` goes first.
    """
    if model.mapping is not None:
        seconds = mapped_s(model, start, az_deg, el_deg)
        return (Leg(az_deg, el_deg, None, seconds, seconds),) if seconds else ()
    turn = shortest_turn(start.azimuth, az_deg) if az_turn_deg is None else az_turn_deg
    climb = el_deg - start.elevation
    furthest = turn
    if az_turn_deg is None and not 0.0 <= start.azimuth + turn < 360.0:
        furthest = 360.0 - abs(turn)
    az_s, climb_s = _seconds(model.azimuth, turn), _seconds(model.elevation, climb)
    # Where no cable is known to wind up, only a way across north may be gone the other way round.
    in_doubt = az_turn_deg is None and (model.cable is not None or not 0.0 <= start.azimuth + turn <= 360.0)
    az_longest_s = max(az_s, _seconds(model.azimuth, 360.0 - abs(turn)) if in_doubt else 0.0)
    if model.slew is not None and max(abs(furthest), abs(climb)) > model.slew.least_deg:
        return (Leg(az_deg, el_deg, None, max(az_s, climb_s), az_longest_s + climb_s),)
    moves_az, moves_el = abs(turn) >= model.azimuth.step_deg / 2, abs(climb) >= model.elevation.step_deg / 2
    legs: list[Leg] = []
    at_az, at_el = start.azimuth, start.elevation
    for motor in (MOTOR_AZIMUTH, MOTOR_ELEVATION) if first == MOTOR_AZIMUTH else (MOTOR_ELEVATION, MOTOR_AZIMUTH):
        if motor == MOTOR_AZIMUTH and moves_az:
            at_az = az_deg
            legs.append(Leg(at_az, at_el, motor, az_s, az_longest_s))
        elif motor == MOTOR_ELEVATION and moves_el:
            at_el = el_deg
            legs.append(Leg(at_az, at_el, motor, climb_s, climb_s))
    return tuple(legs)


def skew_leg(model: Facts, start: Position, deg: float) -> Leg:
    """Return the leg that turns the skew. MotionRefused (`unsupported`) on a dish without that axis."""
    axis = model.skew
    if axis is None:
        raise MotionRefused(f"The {model.name} has no skew axis. Nothing was sent.", reason=Reason.UNSUPPORTED)
    way = axis.max_deg - axis.min_deg if start.skew is None else deg - start.skew
    seconds = _seconds(axis, way)
    return Leg(start.azimuth, start.elevation, axis.index, seconds, seconds, skew_deg=deg)


def leg_motion(
    model: Facts, start: Position, leg: Leg, az_turn_deg: float | None, now: float, *, start_known: bool = True
) -> DishMotion:
    """Model a leg that begins now."""
    if model.mapping is not None:
        return mapped_motion(model, start, leg.az_deg, leg.el_deg, now, start_known=start_known)
    az_end, el_end, skew = start.azimuth, start.elevation, None
    if leg.skew_deg is not None and model.skew is not None:
        skew = move_axis(model.skew, leg.skew_deg if start.skew is None else start.skew, leg.skew_deg, now)
    elif leg.motor in (None, MOTOR_AZIMUTH):
        az_end += shortest_turn(start.azimuth, leg.az_deg) if az_turn_deg is None else az_turn_deg
    if leg.motor in (None, MOTOR_ELEVATION):
        el_end = leg.el_deg
    return DishMotion(
        move_axis(model.azimuth, start.azimuth, az_end, now), move_axis(model.elevation, start.elevation, el_end, now),
        skew, silent=leg.is_silent, longest_s=leg.longest_s, start_known=start_known,
    )  # fmt: skip


def _seconds(axis: Axis, way_deg: float) -> float:
    return plan_axis(axis, 0.0, way_deg).duration_s
