"""Links that fall silent or vanish, clocks that step, dishes that restart or move by themselves."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held, LinkError, Stopped
from birdcage.sim.wire import Byte
from birdcage.station.requests import AcknowledgeFault, Goto, Release
from birdcage.station.state import Activity, LinkPhase

from .conftest import Bench


def test_a_port_that_is_not_there_is_looked_for_until_it_is():
    bench = Bench()
    bench.device.unplug()
    bench.step(4)
    assert bench.state.link.state is LinkPhase.LOST
    assert bench.state.position is None
    bench.device.plug()
    bench.step(6)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.position is not None


def test_a_silent_dish_is_told_within_two_seconds_and_shows_no_position():
    bench = Bench()
    bench.device.wire.to_host.silent = True
    bench.step(2.1)
    assert bench.state.link.state is LinkPhase.SILENT
    assert bench.state.position is None
    assert "deadlocked" in bench.state.link.detail
    bench.device.wire.to_host.silent = False
    bench.step(8)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.position is not None


def test_unplugged_in_mid_slew_the_motion_is_given_up_and_held(bench):
    bench.do(Goto(60, 45, "you"))
    future = bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.5)
    bench.device.unplug()
    bench.step(1)
    assert bench.state.link.state is LinkPhase.LOST
    assert isinstance(future.exception(0), Stopped)
    assert bench.state.position_lost is not None
    bench.device.plug()
    bench.step(10)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.held.reason == "link"
    with pytest.raises(Held):
        bench.do(Goto(180, 45, "Gpredict"))
    bench.do(Release("you"))
    bench.do(Goto(180, 45, "you"))


def test_after_a_gap_nothing_moves_by_itself(bench):
    bench.do(Goto(60, 45, "you"))
    bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.5)
    bench.device.unplug()
    bench.step(1)
    bench.device.plug()
    since = bench.clock.monotonic()
    bench.step(60)
    assert bench.moves_since(since) == []


def test_a_link_lost_while_nothing_moves_needs_no_release():
    bench = Bench().connect()
    bench.watch("position")
    bench.step(2)
    bench.device.unplug()
    bench.step(3)
    bench.device.plug()
    bench.step(10)
    assert bench.state.held is None


def test_a_motion_asked_for_without_a_link_is_refused_not_kept(bench):
    bench.watch("position")
    bench.device.unplug()
    bench.step(3)
    with pytest.raises(LinkError):
        bench.do(Goto(210, 45, "you"))
    bench.device.plug()
    since = bench.clock.monotonic()
    bench.step(20)
    assert bench.moves_since(since) == []


@pytest.mark.parametrize("step_s", [5.0, -5.0, 3600.0])
def test_a_clock_step_or_suspend_holds_and_reads_again(bench, step_s):
    bench.watch("position")
    bench.step(2)
    start = bench.clock.monotonic()
    bench.clock.step_utc(step_s)
    bench.step(3)
    assert "clock" in bench.state.held.reason
    assert any(line == "a" for at, line in bench.received() if at > start)
    assert bench.state.position_lost is None


def test_a_small_correction_of_the_clock_is_nothing(bench):
    bench.clock.step_utc(1.0)
    bench.step(3)
    assert bench.state.held is None


def test_a_dish_that_restarts_is_a_fault_until_acknowledged(bench):
    bench.watch("position")
    bench.step(12)
    bench.device.reboot()
    bench.step(20)
    assert bench.state.fault.reason == "reboot"
    assert bench.state.held is not None
    bench.step(40)
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    assert bench.state.fault is None


def test_a_dish_that_moves_though_nobody_asked_is_a_fault(bench):
    bench.watch("position")
    bench.do(Goto(60, 45, "you"))
    bench.step(3)
    bench.sim.write(b"a 0 200\r")
    bench.step(3)
    assert bench.state.fault.reason == "moved"
    assert bench.state.activity in (Activity.MOVING_UNASKED, Activity.IDLE)
    bench.step(10)
    assert bench.state.activity is Activity.IDLE


@pytest.mark.parametrize("line", ["a 0 201", "a 0 199.5", "a 1 46"])
def test_a_small_way_that_nobody_asked_for_is_a_fault_too(bench, line):
    bench.watch("position", rate_hz=1.0)
    bench.do(Goto(200, 45, "you"))
    bench.step(3)
    bench.sim.write(line.encode() + b"\r")
    bench.step(4)
    assert bench.state.fault.what == "The dish moves unasked"
    assert bench.state.held.reason == "fault"
    since = bench.clock.monotonic()
    with pytest.raises(Held):
        bench.do(Goto(100, 45, "Gpredict"))
    assert bench.moves_since(since) == []


def test_so_is_a_dish_that_creeps_away_less_than_that_from_reading_to_reading(bench):
    bench.watch("position", rate_hz=1.0)
    bench.do(Goto(200, 45, "you"))
    bench.step(3)
    for creep in range(1, 6):
        bench.sim.write(f"a 1 {45 - creep / 5}\r".encode())
        bench.step(1.5)
    assert bench.state.fault.reason == "moved"


def test_a_dish_that_is_asked_to_go_has_not_crept(bench):
    bench.watch("position", rate_hz=1.0)
    for step in range(6):
        bench.do(Goto(200 + step / 5, 45, "you"))
        bench.step(3)
    assert (bench.state.fault, bench.state.activity) == (None, Activity.IDLE)


def test_stop_on_a_motion_nobody_asked_for_retargets_ahead_of_it():
    bench = Bench("g2?seed=1&az_speed=10").connect()
    bench.watch("position")
    bench.do(Goto(200, 45, "you"), 60)
    bench.step(3)
    bench.sim.write(b"a 0 300\r")
    bench.step(3)
    before = bench.device.truth()
    assert before.moving
    bench.station.stop("you")
    bench.step(6)
    after = bench.device.truth()
    assert not after.moving
    assert before.az_deg < after.az_deg < before.az_deg + 15
    assert bench.state.last_stop.confirmed is True


def test_noise_on_an_idle_line_shows_as_noise_and_changes_nothing(bench):
    bench.watch("position")
    bench.step(2)
    position = bench.state.position
    bench.device.wire.to_host.garble = 0.02
    bench.step(30)
    bench.device.wire.to_host.garble = 0.0
    bench.step(15)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.position.az_deg == pytest.approx(position.az_deg, abs=0.02)
    assert not bench.device.truth().moving


def test_ending_the_station_answers_everybody(bench):
    future = bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.3)
    sentence = bench.session.close()
    assert isinstance(future.exception(0), Stopped)
    assert sentence.startswith("STOP was sent. The dish was last seen at AZ")
    assert isinstance(bench.station.submit(Goto(1, 45, "you")).exception(0), Stopped)


def test_one_reading_with_a_lost_digit_is_no_motion():
    bench = Bench("g2?seed=1&az=-180").connect()
    bench.watch("position", rate_hz=1)
    bench.step(10)
    lost = []

    dropped = []

    def once(byte):
        lost.append(byte)
        if not dropped and bytes(lost).endswith(b"Angle[0] = 1"):
            dropped.append(byte)
            return Byte(drop=True)
        return Byte()

    bench.device.wire.to_host.set_plan(once)
    bench.step(20)
    assert dropped
    assert bench.state.fault is None
    assert bench.state.held is None
    assert bench.state.position.az_deg == pytest.approx(180, abs=0.1)


def test_a_dish_that_was_just_switched_on_is_starting_not_faulty():
    bench = Bench("g2?seed=1&boot=1")
    bench.watch("position")
    seen = set()
    for _tenth in range(600):
        bench.step(0.1)
        seen.add(bench.state.activity)
    assert Activity.INITIALIZING in seen
    assert bench.state.fault is None
    assert bench.state.held is None
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.activity is Activity.IDLE


def test_one_damaged_answer_in_mid_move_is_asked_again(bench):
    bench.watch("position")
    bench.do(Goto(60, 45, "you"))
    future = bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.5)
    spoilt = iter([Byte(noise=b"A")])
    seen = bytearray()

    def once(byte):
        seen.append(byte)
        return next(spoilt, Byte()) if seen.endswith(b"Angle[1]") else Byte()

    bench.device.wire.to_host.set_plan(once)
    bench.step(20)
    assert next(spoilt, None) is None, "the answer was spoilt"
    assert future.result(0).az_deg == pytest.approx(210, abs=0.1)
    assert bench.state.held is None


def test_a_line_that_cannot_be_trusted_in_mid_move_ends_it(bench):
    bench.watch("position")
    bench.do(Goto(60, 45, "you"))
    future = bench.station.submit(Goto(210, 45, "you"))
    bench.step(0.5)
    bench.device.wire.to_host.set_plan(lambda byte: Byte(noise=b"?") if byte == ord("=") else Byte())
    bench.step(20)
    assert isinstance(future.exception(0), Stopped)
    assert bench.state.held is not None
