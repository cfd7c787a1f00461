"""The machine stays awake while the dish moves, and a little longer."""

from __future__ import annotations

import logging
import sys
import threading

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.station import inhibitor
from birdcage.station.events import ActivityChanged, PursuitChanged, TaskChanged
from birdcage.station.inhibitor import SleepInhibitor
from birdcage.station.pursuit_state import Phase, Pursuit, PursuitOptions
from birdcage.station.state import Activity, StationState
from birdcage.station.state_store import StateStore
from birdcage.station.task_state import TaskPhase, TaskState

WAIT_S = 5.0


class Mover:
    """A station as far as an inhibitor sees one."""

    def __init__(self, demo: bool = False) -> None:
        self.board = StateStore(VirtualClock(), StationState(demo=demo))
        self.subscribe, self.warn = self.board.subscribe, self.board.warn

    @property
    def state(self) -> StationState:
        return self.board.state

    def pursues(self, phase: Phase) -> None:
        pursuit = Pursuit(1, "you", None, PursuitOptions(), phase, 0.0, "")
        self.board.tell(PursuitChanged(*self.board.stamp(), pursuit))

    def works(self, *phases: TaskPhase) -> None:
        for phase in phases:
            task = TaskState(1, "map", "you", phase, 0.0, "")
            self.board.change(tasks=() if phase is TaskPhase.OVER else (task,))
            self.board.tell(TaskChanged(*self.board.stamp(), task))

    def does(self, activity: Activity) -> None:
        self.board.tell(ActivityChanged(*self.board.stamp(), activity, ""))


class Holds:
    """A launcher that counts."""

    def __init__(self, *, refused: bool = False) -> None:
        self.taken = self.ended = 0
        self.change = threading.Condition()
        self._refused = refused

    def __call__(self):
        with self.change:
            self.taken += 1
            self.change.notify_all()
        return self

    def works(self) -> bool:
        return not self._refused

    def let_go(self) -> None:
        with self.change:
            self.ended += 1
            self.change.notify_all()

    def become(self, taken: int, ended: int) -> bool:
        with self.change:
            return self.change.wait_for(lambda: (self.taken, self.ended) == (taken, ended), WAIT_S)


@pytest.mark.parametrize("activity", [Activity.SLEWING, Activity.HOMING, Activity.MOVING_UNASKED])
def test_one_hold_for_a_motion_until_a_little_after_it(activity) -> None:
    station, holds = Mover(), Holds()
    awake = SleepInhibitor(station, holds, after_s=0.05)
    station.does(Activity.IDLE)
    station.does(activity)
    assert holds.become(1, 0)
    station.does(Activity.STOPPING)
    station.does(Activity.IDLE)
    assert holds.become(1, 1)
    station.does(activity)
    assert holds.become(2, 1)
    awake.close()
    assert (holds.taken, holds.ended) == (2, 2)


def test_a_task_that_waits_or_rests_between_two_motions_keeps_the_hold() -> None:
    station, holds = Mover(), Holds()
    awake = SleepInhibitor(station, holds, after_s=0.05)
    station.works(TaskPhase.WAITING, TaskPhase.RUNNING)
    assert holds.become(1, 0)
    station.does(Activity.SLEWING)
    station.does(Activity.IDLE)
    station.works(TaskPhase.RUNNING)
    assert (holds.taken, holds.ended) == (1, 0)
    station.works(TaskPhase.OVER)
    assert holds.become(1, 1)
    awake.close()


def test_a_motion_that_follows_soon_keeps_the_hold() -> None:
    station, holds = Mover(), Holds()
    awake = SleepInhibitor(station, holds, after_s=60.0)
    for activity in (Activity.SLEWING, Activity.IDLE, Activity.SLEWING, Activity.IDLE):
        station.does(activity)
    assert holds.become(1, 0)
    awake.close()
    assert (holds.taken, holds.ended) == (1, 1)


def test_never_for_a_simulated_dish() -> None:
    station, holds = Mover(demo=True), Holds()
    awake = SleepInhibitor(station, holds)
    station.does(Activity.SLEWING)
    awake.close()
    assert holds.taken == 0


def test_a_system_without_one_is_told_of_once(caplog) -> None:
    station, asked = Mover(), []
    caplog.set_level(logging.INFO)
    awake = SleepInhibitor(station, lambda: asked.append(1), after_s=0.0)
    for activity in (Activity.SLEWING, Activity.IDLE, Activity.SLEWING):
        station.does(activity)
    awake.close()
    assert len(asked) == 1
    assert [record.getMessage() for record in caplog.records] == [
        "This machine may fall asleep while the dish moves: this system has no sleep inhibitor that birdcage knows."
    ]
    assert "may fall asleep" in station.state.warnings["sleep"]


def test_one_that_cannot_be_started_is_no_fault_of_the_station(caplog) -> None:
    caplog.set_level(logging.INFO)

    def fail():
        raise OSError("no more processes")

    station = Mover()
    awake = SleepInhibitor(station, fail)
    station.does(Activity.SLEWING)
    awake.close()
    assert "no more processes" in caplog.text


def test_one_that_the_system_refuses_is_not_tried_again(caplog) -> None:
    caplog.set_level(logging.INFO)
    station, holds = Mover(), Holds(refused=True)
    awake = SleepInhibitor(station, holds, after_s=0.0)
    station.does(Activity.SLEWING)
    station.does(Activity.IDLE)
    assert holds.become(1, 1)
    station.does(Activity.SLEWING)
    awake.close()
    assert holds.taken == 1
    assert "refused" in caplog.text


def test_the_helper_process_ends_with_its_hold() -> None:
    child = inhibitor.Child([sys.executable, "-c", "import sys; sys.stdin.read()"])
    assert child.works()
    child.let_go()
    assert not child.works()


def test_which_helper_a_system_has(monkeypatch) -> None:
    started = []
    monkeypatch.setattr(inhibitor, "Child", started.append)
    monkeypatch.setattr(inhibitor.shutil, "which", lambda name: f"/bin/{name}")
    for platform in ("linux", "darwin"):
        monkeypatch.setattr(inhibitor.sys, "platform", platform)
        inhibitor.launch()
    assert [command[0] for command in started] == ["/bin/systemd-inhibit", "/bin/caffeinate"]
    monkeypatch.setattr(inhibitor.shutil, "which", lambda name: None)
    assert inhibitor.launch() is None


def test_a_pass_that_is_waited_for_keeps_it_awake_though_nothing_moves() -> None:
    station, holds = Mover(), Holds()
    awake = SleepInhibitor(station, holds, after_s=0.05)
    station.pursues(Phase.WAITING)
    assert holds.become(1, 0)
    station.does(Activity.SLEWING)
    station.does(Activity.IDLE)
    station.pursues(Phase.READY)
    station.pursues(Phase.OVER)
    assert holds.become(1, 1)
    awake.close()
