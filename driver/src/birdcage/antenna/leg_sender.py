"""Sends a dish its legs, each through the gate and modelled before its first byte."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.legs import Leg, leg_motion, plan_legs, skew_leg
from birdcage.protocol.types import Position


class LegSender:
    """What a station uses instead of `BirdcageAntenna.point` on a dish whose moves queue."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        self._antenna = antenna

    def plan(self, az_deg: float, el_deg: float, *, leapfrog: bool = False, clamp: bool = False) -> tuple[Leg, ...]:
        """Read the position and return the legs to a true direction; empty when the dish is there.

        Raises as `BirdcageAntenna.point`. Nothing is sent that moves.
        """
        antenna = self._antenna
        dish_az, dish_el = antenna.aim(az_deg, el_deg, leapfrog=leapfrog, clamp=clamp)
        turn = antenna.turn_known(dish_az)
        return plan_legs(antenna.model, self._start, dish_az, dish_el, turn, antenna.first_motor())

    def plan_skew(self, deg: float) -> Leg:
        """Read the position and return the leg that turns the skew. MotionRefused on a dish without that axis."""
        self._antenna.get_position()
        return skew_leg(self._antenna.model, self._start, deg)

    def send(self, leg: Leg) -> None:
        """Send one leg; returns when the dish has taken it, or as soon as it is sent if it is silent.

        Stopped, CommandRefused and MotionRefused: nothing of it moves.
        """
        antenna, protocol = self._antenna, self._antenna.protocol
        now = protocol.clock.monotonic()
        with antenna.begun(leg_motion(antenna.model, self._start, leg, antenna.turn_known(leg.az_deg), now)):
            if leg.motor is None:
                protocol.begin_slew(leg.az_deg, leg.el_deg)
            elif leg.skew_deg is not None:
                protocol.turn_skew(leg.skew_deg)
            else:
                protocol.move_motor(leg.motor, leg.target_deg)
            antenna.taken += 1

    @property
    def _start(self) -> Position:
        start = self._antenna.protocol.gate.position
        assert start is not None, "it was read just now"
        return start
