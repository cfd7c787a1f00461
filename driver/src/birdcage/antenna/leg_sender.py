"""Sends a dish its legs, each through the gate and modelled before its first byte."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.legs import Leg, leg_motion, plan_legs, skew_leg
from birdcage.antenna.reckoning import farthest
from birdcage.antenna.sender import Without
from birdcage.rotator.values import MOTOR_AZIMUTH, Position


@dataclass(frozen=True, slots=True)
class LegPlan:
    """The legs to a direction, which is true; none when the dish is there."""

    legs: tuple[Leg, ...]
    az_deg: float
    el_deg: float


class LegSender:
    """What a station uses instead of `BirdcageAntenna.point` on a dish whose moves queue."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        self._antenna = antenna

    def plan(self, az_deg: float, el_deg: float, *, leapfrog: bool = False, clamp: bool = False) -> LegPlan:
        """Read the position and return the way to a true direction.

        Raises as `BirdcageAntenna.point`. Nothing is sent that moves.
        """
        antenna, clock = self._antenna, self._antenna.rotator.clock
        if antenna.motion is None:
            antenna.reckoning.refuse_on_its_way(clock.monotonic())
        dish = antenna.aim(az_deg, el_deg, leapfrog=leapfrog, clamp=clamp)
        start = antenna.gate.position or farthest(antenna.model, *dish)
        legs = plan_legs(antenna.model, start, *dish, antenna.turn_known(dish[0]), antenna.first_motor())
        return LegPlan(legs, *antenna.alignment.to_true(*dish))

    def plan_skew(self, deg: float) -> LegPlan:
        """Read the position and return the way of the skew. MotionRefused on a dish without that axis."""
        here = self._antenna.get_position()
        leg = skew_leg(self._antenna.model, self._start, deg)
        return LegPlan((leg,) if leg.seconds else (), here.azimuth, here.elevation)

    def seconds(self, start: Position, az_deg: float, el_deg: float) -> float:
        """Return about how long the way takes from somewhere (dish angles) to a true direction."""
        dish_az, dish_el = self._antenna.alignment.to_dish(az_deg, el_deg)
        return sum(leg.seconds for leg in plan_legs(self._antenna.model, start, dish_az, dish_el, None, 0))

    def send(self, leg: Leg) -> None:
        """Send one leg; returns when the dish has taken it, or as soon as it is sent if it is silent.

        Stopped, CommandRefused and MotionRefused: nothing of it moves, but after `half_sent`.
        """
        antenna, rotator = self._antenna, self._antenna.rotator
        now, known = rotator.clock.monotonic(), antenna.gate.position
        start = known or farthest(antenna.model, leg.az_deg, leg.el_deg)
        turn_deg = antenna.turn_known(leg.az_deg)
        with antenna.begun(leg_motion(antenna.model, start, leg, turn_deg, now, start_known=known is not None)):
            if leg.motor is None:
                antenna.gate.check(leg.az_deg, leg.el_deg)
                rotator.begin_slew(leg.az_deg, leg.el_deg, antenna.skew.to_name(start, now))
                antenna.reckon_move()
            elif leg.skew_deg is not None:
                self._turn_skew(leg.motor, leg.skew_deg)
            else:
                stands = self._start.azimuth if leg.motor == MOTOR_AZIMUTH else self._start.elevation
                rests = {leg.motor: Without(stands, moving=False)}
                antenna.commands.send({leg.motor: leg.target_deg}, (), known=True, without=rests)
            antenna.moving.taken += 1

    def _turn_skew(self, motor: int, deg: float) -> None:
        antenna, clock = self._antenna, self._antenna.rotator.clock
        antenna.gate.check_skew(deg)
        antenna.skew.forget()  # until it is taken: a slew must not turn the skew to where STOP kept it from going
        antenna.rotator.send({motor: deg})
        antenna.skew.taken(antenna.model.numbered[motor], deg, clock.monotonic(), clock.rate)

    @property
    def _start(self) -> Position:
        start = self._antenna.gate.position
        assert start is not None, "it was read just now"
        return start
