"""`station.after_reboot = home`: a dish whose power failed at night is homed, and what was interrupted goes on."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held
from birdcage.base.reason import Reason
from birdcage.station.events import FaultAcknowledged, Recovered
from birdcage.station.requests import BeginTask, Goto
from birdcage.station.state import Activity
from birdcage.station.task_state import TaskPhase

from .conftest import Bench
from .test_tasks import FourPoints

HOMES = {"home_after_reboot": True, "tasks": {"four points": FourPoints}}


@pytest.fixture(autouse=True)
def nothing_heard():
    FourPoints.heard_at.clear()


def scanning(**options):
    bench = Bench("g2?seed=1&az_speed=4&el_speed=4", {**HOMES, **options}).connect()
    bench.watch("position")
    bench.step(3.0)
    bench.do(BeginTask("four points", {}, "map"))
    bench.step(2.0)
    return bench


def homings_since(bench, time):
    return [line for at, line in bench.received() if at > time and line.startswith("h ")]


def phases(bench):
    return {each.kind: each.phase for each in bench.state.tasks}


def until(bench, true, seconds):
    end = bench.clock.monotonic() + seconds
    while not true() and bench.clock.monotonic() < end:
        bench.step(0.5)
    assert true()


def test_it_is_homed_after_a_countdown_and_what_was_interrupted_goes_on():
    bench = scanning()
    bench.device.reboot()
    start = bench.clock.monotonic()
    bench.step(2.0)
    assert bench.state.fault.reason == "reboot"
    until(bench, lambda: phases(bench).get("recovery") is TaskPhase.COUNTDOWN, 60.0)
    assert homings_since(bench, start) == []
    until(bench, lambda: any(isinstance(each, Recovered) for each in bench.events), 120.0)
    assert homings_since(bench, start) == ["h 0", "h 1"]
    assert bench.state.fault is None
    assert bench.state.held is None
    assert [each.by for each in bench.events if isinstance(each, FaultAcknowledged)] == ["station.after_reboot"]
    until(bench, lambda: not bench.state.tasks, 240.0)
    assert sorted(set(FourPoints.heard_at)) == [0, 1, 2, 3]


def test_unless_it_is_asked_for_nothing_moves_by_itself():
    bench = scanning(home_after_reboot=False)
    bench.device.reboot()
    start = bench.clock.monotonic()
    bench.step(180.0)
    assert homings_since(bench, start) == []
    assert bench.state.fault.reason == "reboot"


def test_stop_in_the_countdown_holds_it_and_it_is_not_tried_again():
    bench = scanning()
    bench.device.reboot()
    start = bench.clock.monotonic()
    until(bench, lambda: phases(bench).get("recovery") is TaskPhase.COUNTDOWN, 60.0)
    bench.station.stop("you")
    bench.step(180.0)
    assert homings_since(bench, start) == []
    assert bench.state.held.reason == "stop"
    assert bench.state.fault.reason == "reboot"


def test_what_a_person_had_stopped_before_stays_stopped():
    bench = scanning()
    bench.station.stop("you")
    bench.step(3.0)
    bench.device.reboot()
    start = bench.clock.monotonic()
    bench.step(120.0)
    assert homings_since(bench, start) == []
    assert bench.moves_since(start) == []
    assert bench.state.held.by == "you"


def test_a_motor_that_does_not_home_leaves_a_fault_and_a_dish_that_rests():
    bench = scanning()
    bench.device.reboot()
    until(bench, lambda: phases(bench).get("recovery") is TaskPhase.COUNTDOWN, 60.0)
    bench.device.stall(0)
    bench.step(120.0)
    assert bench.state.fault is not None
    assert bench.state.held is not None
    assert bench.state.activity in (Activity.IDLE, Activity.UNKNOWN)
    assert not any(isinstance(each, Recovered) for each in bench.events)


def test_a_second_restart_is_taken_up_like_the_first():
    bench = scanning()
    for _ in range(2):
        bench.device.reboot()
        bench.step(2.0)
        count = sum(isinstance(each, Recovered) for each in bench.events)
        until(bench, lambda count=count: sum(isinstance(each, Recovered) for each in bench.events) > count, 180.0)
    assert bench.state.fault is None


@pytest.mark.parametrize("holder", ["you", "rotctld 1", "tracker"])
def test_in_the_countdown_others_are_refused(holder):
    bench = scanning()
    bench.device.reboot()
    start = bench.clock.monotonic()
    until(bench, lambda: phases(bench).get("recovery") is TaskPhase.COUNTDOWN, 60.0)
    asked = bench.station.submit(Goto(200.0, 40.0, holder))
    bench.step(1.0)
    assert isinstance(asked.exception(timeout=0), Held)
    assert asked.exception().reason is Reason.FAULT
    assert bench.moves_since(start) == []


def test_while_it_is_homed_nothing_else_is_sent():
    bench = scanning()
    bench.device.reboot()
    start = bench.clock.monotonic()
    until(bench, lambda: phases(bench).get("recovery") is TaskPhase.RUNNING, 60.0)
    asked = bench.station.submit(Goto(200.0, 40.0, "rotctld 1"))
    until(bench, lambda: bench.state.fault is None, 60.0)
    assert bench.moves_since(start) == ["h 0", "h 1"]
    assert isinstance(asked.exception(timeout=0), Held)
