"""Follows a pass with a controller: our simulator at the byte level, through the real driver, on a virtual clock."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime

import numpy as np
from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.antenna.gear import AXES, PLAY, overshoot_name
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import NoReply
from birdcage.base.geometry import wrap_360
from birdcage.link.link import Link
from birdcage.protocol.registry import get_protocol
from birdcage.rotator.facts import Facts
from birdcage.rotator.origin import Origin
from birdcage.rotator.own import OwnFact, OwnFacts
from birdcage.sim.axis import AxisMechanics
from birdcage.sim.device import Device
from birdcage.sim.port import SimPort, open_device
from birdcage.tracking.controller_input import Controller, ControllerInput
from birdcage.tracking.curve import Curve
from birdcage.tracking.steering.motor_course import course_of_motors
from birdcage.tracking.steps import LimitSpeeds, ReadPosition, Send, Step, StepResult, Wait

SAMPLES_HZ = 20.0
EARLY_S = 240.0
"""How long before the pass the bench is set up: a Trav'ler at 5 deg/s needs 91 s for its whole cable."""


DELAY_S = 2.0
TO_AND_FRO = 12
AWAY_DEG = 5.0
RESTS_S = 2.0
"""What a dish is moved before a pass to learn its overshoot: so often, so far; and when it rests."""
PIECE_S = 0.004
"""How long a byte waits in the adapter at the longest while others follow it."""


class AdapterPort(SimPort):
    """Hands over what has arrived in pieces, as a USB adapter does, and loses some answers whole.

    The last byte of an answer comes when it came before; a read for each byte would be most of the run's time.
    """

    share = 0.0
    lost = 0

    def __init__(self, device: Device, name: str, *, baud: int, seed: int) -> None:
        self.dice = random.Random(seed)
        super().__init__(device, name, baud=baud)

    def pending(self) -> bool:
        found = super().pending()
        inbox = self.device.inbox
        return found and (not inbox or self._handed_over_s() <= self.device.machine.now)

    def next_event(self) -> float | None:
        found = super().next_event()
        if found is None or not self.device.inbox or math.isinf(found):
            return found
        return min(self._handed_over_s(), self.device.machine.next_event())

    def _handed_over_s(self) -> float:
        inbox = self.device.inbox
        return min(inbox[-1][0], inbox[0][0] + PIECE_S)

    def read(self) -> bytes:
        data = super().read()
        if data.rstrip().endswith(b">") and self.dice.random() < self.share:
            self.lost += 1
            return b""
        return data


@dataclass(frozen=True)
class Order:
    """A command that an axis has acted on: when its line began to go out, and when it acted; POSIX seconds."""

    sent_s: float
    acted_s: float


@dataclass
class Followed:
    """What came of it."""

    t_s: np.ndarray
    az_deg: np.ndarray
    """Of the cable, where the dish really was."""
    el_deg: np.ndarray
    commands: int
    backlog: int
    """The most commands that waited behind the one under way."""
    latency_s: float


@dataclass
class Bench:
    """One dish on a wire. `late_s`: how much the computer's clock is behind."""

    address: str
    model: Facts
    start_s: float
    lost: float = 0.0
    late_s: float = 0.0
    seed: int = 1
    samples: list[tuple[float, float, float]] = field(default_factory=list)
    commands: int = 0
    backlog: int = 0
    latency_s: float = 0.06
    orders: tuple[list[Order], list[Order]] = field(default_factory=lambda: ([], []))
    """What azimuth and elevation have acted on, in turn."""
    at: tuple[float, float] = (0.0, 0.0)
    """Where the dish stands or was sent last; the azimuth is the cable's."""

    def __post_init__(self) -> None:
        self.clock = VirtualClock(datetime.fromtimestamp(self.start_s - EARLY_S, UTC))
        self.device = open_device(self.address, clock=self.clock)
        self.protocol = get_protocol(self.address.partition("?")[0])
        self.port = AdapterPort(self.device, "bench", baud=self.model.baud, seed=self.seed)
        self.protocol.attach(Link(self.port, self.clock), self.clock, delay_s=DELAY_S)
        self.antenna = BirdcageAntenna(self.protocol)
        self.antenna.initialize()
        self.antenna.model = self.model
        stands = self.antenna.get_position()
        self.at_start = stands.azimuth, stands.elevation
        self._moves = 0
        self._asked_s = self.start_s
        with self.device.lock:
            self.device.machine.run()
            dish_zero_s = self.device.machine.dish_s - self.clock.utc().timestamp()
        for axis, orders in zip(self.device.dish.axes, self.orders, strict=False):
            self._note(axis, orders, dish_zero_s)

    def _note(self, axis: AxisMechanics, orders: list[Order], dish_zero_s: float) -> None:
        """Write down when an axis acts on a command."""
        retarget = axis.retarget

        def noted(now_s: float, target_deg: float, *, rate_deg_s: float | None = None) -> None:
            orders.append(Order(self._asked_s, now_s - dish_zero_s))
            retarget(now_s, target_deg, rate_deg_s=rate_deg_s)

        axis.retarget = noted  # type: ignore[method-assign]

    @property
    def now_s(self) -> float:
        """What the computer believes the time is."""
        return self.clock.utc().timestamp() - self.late_s

    def sample(self, start_s: float, end_s: float) -> None:
        """Write down where the dish really is, 20 times a second, from now on."""
        zero = self.clock.monotonic() - self.clock.utc().timestamp()
        machine, axes = self.device.machine, self.device.dish.axes

        def look(at_s: float) -> None:
            dish_s = machine.dish_s
            self.samples.append((at_s, axes[0].shaft(dish_s), axes[1].shaft(dish_s)))

        for at_s in np.arange(start_s, end_s, 1.0 / SAMPLES_HZ).tolist():
            machine.at(at_s + zero, lambda at_s=at_s: look(at_s))

    def go(self, stops: Sequence[tuple[float, float]]) -> None:
        """Go along way points, coming to rest at each."""
        for az_deg, el_deg in stops:
            self.protocol.move_motor(self.model.azimuth.index, wrap_360(round(az_deg, 2)))
            self.protocol.move_motor(self.model.elevation.index, el_deg)
            while self.device.truth().moving:
                self.clock.advance(0.1)
            self.antenna.get_position()

    def learn(self, play_deg: float) -> None:
        """Move to and fro until readings at rest have told the overshoot, and go by that and by the play."""
        az_deg, el_deg = self.at_start
        for times in range(2 * TO_AND_FRO):
            by_deg = 0.0 if times % 2 else AWAY_DEG
            self.antenna.point(wrap_360(az_deg + by_deg), el_deg + by_deg)
            self.clock.advance(RESTS_S)
            self.antenna.get_position()
        own = OwnFacts()
        for axis in AXES:
            own = own.with_fact(f"{axis}.{PLAY}", OwnFact(play_deg, Origin.USER, self.clock.utc()))
        for (axis, up), tally in self.antenna.commands.overshoots.tallies.items():
            if tally.is_sure:
                fact = OwnFact(tally.mean_deg, Origin.LEARNT, self.clock.utc(), tally.count)
                own = own.with_fact(overshoot_name(axis, up=up), fact)
        self.antenna.moving.end()
        self.model = self.antenna.model = own.on(self.model)

    def wait(self, until_s: float) -> None:
        ahead_s = until_s - self.now_s
        if ahead_s > 0:
            self.clock.advance(ahead_s)

    def wait_in_place(self, until_s: float) -> None:
        """Read the position once a second, as the station does."""
        while self.now_s + 1.0 < until_s:
            self.clock.advance(1.0)
            with suppress(NoReply):
                self.antenna.get_position()
        self.wait(until_s)

    def follow(self, controller: Controller, course: Curve, start_s: float, end_s: float, lead_s: float = 0.0) -> None:
        """Let a controller steer from one time to another, as the computer's clock has them; it begins earlier."""
        stands, self.port.share = self.at, self.lost
        self.wait_in_place(start_s - lead_s)
        motors = course_of_motors(course, self.model, *self._spans())
        helm = ControllerInput(
            lambda: motors, self.model, *stands, self.now_s, end_s, self.latency_s, from_s=start_s,
            answered=self.protocol.console.answered, delay_s=DELAY_S,
        )  # fmt: skip
        activity = controller(helm)
        answer: StepResult | None = None
        try:
            while True:
                answer = self.do(next(activity) if answer is None else activity.send(answer))
        except StopIteration:
            self.latency_s, self.port.share = helm.latency_s, 0.0

    def _spans(self) -> tuple[tuple[float, float] | None, tuple[float, float]]:
        cable, elevation = self.model.cable, self.model.elevation
        az_span = None if cable is None else (cable.min_deg, cable.max_deg)
        return az_span, (elevation.min_deg, elevation.max_deg)

    def followed(self) -> Followed:
        """Return where it was since `sample`."""
        self.clock.advance(1.0)
        self.device.truth()
        t, az, el = np.array(self.samples).T
        return Followed(t, az, el, self.commands, self.backlog, self.latency_s)

    def do(self, step: Step) -> StepResult:
        before_s = self.now_s
        if isinstance(step, Wait):
            self.wait(step.until_s)
            return StepResult(self.now_s)
        try:
            return self._ask(step, before_s)
        except NoReply:
            return StepResult(self.now_s)

    def _ask(self, step: Step, before_s: float) -> StepResult:
        self.commands += 1
        if isinstance(step, ReadPosition):
            seen = self.antenna.glance()
            now_s = self.now_s
            return StepResult(now_s, az_deg=seen.azimuth, el_deg=seen.elevation, seen_s=(before_s + now_s) / 2.0)
        if isinstance(step, LimitSpeeds):
            for motor, speed_deg_s in step.speeds_deg_s.items():
                self.antenna.use_speeds(self.protocol.set_speed(motor, speed_deg_s))
            self.protocol.enter_motor_menu()
            return StepResult(self.now_s, sent_s=before_s)
        assert isinstance(step, Send)
        self._asked_s = before_s + self.late_s
        self.antenna.steer(step.axis, step.deg)
        self._sent(step)
        self._count_waiting()
        return StepResult(self.now_s, sent_s=before_s)

    def _sent(self, step: Send) -> None:
        az, el = self.at
        self.at = (step.deg, el) if step.axis == self.model.azimuth.index else (az, step.deg)

    def _count_waiting(self) -> None:
        """Commands that the dish has taken, less motions that it has begun since all was last at rest."""
        with self.device.lock:
            self.device.machine.run()
            lane = getattr(self.device.board, "turn", None)
            if lane is None:
                return
            begun = sum(axis.orders for axis in lane.axes)
            self._moves += 1
            if not lane.busy:
                self._moves = begun
            self.backlog = max(self.backlog, self._moves - begun)
