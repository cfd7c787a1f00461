"""Measures how fast each motor goes and how hard it speeds up: sends it to and fro, and reads where it is meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

from birdcage.base.errors import CommandRefused, MotionRefused
from birdcage.base.reason import Reason
from birdcage.diagnostics.axis_run import AxisRun, acceleration_of
from birdcage.diagnostics.motion_fit import MeasuredWay, TimedReading
from birdcage.diagnostics.motor_test_words import NOT_ASKED, axis_words, driver_words, no_room, not_measured
from birdcage.rotator.feature import speed_of
from birdcage.station.state import FaultReason
from birdcage.station.task import ItemTask, Task
from birdcage.station.task_state import TaskPhase, TaskValue
from birdcage.station.wear import dish_key
from birdcage.tracking.steps import FindWay, ReadFeatures, ReadPosition, Send, SlewTo, Step, StepResult, Steps

if TYPE_CHECKING:
    from datetime import datetime

    from birdcage.diagnostics.motor_test_records import MotorTest, MotorTestBook
    from birdcage.rotator.axis import Axis
    from birdcage.rotator.facts import Facts
    from birdcage.station.access import StationAccess
    from birdcage.station.state import StationState

KIND = "motor test"
ROUNDS = 3
MOST_ROUNDS = 10
LONGEST_DEG = 60.0
LEAST_DEG = 5.0
"""A shorter way tells nothing of a speed."""
STILL_DEG = 0.05
STILL_S = 0.3
"""A dish that was read so long within so little has come to rest."""
BEGIN_S = 2.0
"""So long an axis may take to leave: the answer to its command may have been lost."""
MOST_S = 120.0
"""A way that takes longer is not waited for: the station's own move finds out why."""
ASTRAY_DEG = 1.0
"""Further from its target than this it has not arrived."""
CUT = "The motor test is not complete."
AXES = ("azimuth", "elevation")
"""What `axis` may name: the two that are sent by themselves."""


def _place(seen: StepResult) -> tuple[float, float]:
    """Return azimuth and elevation of a reading."""
    assert seen.az_deg is not None, "it was read"
    assert seen.el_deg is not None, "both come in one answer"
    return seen.az_deg, seen.el_deg


class MotorTests:
    """Of one station. It makes the task that the station is given, so `attach` comes once that is there."""

    def __init__(self, book: MotorTestBook) -> None:
        """`book` keeps what is measured."""
        self.book = book
        self._station: StationAccess | None = None

    def attach(self, station: StationAccess) -> None:
        """Serve this station."""
        self._station = station

    @property
    def state(self) -> StationState:
        """What the station knows now."""
        assert self._station is not None, "it was attached"
        return self._station.state

    def utc(self) -> datetime:
        """Return the time by the station's clock."""
        assert self._station is not None, "it was attached"
        return self._station.clock.utc()

    @property
    def tasks(self) -> Mapping[str, Callable[..., Task]]:
        """What a station is given, so that faces may ask for it (`BeginTask`)."""
        return {KIND: partial(MotorTestTask, tests=self)}


@dataclass
class MotorTestTask(ItemTask[tuple[str, int]]):
    """Sends each axis to and fro over up to `longest_deg` degrees, `rounds` times, and back to where it stood.

    `axis` is `azimuth` or `elevation`; empty for both, one after the other. How long the way is, limits, cable and
    no-go sectors tell. What is measured is the position that the machine tells: the count of its motor.
    """

    kind = KIND
    goes_on = False
    is_unattended = False
    cut_words = CUT
    holder: str
    axis: str = ""
    rounds: float = ROUNDS
    longest_deg: float = LONGEST_DEG
    tests: MotorTests = field(kw_only=True, repr=False)
    _runs: dict[str, AxisRun] = field(default_factory=dict, init=False)
    _drivers: dict[str, str] = field(default_factory=dict, init=False)
    _on_way: AxisRun | None = field(default=None, init=False)
    """The axis that is on its way, and was read there."""
    _sent: bool = field(default=False, init=False)
    """Whether an axis is on its way by a command of this task."""

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no test."""
        if self.axis not in ("", *AXES):
            raise TypeError(f"axis is {self.axis!r}. Give azimuth or elevation, or leave it out for both")
        for name, value, low, high in (
            ("rounds", self.rounds, 1, MOST_ROUNDS), ("longest_deg", self.longest_deg, LEAST_DEG, LONGEST_DEG)
        ):  # fmt: skip
            if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
                raise TypeError(f"{name} is {value!r}. Give a number from {low:g} to {high:g}")

    @property
    def streams(self) -> bool:
        """While an axis is on its way by a command of this task, and not by the station's own move."""
        return self._sent

    def items(self) -> Sequence[tuple[str, int]]:
        """Return axis and number of each way: even ones go towards greater angles."""
        return [(name, number) for name in ((self.axis,) if self.axis else AXES) for number in range(2 * self._rounds)]

    @property
    def _rounds(self) -> int:
        return int(self.rounds)

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Measure, if a person asks and the machine tells where it is while it moves."""
        if not asked:
            raise CommandRefused(NOT_ASKED, reason=Reason.UNSUPPORTED)
        if why := not_measured(self._dish):
            raise CommandRefused(why, reason=Reason.UNSUPPORTED)
        yield from super().steps(now_s, asked=asked)

    @property
    def _dish(self) -> Facts:
        dish = self.tests.state.dish
        assert dish is not None, "a station knows its dish from the start"
        return dish

    def do(self, item: tuple[str, int]) -> Steps:
        """Go one way; before the first one look how long it may be, after the last one go back and fit."""
        name, number = item
        axis = {each.name: each for each in (self._dish.azimuth, self._dish.elevation)}[name]
        if number == 0:
            yield from self._plan(axis)
        run = self._runs[name]
        if run.way is None or run.way_deg < LEAST_DEG:
            return
        yield from self._go(run, run.way[1 - number % 2])
        if number == 2 * self._rounds - 1:
            yield SlewTo((run.start,))
            run.fit()
            self.tests.book.add(*self._record(run))

    def _plan(self, axis: Axis) -> Steps:
        """Find the way of an axis, read what the machine says of its speed, and go to its beginning."""
        ids = (speed_of(axis.name), acceleration_of(axis.name))
        told = yield ReadFeatures(tuple(each for each in ids if each in self._dish.features), optional=True)
        here = yield from self._look()
        found = yield FindWay(axis.index, self.longest_deg)
        azimuth = axis.index == self._dish.azimuth.index
        run = AxisRun(axis, azimuth, _place(here), found.way_deg, found.refused)
        self._runs[axis.name] = run
        run.take_nominal(told.readings)
        if run.way is None or run.way_deg < LEAST_DEG:
            if self.axis:
                raise MotionRefused(self._no_room(run), reason=Reason.LIMIT)
            return
        yield SlewTo((run.at(run.way[0]),))

    @staticmethod
    def _no_room(run: AxisRun) -> str:
        return no_room(run.axis, run.way_deg, LEAST_DEG, run.refused)

    def _go(self, run: AxisRun, to_deg: float) -> Steps:
        """Send the axis, and read where it is until it rests."""
        start_deg = run.angle(_place((yield from self._look())))
        self._sent = True  # also where this is cut short: the station then watches it come to rest
        step = yield Send(run.axis.index, to_deg)
        readings = yield from self._read(run, start_deg, step.now_s)
        self._sent = False
        end_deg = readings[-1].deg
        if abs(end_deg - to_deg) <= ASTRAY_DEG:
            run.add(MeasuredWay(start_deg, end_deg, tuple(readings)), end_deg - to_deg)
        else:  # its command was lost, or it stalls without a word: the station's own move tells
            yield SlewTo((run.at(to_deg),))
        self._on_way, self.cut_words = None, CUT

    @staticmethod
    def _look() -> Generator[Step, StepResult, StepResult]:
        """Read where the dish is; once more where the answer was lost."""
        while True:
            seen = yield ReadPosition(patient=True)
            if seen.az_deg is not None:
                return seen

    def _read(self, run: AxisRun, start_deg: float, sent_s: float) -> Generator[Step, StepResult, list[TimedReading]]:
        """Read as fast as the dish answers, until it rests."""
        readings: list[TimedReading] = []
        while True:
            seen = yield from self._look()
            assert seen.took_s is not None, "it was asked for"
            deg = run.angle(_place(seen))
            readings.append(TimedReading(seen.now_s - seen.took_s, seen.now_s, deg))
            self._on_way = run
            self.cut_words = f"{run.axis.name.capitalize()} was last read at {self._shown(run):.1f}°. {CUT}"
            since = [each for each in readings if each.answered_s >= seen.now_s - 2.0 * STILL_S]
            rests = since[-1].answered_s - since[0].answered_s >= STILL_S and all(
                abs(each.deg - deg) <= STILL_DEG for each in since
            )
            gone = abs(deg - start_deg) > ASTRAY_DEG
            if (rests and (gone or seen.now_s > sent_s + BEGIN_S)) or seen.now_s > sent_s + MOST_S:
                return readings

    def finish(self) -> Steps:
        """Read what the motor drivers say, at rest; refuse where no axis had room."""
        if all(run.way_deg < LEAST_DEG for run in self._runs.values()):
            raise MotionRefused(" ".join(map(self._no_room, self._runs.values())), reason=Reason.LIMIT)
        features = self._dish.features
        ids = [
            each.id for each in features.values()
            if each.health is not None and each.health.good and each.is_readable and not each.read_hazard
        ]  # fmt: skip
        if ids:
            told = yield ReadFeatures(tuple(ids), optional=True)
            self._drivers = {name: str(reading.value) for name, reading in told.readings.items() if name in ids}

    def entered(self, phase: TaskPhase, why: str, *, is_done: bool) -> None:  # noqa: ARG002 - only its end counts
        """Keep an axis that stalled on its way."""
        if phase is not TaskPhase.OVER or is_done:
            return
        fault, run = self.tests.state.fault, self._on_way
        if run is not None and fault is not None and fault.reason is FaultReason.STALL:
            run.stalled_at_deg = self._shown(run)
            self.tests.book.add(*self._record(run))

    def _shown(self, run: AxisRun) -> float:
        """Return where an axis was read last, as faces show it: true degrees."""
        position = self.tests.state.position
        assert position is not None, "it was read just now"
        return position.az_deg if run.turns_az else position.el_deg

    def _record(self, run: AxisRun) -> tuple[str, MotorTest]:
        state = self.tests.state
        return dish_key(self._dish.name, demo=state.demo), run.told(self.tests.utc())

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """By axis what `AxisRun.found` has, with the axis' name before it; `health.<id>`: what a driver said."""
        told: dict[str, TaskValue] = {}
        now = self.tests.utc()
        for name, run in self._runs.items():
            told.update({f"{name}.{key}": value for key, value in run.found(now).items()})
        return told | {f"health.{name}": value for name, value in self._drivers.items()}

    @property
    def end_words(self) -> str:
        """Say what was measured against what was expected, and what to do where that is far off."""
        words = [
            axis_words(run.told(self.tests.utc())) if run.way_deg >= LEAST_DEG else self._no_room(run)
            for run in self._runs.values()
        ]
        return " ".join([*words, driver_words(self._dish, self._drivers)]).strip()
