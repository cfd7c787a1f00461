"""Once the client that moved the dish has left, and none wishes anything, it parks: counted down, and called off."""

from __future__ import annotations

import pytest
from birdcage.station.events import TaskChanged
from birdcage.station.requests import AcquireLease, Goto, Home, Park, Release, ReleaseLease
from birdcage.station.state import Activity
from birdcage.station.task_state import TaskPhase

from .shared_bench import SharedBench

PARK = (222.0, 33.0)


def left(idle_s=20.0, firmware="g2", more="az=-160&el=40", **options):
    bench = SharedBench(firmware, more, park=PARK, idle_s=idle_s, **options)
    client, other = bench.join("client", "other")
    client.set_position(250.0, 45.0)
    bench.settle(200.0)
    client.leave()
    return bench, other


def is_parked(bench):
    truth = bench.device.truth()
    return (truth.az_deg % 360.0, truth.el_deg) == pytest.approx(PARK, abs=0.1)


@pytest.mark.parametrize(
    ("firmware", "more"), [("g2", "az=-160&el=40"), ("hal205", ""), ("carryout", "")]
)  # fmt: skip
def test_it_parks_after_its_time_counted_down(firmware, more):
    bench, _ = left(firmware=firmware, more=more)
    bench.run(18.0)
    sent = bench.sent_moves()
    assert bench.state.holder is None
    bench.run(4.0)
    (task,) = bench.state.tasks
    assert (task.kind, task.phase) == ("park", TaskPhase.COUNTDOWN)
    assert bench.sent_moves() == sent
    bench.run(4.0)
    bench.settle(200.0)
    assert is_parked(bench)
    assert (bench.state.holder, bench.state.tasks) == (None, ())
    bench.run(60.0)
    assert len([event for event in bench.events if isinstance(event, TaskChanged) and event.task.is_done]) == 1


def test_stop_in_the_countdown_calls_it_off():
    bench, _ = left()
    bench.run(22.0)
    sent = bench.sent_moves()
    bench.station.stop("you")
    bench.run(60.0)
    assert bench.sent_moves() == sent
    assert bench.state.held is not None


def test_a_stop_that_was_released_meanwhile_calls_it_off():
    bench, _ = left()
    bench.run(5.0)
    bench.station.stop("you")
    bench.run(3.0)
    bench.do(Release("you"))
    bench.run(60.0)
    assert not is_parked(bench)


def test_a_task_of_somebody_else_calls_it_off():
    bench, _ = left()
    bench.run(18.0)
    bench.station.submit(Park(240.0, 40.0, "tracker", asked=False))
    bench.run(60.0)
    assert bench.state.position.az_deg == pytest.approx(240.0, abs=0.1)


@pytest.mark.parametrize("after", [10.0, 22.0, 25.6])
def test_another_clients_wish_calls_it_off_even_on_its_way(after):
    bench, other = left()
    bench.run(after)
    other.set_position(260.0, 40.0)
    bench.run(0.5)
    other.set_position(260.5, 40.0)
    bench.run(60.0)
    assert bench.state.position.az_deg == pytest.approx(260.5, abs=0.1)
    assert bench.state.holder == "other"


def test_a_person_who_had_it_meanwhile_calls_it_off():
    bench, _ = left()
    bench.run(5.0)
    bench.do(AcquireLease("you"))
    bench.run(2.0)
    bench.do(ReleaseLease("you"))
    bench.run(60.0)
    assert not is_parked(bench)


def test_a_person_who_takes_it_in_the_countdown_ends_it_for_good():
    bench, _ = left()
    bench.run(22.0)
    bench.do(AcquireLease("you"))
    bench.run(2.0)
    bench.do(ReleaseLease("you"))
    bench.run(60.0)
    assert not is_parked(bench)


def test_a_wish_ends_it_on_its_way():
    bench, other = left(firmware="hal205", more="")
    while bench.state.holder != "rotctld":
        bench.run(0.1)
    bench.run(1.0)
    assert bench.state.motion is not None
    other.set_position(300.0, 41.0)
    bench.run(1.0)
    assert bench.state.holder == "other"
    bench.settle(200.0)
    assert other.position() == pytest.approx((300.0, 41.0), abs=0.1)
    assert bench.view("other").ignored == 0


def test_control_that_is_on_its_way_back_calls_nothing_off():
    bench = SharedBench(more="az=-160&el=40", park=PARK, idle_s=5.0)
    client = bench.join("client")
    client.set_position(250.0, 45.0)
    bench.settle()
    client.leave()
    bench.shared.tick()
    assert bench.state.holder == "client"
    bench.run(30.0)
    assert is_parked(bench)


@pytest.mark.parametrize("options", [{"idle_s": 0.0}])
def test_never_means_never(options):
    bench, _ = left(**options)
    bench.run(60.0)
    assert not is_parked(bench)


def test_one_who_only_looked_leaves_and_nothing_parks():
    bench = SharedBench(park=PARK, idle_s=5.0)
    bench.join("client").leave()
    bench.run(30.0)
    assert not bench.sent_moves()


def test_one_who_said_s_leaves_and_nothing_parks():
    bench = SharedBench(more="az=-160&el=40", park=PARK, idle_s=5.0)
    client = bench.join("client")
    client.set_position(250.0, 45.0)
    bench.settle()
    client.stop()
    bench.run(0.5)
    client.leave()
    bench.run(30.0)
    assert not is_parked(bench)


def test_with_a_known_turn_it_parks_nearest_the_middle_of_the_cable():
    bench = SharedBench()
    bench.connect()
    bench.do(Home("you"), 60.0)
    bench.do(Goto(5.0, 40.0, "you"), 60.0)
    bench.step(2.0)
    assert bench.device.truth().cable_deg == pytest.approx(5.0, abs=0.1)
    bench.do(Park(10.0, 40.0, "you"), 90.0)
    assert bench.device.truth().cable_deg == pytest.approx(-350.0, abs=0.1)
    assert bench.state.activity is Activity.IDLE
    assert bench.state.holder is None
