"""Sends a dish to dish angles: the axes that change, each modelled before its first byte."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from birdcage.antenna.blocking import Without, running
from birdcage.antenna.mapped_way import mapped_motion
from birdcage.antenna.motion import start_motion
from birdcage.antenna.reckoning import farthest
from birdcage.antenna.steering import sent_to, steered
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.reason import Reason
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna


class MoveSender:
    """Of one antenna, which is asked for all that is known of its motion."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        self._antenna = antenna
        self.moves = 0
        """How many there were; STOP of a script counts anew."""
        self.begun_by: dict[int, float] = {}
        """When each axis had taken its last command."""

    def first_motor(self) -> int:
        """Return which axis goes first this time."""
        self.moves += 1
        return MOTOR_AZIMUTH if self.moves % 2 else MOTOR_ELEVATION

    def send(self, dish_az: float, dish_el: float, on_begun: Callable[[], None]) -> None:
        """Send the axes that change to dish angles that the gate has let through; `on_begun` when one is on its way."""
        antenna, gate = self._antenna, self._antenna.gate
        if antenna.model.mapping is not None:
            self._send_along(dish_az, dish_el, on_begun)
            return
        start = gate.position
        assert start is not None, "the gate has just checked this"
        now, rate = antenna.rotator.clock.monotonic(), antenna.rotator.clock.rate
        velocity, under_way = (0.0, 0.0), antenna.motion
        if under_way is not None:
            velocity = under_way.azimuth.modelled(now, rate)[1], under_way.elevation.modelled(now, rate)[1]
        known = antenna.turn_known(dish_az)
        turn = shortest_turn(start.azimuth, dish_az) if known is None else known
        first = MOTOR_AZIMUTH if self.moves % 2 == 0 else MOTOR_ELEVATION
        order = [(MOTOR_AZIMUTH, dish_az), (MOTOR_ELEVATION, dish_el)]
        planned = start_motion(
            antenna.model, start, turn, dish_el, now, velocity, first=first, rate=rate, turn_known=known is not None
        )
        stands = (start.azimuth, start.elevation) if under_way is None else under_way.rest
        without = {motor: Without(deg, under_way is not None) for motor, deg in enumerate(stands)}
        from_rest = under_way is not None or antenna.rest.rests
        changes = [each for each in order if not antenna.commands.leads_to(*each, under_way, start)]
        if under_way is not None:
            planned = planned.keeping(under_way, {motor for motor, _ in changes})
        with antenna.begun(planned):
            taken, sent = antenna.moving.taken, list[int]()
            in_turn = sorted(changes, key=lambda each: each[0] != first)
            calls = [dict(in_turn)] if antenna.model.sends_together and changes else [{m: deg} for m, deg in in_turn]
            for call in calls:
                runs = running(under_way, antenna.motion or planned, sent) if under_way is not None or sent else ()
                antenna.commands.send(call, runs, known=from_rest, without=without)
                antenna.moving.taken, now = taken + 1, antenna.rotator.clock.monotonic()
                self.begun_by |= dict.fromkeys(call, now)
                if not sent:
                    on_begun()
                sent.extend(call)
            if not sent:
                on_begun()
        self.moves += 1

    def _send_along(self, dish_az: float, dish_el: float, on_begun: Callable[[], None]) -> None:
        antenna, known, now = self._antenna, self._antenna.gate.position, self._antenna.rotator.clock.monotonic()
        start = known or farthest(antenna.model, dish_az, dish_el)
        with antenna.begun(
            mapped_motion(antenna.model, start, dish_az, dish_el, now, start_known=known is not None)
        ):  # fmt: skip
            antenna.rotator.begin_slew(dish_az, dish_el, None)
            antenna.reckon_move()
            antenna.moving.taken += 1
            on_begun()

    def steer(self, motor: int, dish_deg: float) -> None:
        """Send one axis as one of a stream; see `BirdcageAntenna.steer`."""
        antenna, gate, clock = self._antenna, self._antenna.gate, self._antenna.rotator.clock
        azimuth = antenna.model.azimuth
        if antenna.model.no_following:
            raise MotionRefused(f"{antenna.model.no_following} Nothing was sent.", reason=Reason.UNSUPPORTED)
        turns_az = motor == azimuth.index
        if turns_az and azimuth.max_deg - azimuth.min_deg >= 360.0:
            dish_deg = round(wrap_360(dish_deg), 2) % 360.0  # as it is printed: never 360.00
        az_deg, el_deg = (None, None) if antenna.motion is None else sent_to(antenna.motion)
        gate.check(dish_deg if turns_az else az_deg, el_deg if turns_az else dish_deg)
        here = gate.position
        assert here is not None, "the gate has just checked this"
        turn = antenna.turn_known(dish_deg) if turns_az else None
        now, before = clock.monotonic(), antenna.motion
        with antenna.begun(steered(antenna.model, before, here, motor, dish_deg, turn, now, clock.rate)):
            try:
                if antenna.strategy.one_at_a_time:
                    antenna.commands.send(
                        {motor: dish_deg}, () if before is None else before.axes, known=True,
                        without={motor: Without(dish_deg, moving=True)},
                    )  # fmt: skip
                else:
                    antenna.commands.steer(motor, dish_deg)
            finally:
                self.begun_by[motor] = clock.monotonic()
            antenna.moving.taken += 1
