"""High-level control of one dish, for scripts and the station (`docs/reference/published-interface.md`)."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from birdcage.antenna.alignment import Alignment
from birdcage.antenna.az_el import AzEl
from birdcage.antenna.config import AntennaConfig, DialectBaud
from birdcage.antenna.foresight import foresee
from birdcage.antenna.gate import UNTOLD, MotionGate
from birdcage.antenna.latch import Latch
from birdcage.antenna.maintenance import Maintenance
from birdcage.antenna.motion import DishMotion
from birdcage.antenna.motion_state import MotionState
from birdcage.antenna.odometer import Odometer
from birdcage.antenna.reading import Readings
from birdcage.antenna.reading_filter import Expected, ReadingFilter
from birdcage.antenna.reckoning import Reckoning
from birdcage.antenna.rest import RestWatch
from birdcage.antenna.sender import MoveCommands, MoveSender
from birdcage.antenna.skew import SkewGoal
from birdcage.antenna.stop_aim import StopAim
from birdcage.antenna.strategy.choice import strategy_for, suited
from birdcage.base.clock import Clock, RealClock
from birdcage.base.errors import CommandRefused, MotionRefused, PositionUnknown, WrongThread
from birdcage.base.reason import Reason
from birdcage.leapfrog import apply_leapfrog
from birdcage.link.link import Link
from birdcage.rotator.adapting import as_rotator
from birdcage.rotator.hooks import Hooks
from birdcage.rotator.own import OwnFacts, with_speeds
from birdcage.rotator.raw import RawLines
from birdcage.rotator.values import Look, Position

FRESH_S = 1.2
"""A dish that was seen at rest so short a time ago is where it was: at rest the station looks once a second."""
CLOSE_S = 2.0
"""How long leaving may try to bring the console back to its root menu."""


class BirdcageAntenna:
    """One dish, in true degrees. Synchronous; once a station has adopted it, other threads get `WrongThread`.

    A dish that a person has stopped is HELD for scripts too: `move_to` and every other motion raise `Held`, until
    `birdcage release`. `stop` of a script stops, and holds nothing.
    """

    def __init__(
        self,
        machine: Any,  # noqa: ANN401 - a `FirmwareProtocol`, which this room does not know, or a `Rotator`
        config: AntennaConfig | None = None,
        alignment: Alignment | None = None,
    ) -> None:
        self._machine, self._config = machine, config or AntennaConfig()
        rotator = as_rotator(machine)
        self.raw: RawLines | None = rotator.raw
        self.permit: Callable[[], None] | None = None
        """Asked, with writing locked, just before anything that moves the dish; raises to keep it from going out."""
        self.alignment = alignment or Alignment()
        self._owner: threading.Thread | None = None
        self._last_position: Position | None = None
        self.moving = MotionState()
        """The motion under way."""
        self._latch: Latch | None = None
        """HELD, where no station sees to it."""
        self.odometer = Odometer()
        """How far each axis was sent; for whoever counts wear."""
        self.rest = RestWatch()
        self.stop_consent = False
        """Whether the user lets STOP climb the rungs that need consent."""
        self._sender = MoveSender(self)
        self.stop_aim = StopAim(self)
        self.gate = MotionGate(rotator.facts)
        self.rotator = AzEl(rotator, self.gate)
        """The machine, as all above the seam know it."""
        self._readings = Readings(self.gate)
        self.skew = SkewGoal()
        self.reckoning = Reckoning()
        self.maintenance = Maintenance(self.rotator, self.gate)
        self.own = OwnFacts()
        """What was learnt of this dish itself."""
        self.kind = self.rotator.facts
        """The dish as it was seen to take commands; `rotator.facts` is what is known of all that are like it."""
        self.model = self.kind
        """The same with the speeds that are in force now."""
        self.strategy = strategy_for(self)
        """How it is moved and stopped."""
        self.commands = MoveCommands(self)
        self.speeds_deg_s: Mapping[int, float] = {}
        """The greatest speeds in force by motor number, as far as they are known."""
        self.align(self.alignment)

    @property
    def config(self) -> AntennaConfig:
        """The configuration given at construction."""
        return self._config

    @property
    def protocol(self) -> Any:  # noqa: ANN401 - as above
        """The machine as it was given: the dialect, for scripts."""
        return self._machine

    @property
    def is_connected(self) -> bool:
        """Whether a port is open."""
        return self.rotator.is_open

    @property
    def _clock(self) -> Clock:
        return self.rotator.clock

    @property
    def motion(self) -> DishMotion | None:
        """The motion under way as modelled; None at rest."""
        return self.moving.model

    def align(self, alignment: Alignment) -> None:
        """Use another alignment from now on. Only while nothing moves."""
        self._check_thread()
        self.alignment = alignment
        self.gate.update(
            floor_deg=self._config.min_elevation - alignment.el_offset_deg,
            az_offset_deg=alignment.az_offset_deg, el_offset_deg=alignment.el_offset_deg,
        )  # fmt: skip
        self._last_position = None

    def use_speeds(self, speeds: Mapping[int, float]) -> None:
        """Plan with these greatest speeds (motor number to deg/s); an axis that is not named goes as its model says."""
        self._check_thread()
        self.speeds_deg_s = dict(speeds)
        self.model = with_speeds(self.kind, speeds)

    def know(self, own: OwnFacts) -> None:
        """Plan and steer from now on by what is known of this dish itself."""
        self.own, self.kind = own, own.on(self.rotator.facts)
        self.use_speeds(self.speeds_deg_s)
        if type(self.strategy) is not suited(self.model):
            self.strategy = strategy_for(self)

    def remember_blocking(self) -> None:
        """Count the dish among those that take no command of a move while a motor runs."""
        self.know(self.own.that_waits(self._clock.utc()))

    def doubt(self) -> None:
        """From now on take no reading of the position as true that neither goes on nor comes twice."""
        belief = self._readings.belief = ReadingFilter(self.rotator.facts)
        belief.foresee = self._foresee

    def _foresee(self, last: Position, last_at: float, now: float) -> Expected | None:
        motion = self.motion
        return None if motion is None else foresee(motion, self._sender.begun_by, last, last_at, now, self._clock.rate)

    def adopt(self, owner: threading.Thread | None) -> None:
        """Give the antenna to a thread: calls from any other raise `WrongThread` from then on. None frees it."""
        self._owner = owner

    def _check_thread(self) -> None:
        if self._owner is not None and threading.current_thread() is not self._owner:
            raise WrongThread("A station owns this antenna. Submit a request to the station instead.")

    def connect(self) -> None:
        """Open the port of the configuration; the dialect's baud unless one was given."""
        self._check_thread()
        baud = self._config.baudrate
        self._open(self._config.port, None if isinstance(baud, DialectBaud) else baud, RealClock(), None)

    def attach(self, link: Link, clock: Clock) -> None:
        """Use an open link instead of `connect`."""
        self._check_thread()
        self._open(link.name, None, clock, lambda _address, _baud: link)

    def _open(self, port: str, baud: int | None, clock: Clock, dial: Callable[[str, int], Link] | None) -> None:
        self._honour_held(port)
        self.rotator.open(port, baud, clock, Hooks(dial=dial, permit=self.check_permit))

    def be_permitted_by(self, permit: Callable[[], None]) -> None:
        """Let `permit` say from now on whether anything may move, by raising what keeps it back: HELD, too."""
        self.permit, self._latch = permit, None

    def check_permit(self) -> None:
        """Raise what keeps the dish from being moved now."""
        if self.permit is not None:
            self.permit()

    def _honour_held(self, port: str) -> None:
        """Let nothing move a dish that is HELD. A station has taken that over where it asks for itself."""
        if self.permit is None or self._latch is not None:
            self._latch = Latch(port)
            self.permit = self._latch.check

    def disconnect(self) -> None:
        """Close the port; `q` goes out only from a proven submenu."""
        self._check_thread()
        self.rotator.close(CLOSE_S)
        self._last_position = None

    def initialize(self) -> None:
        """Connect if needed, wait for the end of the boot, enter the motor menu."""
        self._check_thread()
        if not self.is_connected:
            self.connect()
        self.gate.forget(Reason.UNREAD)  # a search that moves the dish may end with it
        self.rotator.begin(lambda _words: None)

    def get_position(self) -> Position:
        """Read where the dish points, in true degrees. PositionUnknown when it is not homed.

        Of one that does not tell: where it should be by its last move, PositionUnknown (`untold`) before there was one,
        and (`no_direction`) of one that has no azimuth and elevation.
        """
        self._check_thread()
        self.gate.require_direction()
        if not self.strategy.reads_position:
            return self._reckoned()
        return self._read(lambda: self.rotator.look(busy_s=self.commands.busy_s()))

    def glance(self) -> Position:
        """Read where the dish points within a stream of targets: NoReply (`late`) where waiting would hold that up."""
        self._check_thread()
        self.gate.require_direction()
        if not self.strategy.reads_position:
            return self._reckoned()
        return self._read(lambda: self.rotator.look(hurry=True))

    def _reckoned(self) -> Position:
        dish = self.reckoning.tell(self.gate, self.motion, self._clock.monotonic(), self._clock.rate)
        self._last_position = Position(*self.alignment.to_true(dish.azimuth, dish.elevation))
        return self._last_position

    def reckon_move(self) -> None:
        """A move has gone out: a dish that does not tell is on its way until that is over by its time."""
        if self.motion is not None and not self.strategy.reads_position:
            self.reckoning.begin(self.motion, self._clock.rate)

    def hear(self, told: Look) -> Position:
        """Take in where the dish points, told unasked; reads on where that alone cannot be believed. True degrees."""
        self.gate.require_direction()
        unasked = [self.rotator.position(told)]
        return self._read(lambda: unasked.pop() if unasked else self.rotator.look())

    def _read(self, once: Callable[[], Position]) -> Position:
        if self.gate.position is None:
            self.skew.forget()  # whatever made the position doubtful may have turned the skew as well
            self.commands.forget_aims()
        dish = self._readings.take(once, self._clock)
        self.skew.see(dish)
        with self.moving.lock:
            now, rate = self._clock.monotonic(), self._clock.rate
            motion = self.moving.correct(lambda motion: motion.with_reading(dish, now, rate))
            if motion is not None:
                self.commands.see(dish, motion, rate)
        self.rest.see(dish, now)
        at_rest = self.rest.rests and motion is None and self.strategy.reads_position
        self.moving.seen_at_rest = now if at_rest else -math.inf
        az_deg, el_deg = self.alignment.to_true(dish.azimuth, dish.elevation)
        self._last_position = Position(az_deg, el_deg, dish.skew)
        return self._last_position

    def move_to(self, azimuth: float, elevation: float) -> None:
        """Point there (true degrees) and return when the dish has answered the commands.

        Reads the position first, unless it was read just now, at rest. With `leapfrog_enabled`, aims beyond the target
        as documented, within the limits.
        After an answer in unknown words only the position tells whether it was taken (`commands.are_sure`).
        BelowFloor (a ValueError) below the floor, MotionRefused for every other limit; nothing is sent then.
        """
        self.point(azimuth, elevation, leapfrog=self._config.leapfrog_enabled)

    def point(
        self,
        az_deg: float,
        el_deg: float,
        *,
        leapfrog: bool = False,
        clamp: bool = False,
        on_begun: Callable[[tuple[float, float]], None] = lambda _true: None,
    ) -> tuple[float, float]:
        """Send both axes to a true direction; return the true direction that was commanded.

        `clamp` moves an elevation outside the limits to the nearest allowed one instead of refusing it. `on_begun` is
        told that direction when one axis is on its way: the dish may wait for it before it takes the other.
        """
        dish_az, dish_el = self.aim(az_deg, el_deg, leapfrog=leapfrog, clamp=clamp)
        self._sender.send(dish_az, dish_el, lambda: on_begun(self.alignment.to_true(dish_az, dish_el)))
        return self.alignment.to_true(dish_az, dish_el)

    def aim(self, az_deg: float, el_deg: float, *, leapfrog: bool, clamp: bool) -> tuple[float, float]:
        """Return the dish angles of a true direction that the gate lets through.

        Reads the position first, unless the dish was seen at rest less than `FRESH_S` ago
        (`docs/decisions/0054-a-move-from-rest.md`), or may not be asked so soon (`AzEl.next_look`).
        """
        self._check_thread()
        if self._latch is not None:
            self._latch.check()
        gate = self.gate
        current = self._last_position if gate.position is not None else None
        now = self.rotator.clock.monotonic()
        if current is None or (now - self.moving.seen_at_rest > FRESH_S and self.rotator.next_look(now) <= now):
            try:
                current = self.get_position()
            except PositionUnknown as unknown:
                if unknown.reason is not UNTOLD:
                    raise
                current = None
        dish_az, dish_el = self.to_dish(az_deg, el_deg, clamp=clamp)
        gate.check(dish_az, dish_el)
        if not leapfrog or current is None or gate.model.mapping is not None:
            return dish_az, dish_el
        wanted = apply_leapfrog(az_deg, el_deg, current.azimuth, current.elevation)
        beyond = self.to_dish(*wanted, clamp=True)
        try:
            gate.check(*beyond)
        except MotionRefused:
            # Only the overshoot is not allowed: the target itself is, so go there exactly.
            return dish_az, dish_el
        return beyond

    def to_dish(self, az_deg: float, el_deg: float, *, clamp: bool = False) -> tuple[float, float]:
        """Return the dish angles of a true direction; `clamp` as in `point`."""
        gate = self.gate
        dish_az, dish_el = self.alignment.to_dish(az_deg, el_deg)
        if gate.model.mapping is not None:
            return self.rotator.nearest_allowed(dish_az, dish_el, self.alignment.to_true, any_miss=clamp)
        return dish_az, gate.nearest_el_deg(dish_el) if clamp else dish_el

    def miss_deg(self, az_deg: float, el_deg: float) -> float:
        """Return by how much a machine with a mapping misses a true direction; 0 for any other."""
        if self.gate.model.mapping is None:
            return 0.0
        return self.rotator.nearest(*self.alignment.to_dish(az_deg, el_deg))[1]

    @contextmanager
    def begun(self, planned: DishMotion) -> Iterator[None]:
        """Model a motion while its lines go out; what was modelled before comes back if the dish takes none of them."""
        with self.moving.begin(planned) as before:
            yield
            self.odometer.take(before, planned)

    def first_motor(self) -> int:
        """Return which axis goes first this time: they alternate, so that none starves where they move in turn."""
        return self._sender.first_motor()

    def turn_known(self, dish_az: float) -> float | None:
        """Return how far the azimuth will turn; None when the turn of the cable is not known."""
        cable_deg = self.gate.cable_deg
        if cable_deg is None:
            return None
        turns = self.gate.cable_turns(dish_az)
        return turns[0] - cable_deg if turns else None

    def begins_now(self, motor: int) -> None:
        """One axis begins its way only now: the dish has waited before it took the command."""
        self.moving.correct(lambda motion: motion.begun(motor, self._clock.monotonic()))

    def steer(self, motor: int, dish_deg: float) -> None:
        """Send one axis to its dish angle, as one of a stream; returns when the dish has taken it.

        `dish_deg` may lie beyond 0..360 in azimuth. Nothing is read before it: the gate judges the way from the last
        position that was read to where both axes are then sent. Where moves queue, whoever calls has to wait until the
        one under way ends. Raises as `move_to`; PositionUnknown where nothing was read yet; NoReply (`late`) where the
        answer did not come in time: the dish may have taken it or not, and the next one may follow.
        """
        self._check_thread()
        self._sender.steer(motor, dish_deg)

    def stop(self) -> None:
        """Reset the move counter and bring the dish to rest: a new target just ahead of where it is.

        NoReply when the dish did not answer within 2 s, CommandRefused when it does not take the new target, or
        (`queued`) moves on to a target that can't be called back.
        """
        self._check_thread()
        self._sender.moves = 0
        if self.motion is None:
            return
        if not self.motion.silent:
            self.get_position()  # tells which way the azimuth turns, if the turn of the cable was not known
        order, left_s = self.stop_aim.order(), self.motion.eta(self._clock.rate) - self._clock.monotonic()
        if order is None and self.strategy.one_at_a_time:
            if left_s > 0:
                what = "its move" if self.motion.silent else "a move of one axis"
                raise CommandRefused(
                    f"The {self.model.name} can't call back {what}: it ends in {left_s:.0f} s, at its target.",
                    reason=Reason.QUEUED,
                )
            self.moving.end()
        if order is None:
            return
        self.rotator.stop_now(order)
        for refusal in self.rotator.settle(2.0):
            if refusal is not None:
                raise refusal
        self.moving.end()
