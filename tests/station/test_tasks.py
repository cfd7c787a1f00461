"""What every task gets from its host: a made-up scan of four points, which asks for none of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import pytest
from birdcage.base.errors import BirdcageError, CommandRefused, LeaseDenied, Stopped
from birdcage.station.events import TaskChanged
from birdcage.station.requests import (
    AcquireLease,
    BeginTask,
    Drive,
    DropTask,
    EndMotion,
    Goto,
    Release,
    ReleaseLease,
    ResumeTask,
    Watch,
)
from birdcage.station.state import Activity
from birdcage.station.task import ItemTask
from birdcage.station.task_state import TaskPhase
from birdcage.tracking.steps import PointAt, ReadFeatures

from .conftest import Bench

POINTS = ((170.0, 30.0), (180.0, 30.0), (180.0, 40.0), (170.0, 40.0))


@dataclass
class FourPoints(ItemTask[tuple[float, float]]):
    """A scan: it goes to four points, and hears the signal at each."""

    kind = "four points"
    is_kept = True
    heard_at: ClassVar[list[int]] = []
    holder: str

    def items(self):
        return POINTS

    def do(self, item):
        yield PointAt(*item)
        readings = (yield ReadFeatures(("rssi",))).readings
        assert "rssi" in readings
        self.heard_at.append(self.done)


@dataclass
class TwoPoints(FourPoints):
    """Another kind of scan."""

    kind = "two points"

    def items(self):
        return POINTS[:2]


@dataclass
class GivenPoints(FourPoints):
    """A scan of points that whoever begins it names."""

    kind = "given points"
    points: tuple[tuple[float, float], ...] = ()

    def items(self):
        return self.points


@dataclass
class WithoutPause(FourPoints):
    """A task that always has something to ask the dish."""

    kind = "without pause"

    def items(self):
        return range(400)

    def do(self, item):
        yield ReadFeatures(("rssi",))


def scan(asked=True, holder="scan"):
    return BeginTask("four points", {}, holder, asked)


TASKS = {kind.kind: kind for kind in (FourPoints, TwoPoints, GivenPoints, WithoutPause)}


def made(**options):
    FourPoints.heard_at.clear()
    return Bench("g2?seed=1", {"tasks": TASKS, **options}).connect(6.0)


@pytest.fixture
def bench():
    return made()


def run_to(bench, done, seconds=60.0):
    end = bench.clock.monotonic() + seconds
    while bench.state.tasks and bench.state.tasks[0].done < done and bench.clock.monotonic() < end:
        bench.step(0.1)
    assert bench.state.tasks, told(bench)
    assert bench.state.tasks[0].done == done


def finish(bench, seconds=90.0):
    end = bench.clock.monotonic() + seconds
    while bench.state.tasks and bench.clock.monotonic() < end:
        bench.step(0.2)
    assert not bench.state.tasks, bench.state.tasks
    return told(bench)[-1]


def told(bench):
    return [event.task for event in bench.events if isinstance(event, TaskChanged)]


def test_it_goes_round_its_points_tells_how_far_it_is_and_gives_control_back(bench):
    assert bench.do(scan()) == 1
    bench.step(0.5)
    assert (bench.state.tasks[0].phase, bench.state.holder) == (TaskPhase.RUNNING, "scan")
    last = finish(bench)
    assert (last.phase, last.why, last.is_done, last.done, last.of) == (TaskPhase.OVER, "Done.", True, 4, 4)
    assert FourPoints.heard_at == [0, 1, 2, 3]
    assert sorted({each.done for each in told(bench)}) == [0, 1, 2, 3, 4]
    assert bench.state.holder is None
    assert (bench.state.position.az_deg, bench.state.position.el_deg) == pytest.approx(POINTS[-1], abs=0.1)


def test_it_takes_no_control_from_whoever_has_it_and_goes_on_after_a_countdown(bench):
    bench.do(AcquireLease("you"))
    bench.do(scan())
    bench.step(2)
    assert (bench.state.tasks[0].phase, bench.state.tasks[0].why) == (TaskPhase.YIELDED, "You have control.")
    assert not bench.moves_since(0.0)
    bench.do(ReleaseLease("you"))
    bench.step(1)
    task = bench.state.tasks[0]
    assert (task.phase, task.next_what) == (TaskPhase.COUNTDOWN, "four points")
    assert 3.0 < (task.next_at - bench.clock.utc()).total_seconds() <= 5.0
    assert not bench.moves_since(0.0)
    bench.step(5)
    assert (bench.state.tasks[0].phase, bench.state.holder) == (TaskPhase.RUNNING, "scan")
    assert finish(bench).is_done


def test_a_person_who_takes_control_has_the_dish_and_the_scan_goes_on_where_it_was(bench):
    bench.do(scan())
    run_to(bench, 2)
    bench.do(Goto(100.0, 50.0, "you", take_over=True))
    assert bench.state.position.az_deg == pytest.approx(100.0, abs=0.1)
    assert bench.state.tasks[0].phase is TaskPhase.YIELDED
    bench.do(ReleaseLease("you"))
    assert finish(bench).is_done
    assert FourPoints.heard_at == [0, 1, 2, 3]


def test_what_no_person_has_just_asked_for_counts_down_and_stop_cancels_it(bench):
    bench.do(scan(asked=False))
    bench.step(3)
    assert bench.state.tasks[0].phase is TaskPhase.COUNTDOWN
    bench.station.stop("you")
    bench.step(10)
    assert not bench.state.tasks
    assert told(bench)[-1].why == "STOP by you."
    assert not [line for line in bench.lines() if line.startswith("a 0 170")]


def test_stop_ends_it_and_held_keeps_it_from_beginning(bench):
    bench.do(scan())
    run_to(bench, 1)
    bench.station.stop("you")
    bench.step(3)
    assert told(bench)[-1].why == "STOP by you."
    assert bench.state.held is not None
    with pytest.raises(BirdcageError, match="HELD"):
        bench.do(scan())
    bench.do(Release("you"))
    assert bench.do(scan()) == 2
    assert finish(bench).is_done


def test_a_lost_link_interrupts_it_and_a_person_lets_it_go_on_where_it_was(bench):
    bench.do(scan())
    run_to(bench, 2)
    bench.device.unplug()
    bench.step(2)
    task = bench.state.tasks[0]
    assert (task.phase, bench.state.held.reason) == (TaskPhase.INTERRUPTED, "link")
    assert "Release it to resume." in task.why
    bench.device.plug()
    bench.step(20)
    assert bench.state.tasks[0].phase is TaskPhase.INTERRUPTED
    assert (bench.state.held.next_holder, bench.state.held.ignored) != (None, 0)
    bench.do(Release("you"))
    assert finish(bench).is_done
    assert FourPoints.heard_at[-2:] == [2, 3]


def test_the_program_that_comes_after_a_kill_takes_it_up_where_it_was(tmp_path):
    before = made(state_folder=tmp_path)
    before.do(scan())
    run_to(before, 2)
    before.station._host._file._writer.flush()
    # kill -9: nothing is closed, nothing is told
    after = made(state_folder=tmp_path)
    kept = after.state.kept_task
    assert (kept.kind, kept.holder, kept.done, kept.of) == ("four points", "scan", 2, 4)
    assert not after.moves_since(0.0)
    after.do(ResumeTask("you"))
    assert after.state.kept_task is None
    assert finish(after).is_done
    assert FourPoints.heard_at == [2, 3]
    after.session.close()
    assert made(state_folder=tmp_path).state.kept_task is None


def test_what_it_was_given_comes_back_as_it_was(tmp_path):
    before = made(state_folder=tmp_path)
    before.do(BeginTask("given points", {"points": POINTS}, "scan"))
    run_to(before, 2)
    before.station._host._file._writer.flush()
    after = made(state_folder=tmp_path)
    after.do(ResumeTask("you"))
    assert after.station._host.find("given points").task.points == POINTS


def test_what_cannot_begin_now_can_be_resumed_later(tmp_path):
    before = made(state_folder=tmp_path)
    before.do(scan())
    run_to(before, 1)
    before.session.close()
    after = made(state_folder=tmp_path)
    after.station.stop("you")
    after.step(2)
    with pytest.raises(BirdcageError, match="HELD"):
        after.do(ResumeTask("you"))
    assert after.state.kept_task.done == 1
    after.do(Release("you"))
    after.do(ResumeTask("you"))
    assert finish(after).is_done


def test_what_is_dropped_is_not_taken_up_and_a_damaged_file_is_none(tmp_path):
    before = made(state_folder=tmp_path)
    before.do(scan())
    run_to(before, 1)
    before.session.close()
    after = made(state_folder=tmp_path)
    assert after.state.kept_task.done == 1
    after.do(DropTask("you"))
    after.session.close()
    with pytest.raises(CommandRefused, match="no task to resume"):
        made(state_folder=tmp_path).do(ResumeTask("you"))
    for text in ("", "[]", '{"kind": 3}', "\x00" * 9, '{"port": "sim:test", "firmware": "g2", "kind": "four points"}'):
        (tmp_path / "task.json").write_text(text)
        assert made(state_folder=tmp_path).state.kept_task is None


def test_another_one_of_its_kind_replaces_it_and_another_holder_is_refused(bench):
    bench.do(scan())
    run_to(bench, 1)
    with pytest.raises(LeaseDenied, match="scan has control"):
        bench.do(scan(holder="another"))
    assert bench.do(scan()) == 2
    assert "Another four points replaced it." in [each.why for each in told(bench)]
    assert finish(bench).is_done


def test_a_drive_by_its_holder_ends_the_scan_so_that_one_task_alone_moves_the_dish(bench):
    bench.do(scan(holder="you"))
    run_to(bench, 1)
    bench.do(Drive(1, 0, "you"))
    assert [task.kind for task in bench.state.tasks] == ["drive"]
    bench.step(6)
    assert not bench.state.tasks
    heard = list(FourPoints.heard_at)
    bench.do(scan(holder="you"))
    run_to(bench, 1)
    bench.do(BeginTask("two points", {}, "you"))
    assert [task.kind for task in bench.state.tasks] == ["two points"]
    assert "The two points replaced it." in [each.why for each in told(bench)]
    assert finish(bench).is_done
    assert FourPoints.heard_at[len(heard) :] == [0, 0, 1]


def test_its_holder_ends_it_and_the_dish_rests_without_being_held(bench):
    bench.do(scan())
    run_to(bench, 1)
    bench.do(EndMotion("another"))
    assert bench.state.tasks
    bench.do(EndMotion("scan"))
    bench.step(5)
    assert (told(bench)[-1].why, bench.state.tasks) == ("Ended by scan.", ())
    assert (bench.state.holder, bench.state.held, bench.state.activity) == (None, None, Activity.IDLE)


def test_the_end_of_a_holders_motion_stops_their_go_to_alone(bench):
    future = bench.station.submit(Goto(90.0, 40.0, "gpredict"))
    bench.step(0.5)
    bench.do(EndMotion("you"))
    assert bench.state.activity is Activity.SLEWING
    bench.do(EndMotion("gpredict"))
    bench.step(5)
    with pytest.raises(Stopped, match="Ended by gpredict"):
        future.result(0)
    assert (bench.state.holder, bench.state.held, bench.state.activity) == (None, None, Activity.IDLE)
    assert abs(bench.state.position.az_deg - 90.0) > 5.0


def test_what_is_no_task_is_refused_with_a_reason(bench):
    with pytest.raises(CommandRefused, match="no task called sweep: four points, two points") as unknown:
        bench.do(BeginTask("sweep", {}, "you"))
    assert unknown.value.reason == "unknown"
    with pytest.raises(CommandRefused, match="can't begin"):
        bench.do(BeginTask("four points", {"points": 5}, "you"))


def test_a_request_has_its_turn_between_the_steps_of_a_task_without_pause(bench):
    bench.do(BeginTask("without pause", {}, "scan"))
    bench.step(1.0)
    asked = bench.station.submit(Watch("a page", frozenset({"position"})))
    bench.step(0.5)
    assert asked.done()
    assert 0 < bench.state.tasks[0].done < 400, "and the task goes on"
