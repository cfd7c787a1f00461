"""Sends a dish to dish angles: the axes that change, each modelled before its first byte.

`MoveSender` says which axes go where, `MoveCommands` sends them to a dish that may wait for a running motor before it
takes one (`docs/decisions/0023-a-dish-that-waits-for-its-motors.md`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from birdcage.antenna.mapped_way import mapped_motion
from birdcage.antenna.motion import AxisMotion, DishMotion, longest_s, start_motion
from birdcage.antenna.overshoot import OvershootWatch
from birdcage.antenna.reckoning import farthest
from birdcage.antenna.steering import sent_to, steered
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import shortest_turn, wrap_360
from birdcage.base.reason import Reason
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, Position, Taken

if TYPE_CHECKING:
    from birdcage.antenna.antenna import BirdcageAntenna

SAME_DEG = 0.005
"""Commands are written in hundredths: two that differ by less are one."""
LATE_S = 0.3
"""An answer that comes so much later than others do is late."""
SEEN_DEG = 0.08
"""The rest position lies up to 0.06 deg from the command, and a step on top (`docs/reference/consoles.md`,
*Overshoot*)."""
SLOWER = 4.0
"""So many times as long as at its greatest speeds a dish may take whose own speeds were not read yet."""
SHARE = 0.8
"""So much of the motor's remaining time has passed at least when a dish answers that has waited for it."""


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


@dataclass(frozen=True, slots=True)
class Without:
    """Where an axis comes to rest without the command, and whether it is on its way there."""

    deg: float
    moving: bool


class MoveCommands:
    """Every command of a move goes out here, with the deadline that the motors on their way call for."""

    def __init__(self, antenna: BirdcageAntenna) -> None:
        self._antenna = antenna
        self.answers: dict[int, Taken] = {}
        """What the dish answered to the last command of each motor."""
        self.overshoots = OvershootWatch()
        self._aims: dict[int, float] = {}
        """Where each axis was sent last, of those that have taken it."""
        self._open: dict[int, Without] = {}
        """The axes of which it is not known whether the dish has taken their last command."""
        self.on_blocking: Callable[[], None] = lambda: None
        """Told when the dish was seen to take no command while a motor runs."""

    def leads_to(self, motor: int, dish_deg: float, under_way: DishMotion | None, here: Position) -> bool:
        """Return whether an axis is where its last command sent it, or on its way there, and that is `dish_deg`.

        Then it need not be named: only what changes is sent.
        """
        aim_deg = self._aims.get(motor)
        if aim_deg is None or abs(aim_deg - dish_deg) >= SAME_DEG or motor in self._open:
            return False
        azimuth = motor == MOTOR_AZIMUTH
        if under_way is not None:
            end_deg = under_way.rest[0 if azimuth else 1]
            return abs(shortest_turn(end_deg, dish_deg)) < SAME_DEG
        return abs(shortest_turn(here.azimuth if azimuth else here.elevation, dish_deg)) <= SEEN_DEG

    def forget_aims(self) -> None:
        """Where the axes were sent no longer tells where they are, or go."""
        self._aims.clear()

    def send(
        self, to: Mapping[int, float], runs: tuple[AxisMotion, ...], *, known: bool, without: Mapping[int, Without]
    ) -> None:
        """Send axes to their dish angles in one call; raises as `Rotator.send`.

        `runs` are the axes that this program has sent, and that may be on their way; `known`: whether the dish was
        seen at rest before that. Else somebody else may have sent it anywhere. `without` is what each axis does if the
        dish does not take the command.
        """
        antenna = self._antenna
        rotator, clock = antenna.rotator, antenna.rotator.clock
        now, rate = clock.monotonic(), clock.rate
        for motor in to:
            self._open.pop(motor, None)
        usual_s = runs_s = 0.0
        if runs:
            usual_s, runs_s = rotator.line.round_trip_s or 0.0, max(axis.eta(rate) - now for axis in runs)
        busy_s = max((axis.ends_by(rate) - now for axis in runs), default=0.0)
        if not known:
            busy_s = longest_s(antenna.model) / rate
        if busy_s > 0.0 and not antenna.speeds_deg_s and antenna.model.has_speeds:
            busy_s *= SLOWER  # it may have been set to less than such dishes can do
        for motor, dish_deg in to.items():
            self._aims.pop(motor, None)
            antenna.gate.check_axis(motor, dish_deg)
        answer = rotator.send(to, busy_s=max(0.0, busy_s))
        for motor, dish_deg in to.items():
            self.answers[motor] = answer
            if answer.sure:
                self._aims[motor] = dish_deg
                self.overshoots.taken(motor, antenna.motion)
            if not answer.sure and abs(shortest_turn(without[motor].deg, dish_deg)) > SEEN_DEG:
                self._open[motor] = without[motor]
        if not has_waited(answer.took_s, usual_s, runs_s):
            return
        for motor in to:
            antenna.begins_now(motor)
        if not antenna.strategy.one_at_a_time:
            antenna.remember_blocking()
            self.on_blocking()

    def steer(self, motor: int, dish_deg: float) -> None:
        """Send one axis as one of a stream; raises as `Rotator.send`."""
        self._aims.pop(motor, None)
        self._antenna.gate.check_axis(motor, dish_deg)
        answer = self.answers[motor] = self._antenna.rotator.send({motor: dish_deg}, hurry=True)
        if answer.sure:
            self.overshoots.taken(motor, self._antenna.motion)

    def busy_s(self) -> float:
        """Return how long the dish may leave a reading unanswered: one that waits for its motors may wait with that."""
        antenna = self._antenna
        motion, clock = antenna.motion, antenna.rotator.clock
        if motion is None or not antenna.strategy.looks_wait:
            return 0.0
        return max(0.0, motion.over_by(clock.rate) - clock.monotonic())

    @property
    def are_sure(self) -> bool:
        """Whether the dish has told of every last command that it took it, or was seen going by it."""
        return not self._open

    def see(self, dish: Position, motion: DishMotion, rate: float) -> None:
        """Take in where the dish is: an axis that goes from rest as it was sent has taken its command."""
        rotator = self._antenna.rotator
        asked_at = rotator.clock.monotonic() - rotator.line.took_s
        self.overshoots.see(dish, motion, asked_at, rate)
        for axis, here in ((motion.azimuth, dish.azimuth), (motion.elevation, dish.elevation)):
            without = self._open.get(axis.axis.index)
            if without is None or without.moving or not axis.is_as_modelled(rate):
                continue
            if abs(shortest_turn(without.deg, here)) > SEEN_DEG:
                del self._open[axis.axis.index]

    def not_taken(self, dish: Position, motion: DishMotion) -> tuple[Taken, ...]:
        """Return the answers that were none, of a dish that stands still; empty if it has moved by its commands.

        An axis that stands away from its target, though it has taken its command, is another matter: then empty, too.
        """
        answers = []
        for axis, here in ((motion.azimuth, dish.azimuth), (motion.elevation, dish.elevation)):
            if abs(shortest_turn(axis.slew.end_deg, here)) <= SEEN_DEG:
                continue
            without = self._open.get(axis.axis.index)
            if without is None or abs(shortest_turn(without.deg, here)) > SEEN_DEG:
                return ()
            answers.append(self.answers[axis.axis.index])
        return tuple(answers)


def has_waited(took_s: float, usual_s: float, runs_s: float) -> bool:
    """Return whether a dish that answered after `took_s` has waited for a motor that still ran for `runs_s`.

    `usual_s` is how long it takes to answer at rest; all in seconds of the wire.
    """
    late_s = took_s - usual_s
    return runs_s > LATE_S and late_s > LATE_S and late_s >= SHARE * runs_s


def running(before: DishMotion | None, now: DishMotion, sent: list[int]) -> tuple[AxisMotion, ...]:
    """Return the axes that may run: those that were `sent` by this motion, the others by the one before it."""
    ours = [axis for axis in now.axes if axis.axis.index in sent]
    others = [] if before is None else [axis for axis in before.axes if axis.axis.index not in sent]
    return tuple(axis for axis in (*ours, *others) if axis.slew.segments)
