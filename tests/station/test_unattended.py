"""`station.not_now`: the owner's command is asked before unattended motion and during it, and never waited for."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, field

import pytest
from birdcage.base.errors import MotionRefused
from birdcage.base.reason import Reason
from birdcage.station.events import NotNowChanged
from birdcage.station.not_now import NotNow, start
from birdcage.station.requests import BeginTask, Drive, Goto
from birdcage.station.state import Activity
from birdcage.station.task_state import TaskPhase

from .conftest import Bench
from .test_tasks import FourPoints


@dataclass
class Answer:
    over: bool
    status: int | None
    first_line: str


@dataclass
class Owner:
    """Stands in for the command: what it says from now on, and how often it was asked."""

    status: int | None = 0
    says: str = ""
    hangs: bool = False
    asked: list = field(default_factory=list)
    answers: list = field(default_factory=list)

    def __call__(self, command):
        self.asked.append(command)
        self.answers.append(Answer(not self.hangs, self.status, self.says))
        return self.answers[-1]

    def objects(self, says="wind 14 m/s"):
        self.status, self.says = 1, says


@pytest.fixture
def owner():
    return Owner()


@pytest.fixture
def bench(owner):
    FourPoints.heard_at.clear()
    options = {"not_now": NotNow("may-it-move", 5.0, None, owner), "tasks": {"four points": FourPoints}}
    bench = Bench("g2?seed=1&az_speed=4&el_speed=4", options).connect()
    bench.watch("position")
    bench.step(3.0)
    return bench


def scan(bench, *, asked=True):
    return bench.do(BeginTask("four points", {}, "map", asked))


def task(bench):
    (task,) = bench.state.tasks
    return task


def test_at_rest_it_is_not_asked(bench, owner):
    bench.step(60.0)
    assert owner.asked == []


def test_before_the_first_motion_and_every_few_seconds_during_it(bench, owner):
    start_at = bench.clock.monotonic()
    scan(bench)
    bench.step(3.0)
    assert owner.asked == ["may-it-move"]
    assert bench.moves_since(start_at)
    bench.step(12.0)
    assert 3 <= len(owner.asked) <= 4


def test_nothing_moves_before_it_has_answered(bench, owner):
    owner.hangs = True
    start_at = bench.clock.monotonic()
    scan(bench)
    bench.step(4.0)
    assert len(owner.asked) == 1
    assert bench.moves_since(start_at) == []
    owner.answers[-1].over = True
    bench.step(1.0)
    assert bench.moves_since(start_at)


def test_not_now_moves_nothing_and_says_why(bench, owner):
    owner.objects()
    start_at = bench.clock.monotonic()
    scan(bench)
    bench.step(8.0)
    assert bench.moves_since(start_at) == []
    assert bench.state.not_now == "Not now: wind 14 m/s."
    assert task(bench).why == "Not now: wind 14 m/s."
    assert task(bench).phase is TaskPhase.YIELDED
    assert bench.state.holder is None


def test_in_mid_motion_the_dish_comes_to_rest_and_goes_on_after_a_countdown(bench, owner):
    scan(bench)
    bench.step(2.0)
    assert bench.state.activity is Activity.SLEWING
    owner.objects()
    bench.step(8.0)
    assert bench.state.activity is Activity.IDLE
    assert bench.state.held is None
    rested_at = bench.clock.monotonic()
    bench.step(20.0)
    assert bench.moves_since(rested_at) == []
    owner.status = 0
    bench.step(6.0)
    assert task(bench).phase is TaskPhase.COUNTDOWN
    assert bench.moves_since(rested_at) == []
    bench.step(6.0)
    assert bench.moves_since(rested_at)
    told = [each.sentence for each in bench.events if isinstance(each, NotNowChanged)]
    assert told == ["Not now: wind 14 m/s.", ""]
    bench.step(120.0)
    assert sorted(set(FourPoints.heard_at)) == [0, 1, 2, 3]


def test_a_command_that_turns_silent_counts_as_not_now_by_its_status(bench, owner):
    owner.status = -15
    scan(bench)
    bench.step(3.0)
    assert bench.state.not_now == "Not now: the command of station.not_now gave no answer in 5 s."


def test_one_that_hangs_for_ever_keeps_the_dish_from_moving_on(bench, owner):
    """Its last *go on* does not count for ever."""
    scan(bench)
    bench.step(3.0)
    owner.hangs = True
    bench.step(120.0)
    assert len(set(FourPoints.heard_at)) < 4
    assert bench.state.tasks


def test_one_that_cannot_be_started_counts_as_not_now(bench, owner):
    owner.status = None
    scan(bench)
    bench.step(3.0)
    assert "can't be started" in bench.state.not_now


def test_a_person_moves_the_dish_whatever_the_command_says(bench, owner):
    owner.objects()
    scan(bench)
    bench.step(3.0)
    bench.do(Goto(200.0, 30.0, "you"), 60.0)
    bench.do(Drive(1, 0, "you"))
    bench.step(1.0)
    assert abs(bench.state.position.az_deg - 200.0) > 0.5


def test_a_motion_that_a_program_asks_for_is_refused_and_ended(bench, owner):
    owner.objects()
    with pytest.raises(MotionRefused) as refused:
        bench.do(Goto(200.0, 30.0, "client", asked=False))
    assert refused.value.reason is Reason.NOT_NOW
    bench.step(1.0)
    with pytest.raises(MotionRefused, match="wind 14"):
        bench.do(Goto(200.0, 30.0, "client", asked=False))
    owner.status = 0
    bench.step(8.0)
    going = bench.station.submit(Goto(100.0, 30.0, "client", asked=False))
    bench.step(2.0)
    assert bench.state.activity is Activity.SLEWING
    owner.objects("rain")
    bench.step(9.0)
    assert going.exception(0) is not None
    assert bench.state.activity is Activity.IDLE
    assert abs(bench.state.position.az_deg - 100.0) > 1.0


@pytest.mark.parametrize(("code", "status", "line"), [("0", 0, ""), ("print('rain'); sys.exit(3)", 3, "rain")])
def test_the_real_command(code, status, line):
    answer = start(f'{sys.executable} -c "import sys; {code}"')
    until = time.monotonic() + 30.0
    while not answer.over:
        assert time.monotonic() < until
        time.sleep(0.01)
    assert (answer.status, answer.first_line) == (status, line)


def test_it_parks_then_where_its_owner_wants_that(owner):
    FourPoints.heard_at.clear()
    options = {"not_now": NotNow("may-it-move", 5.0, (200.0, 30.0), owner), "tasks": {"four points": FourPoints}}
    bench = Bench("g2?seed=1&az_speed=4&el_speed=4", options).connect()
    bench.watch("position")
    bench.step(3.0)
    scan(bench)
    bench.step(6.0)
    owner.objects()
    bench.step(8.0)
    assert TaskPhase.COUNTDOWN in {each.phase for each in bench.state.tasks if each.kind == "shelter"}
    bench.step(90.0)
    assert abs(bench.state.position.az_deg - 200.0) < 0.2
    assert abs(bench.state.position.el_deg - 30.0) < 0.2
    assert bench.state.not_now
    assert bench.state.holder is None
    owner.status = 0
    bench.step(180.0)
    assert sorted(set(FourPoints.heard_at)) == [0, 1, 2, 3]
