"""The motor test over the wire: what it measures, how it ends, and what it refuses."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.base.errors import CommandRefused
from birdcage.diagnostics.motor_test_records import MotorTest
from birdcage.diagnostics.motor_test_task import KIND
from birdcage.diagnostics.motor_test_words import axis_words
from birdcage.rotator.feature import Reading
from birdcage.station.requests import AcquireLease, BeginTask, Goto, Jog
from birdcage.station.state import Activity, FaultReason
from birdcage.station.task_state import TaskPhase

from .motor_bench import LATE, MotorBench


def on_its_way(options="seed=1"):
    """Return a bench whose azimuth is in the middle of its first way that is measured."""
    bench = MotorBench(f"az=-180&{options}")
    bench.begin(axis="azimuth")
    bench.turn_until(lambda truth: truth.moving and truth.cable_deg < -185.0)
    bench.turn_until(lambda truth: truth.moving and truth.cable_deg > -175.0)
    return bench


@pytest.mark.parametrize("figures", [((65.0, 400.0), (45.0, 400.0)), ((40.0, 250.0), (30.0, 150.0))])
@pytest.mark.parametrize("options", ["", LATE, f"{LATE}&az=-180"])
def test_speed_and_acceleration_are_those_of_the_dish(options, figures):
    bench = MotorBench(options)
    bench.set_motors(*figures)
    begun = bench.state.position
    bench.begin()
    ended = bench.end()
    assert ended.is_done, ended.why
    assert (ended.done, ended.of) == (12, 12)
    for axis, (speed, acceleration) in zip(("azimuth", "elevation"), figures, strict=True):
        for way in ("up", "down"):
            assert ended.found[f"{axis}.speed_{way}"] == pytest.approx(speed, rel=0.02)
            assert ended.found[f"{axis}.acceleration_{way}"] == pytest.approx(acceleration, rel=0.1)
        assert 0.0 < ended.found[f"{axis}.arrival_deg"] < 0.1
    assert ended.found["health.driver.azimuth"] == "OK"
    assert "The motor drivers report no fault." in ended.why
    assert bench.state.position.az_deg % 360.0 == pytest.approx(begun.az_deg % 360.0, abs=0.2)
    assert bench.state.position.el_deg == pytest.approx(begun.el_deg, abs=0.2)
    assert bench.state.holder is None


def test_one_axis_alone_leaves_the_other_where_it_is():
    bench = MotorBench("az=-180")
    bench.begin(axis="elevation", rounds=1, longest_deg=20.0)
    bench.look(8.0)
    assert bench.last.is_done, bench.last.why
    cables = [az for az, _el in bench.seen]
    assert max(cables) - min(cables) < 0.02
    heights = [el for _az, el in bench.seen]
    assert max(heights) - min(heights) == pytest.approx(20.0, abs=0.2)


@pytest.mark.parametrize("seed", range(3, 8))
def test_lost_bytes_are_asked_for_again(seed):
    bench = MotorBench(f"{LATE}&az=-180&drop=0.0003&seed={seed}")
    bench.begin(axis="azimuth")
    ended = bench.end()
    assert ended.is_done, ended.why
    assert ended.found["azimuth.speed"] == pytest.approx(65.0, rel=0.02)
    assert ended.found["azimuth.acceleration"] == pytest.approx(400.0, rel=0.1)


def test_a_dish_that_is_slower_than_it_says_is_told(monkeypatch):
    bench = MotorBench("az=-180")
    bench.set_motors((50.0, 400.0), (45.0, 400.0))
    read = type(bench.station._antenna.rotator).read

    def boast(self, ids):
        told = dict(read(self, ids))
        return {
            name: Reading(65.0, each.unit, each.at, each.utc) if name == "speed.azimuth" else each
            for name, each in told.items()
        }

    monkeypatch.setattr(type(bench.station._antenna.rotator), "read", boast)
    bench.begin(axis="azimuth")
    ended = bench.end()
    assert "Azimuth: 50.0 ±0.1 °/s of 65" in ended.why
    assert "Its speed is 23% below nominal. Check its settings for speed and acceleration, and home it" in ended.why
    assert "acceleration is" not in ended.why


def test_what_the_readings_do_not_tell_is_not_measured():
    assert axis_words(MotorTest(datetime(2026, 11, 27, tzinfo=UTC), "azimuth", 40.0)) == (
        "Azimuth: speed not measured, acceleration not measured, no stall seen over 40°."
    )


@pytest.mark.parametrize("options", ["seed=1", LATE])
def test_a_stall_on_the_way_ends_it_and_tells_the_angle(options):
    bench = on_its_way(options)
    bench.device.stall(0)
    stood = bench.device.truth().az_deg
    ended = bench.end(10.0)
    assert (ended.phase, ended.is_done) == (TaskPhase.OVER, False)
    assert "The azimuth is stalled" in ended.why
    assert "The motor test is not complete." in ended.why
    assert ended.found["azimuth.stalled_at_deg"] == pytest.approx(stood, abs=8.0)
    bench.step(3.0)
    assert bench.state.fault.reason is FaultReason.STALL
    assert bench.state.held is not None
    assert bench.state.position.az_deg == pytest.approx(stood, abs=0.1)
    at = bench.clock.monotonic()
    bench.step(20.0)
    assert bench.moves_since(at) == []


def test_a_motor_that_slips_unnoticed_is_told_by_its_driver():
    bench = MotorBench("az=-180&stall=slip")
    bench.begin(axis="azimuth", rounds=1)
    bench.turn_until(lambda truth: truth.moving)
    bench.device.stall(0)
    ended = bench.end()
    assert "The az driver says FAULT: cut the power, look for what blocks the motor, and home it." in ended.why


def test_an_axis_that_stops_short_without_a_word_is_a_fault_of_the_station():
    bench = on_its_way()
    axis = bench.device.dish.axes[0]
    axis.on_blocked = None
    axis.block(bench.device.machine.dish_s, slips=False)
    ended = bench.end(60.0)
    assert not ended.is_done
    assert bench.state.fault.reason is FaultReason.STALL
    assert "azimuth.speed" not in ended.found
    assert ended.found["azimuth.stalled_at_deg"] == pytest.approx(bench.device.truth().az_deg, abs=0.1)


@pytest.mark.parametrize("wait_s", [0.7, 2.3, 3.1])
def test_stop_ends_it_and_nothing_moves_after_that(wait_s):
    bench = MotorBench(f"{LATE}&az=-180")
    bench.begin()
    bench.step(wait_s)
    bench.station.stop("you")
    bench.step(3.0)
    assert not bench.state.tasks
    assert bench.state.held is not None
    assert "STOP by you." in bench.last.why
    assert "The motor test is not complete." in bench.last.why
    assert not bench.device.truth().moving
    at = bench.clock.monotonic()
    bench.step(20.0)
    assert bench.moves_since(at) == []


def test_a_step_by_hand_ends_it():
    bench = MotorBench("az=-180")
    bench.begin()
    bench.step(3.0)
    bench.do(Jog(1.0, 0.0, "you"))
    assert not bench.state.tasks


def test_who_takes_control_in_the_middle_has_a_dish_that_comes_to_rest():
    bench = on_its_way()
    at = bench.clock.monotonic()
    bench.do(AcquireLease("other", take_over=True))
    bench.step(5.0)
    assert not bench.state.tasks
    assert bench.last.why == "other has control."
    assert bench.moves_since(at) == []
    assert bench.state.activity is Activity.IDLE
    bench.do(Goto(190.0, 45.0, "other"))
    assert bench.state.position.az_deg == pytest.approx(190.0, abs=0.1)


def test_a_way_whose_link_is_lost_ends_the_test():
    bench = on_its_way()
    bench.device.wire.to_host.silent = True
    ended = bench.end(30.0)
    assert not ended.is_done
    assert "The dish is silent" in ended.why
    bench.device.wire.to_host.silent = False
    at = bench.clock.monotonic()
    bench.step(30.0)
    assert bench.moves_since(at) == []
    assert bench.state.held is not None
    assert bench.state.activity is Activity.IDLE


def test_each_round_goes_up_first_and_the_end_is_where_it_stood():
    bench = MotorBench("az=-180")
    bench.begin(axis="azimuth", rounds=2)
    at = bench.clock.monotonic()
    assert bench.end().is_done
    sent = [float(line.split()[2]) for line in bench.moves_since(at - 0.2) if line.startswith("a 0 ")]
    assert sent == pytest.approx([150.0, 210.0, 150.0, 210.0, 150.0, 180.0], abs=0.1)


def test_it_does_not_begin_while_somebody_else_has_control():
    bench = MotorBench("az=-180")
    bench.do(AcquireLease("other"))
    before = bench.clock.monotonic()
    bench.begin()
    assert "other has control" in bench.end().why
    assert bench.moves_since(before) == []


def test_it_does_not_begin_by_itself():
    bench = MotorBench("az=-180")
    before = bench.clock.monotonic()
    bench.do(BeginTask(KIND, {}, "you", asked=False))
    assert "only when a person asks for it" in bench.end().why
    assert bench.moves_since(before) == []


@pytest.mark.parametrize("values", [
    {"axis": "skew"}, {"rounds": 0}, {"rounds": 11}, {"rounds": "two"}, {"longest_deg": 4.0}, {"longest_deg": 61.0},
    {"longest_deg": True}, {"other": 1.0},
])  # fmt: skip
def test_values_that_make_no_test_are_refused(values):
    bench = MotorBench()
    with pytest.raises(CommandRefused, match="The motor test can't begin"):
        bench.begin(**values)


@pytest.mark.parametrize(("firmware", "why"), [
    ("hal205", "moves in silence"), ("carryout", "tells where it is only on its way"),
])  # fmt: skip
def test_what_tells_nothing_while_it_moves_is_not_measured(firmware, why):
    bench = MotorBench(firmware=firmware)
    before = bench.clock.monotonic()
    bench.begin()
    ended = bench.end()
    assert why in ended.why
    assert "Nothing was sent." in ended.why
    assert bench.moves_since(before) == []
    assert ended.found == {}
