from __future__ import annotations

import math
import re

import pytest
from birdcage.base.errors import BelowFloor, Held, LeaseDenied, LinkError, MotionRefused, PositionUnknown, Superseded
from birdcage.station.events import MoveEnded
from birdcage.station.requests import AcquireLease, Goto, Home, Jog, Release, ReleaseLease
from birdcage.station.state import Activity

from .conftest import Bench


def go(az, el, holder="you", **more):
    return Goto(az, el, holder, **more)


def test_a_goto_resolves_at_arrival_exactly_there(bench):
    bench.do(go(90, 30))
    pointing = bench.do(go(180, 45))
    assert pointing.az_deg == pytest.approx(180, abs=0.07)
    assert pointing.el_deg == pytest.approx(45, abs=0.07)
    truth = bench.device.truth()
    assert not truth.moving
    assert "a 0 180.00" in bench.lines()
    assert "a 1 45.00" in bench.lines()
    assert bench.state.activity is Activity.IDLE
    assert bench.state.motion is None


def test_there_already(bench):
    bench.do(go(180, 45))
    assert bench.do(go(180, 45)).az_deg == pytest.approx(180, abs=0.07)


@pytest.mark.parametrize(
    ("az", "el", "error"),
    [(math.nan, 45, MotionRefused), (180, math.inf, MotionRefused), (400, 45, MotionRefused), (180, 5, BelowFloor)],
)
def test_a_refused_motion_sends_nothing(bench, az, el, error):
    before = bench.clock.monotonic()
    with pytest.raises(error):
        bench.do(go(az, el))
    bench.step(1)
    assert bench.moves_since(before) == []


def test_clamping_only_when_asked(bench):
    pointing = bench.do(go(180, 5, clamp=True))
    assert pointing.el_deg == pytest.approx(18, abs=0.07)


def test_latest_wins_and_the_older_future_says_so(bench):
    first = bench.station.submit(go(300, 45))
    bench.step(0.5)
    bench.do(go(170, 40))
    with pytest.raises(Superseded):
        first.result(0)
    assert bench.device.truth().az_deg == pytest.approx(170, abs=0.1)


def test_ten_presses_are_ten_steps(bench):
    bench.do(go(180, 45))
    for _press in range(10):
        bench.station.submit(Jog(1.0, 0.0, "you"))
        bench.step(0.02)
    bench.step(3)
    assert bench.state.position.az_deg == pytest.approx(190, abs=0.07)


def test_the_lease(bench):
    bench.do(AcquireLease("tracker"))
    with pytest.raises(LeaseDenied, match="tracker has control"):
        bench.do(go(180, 45))
    bench.do(AcquireLease("you", take_over=True))
    bench.do(go(180, 45))
    bench.do(ReleaseLease("you"))
    assert bench.state.holder is None


def test_no_motion_without_a_link():
    bench = Bench()
    bench.device.unplug()
    bench.step(1)
    with pytest.raises(LinkError):
        bench.do(go(180, 45))


def test_an_unhomed_dish_is_not_moved_and_homes_when_asked():
    bench = Bench("g2?seed=1&unhomed=1").connect()
    assert bench.state.homed is False
    assert bench.state.position is None
    with pytest.raises(PositionUnknown, match="not homed"):
        bench.do(go(180, 45))
    bench.do(Home("you"), seconds=60)
    assert bench.state.homed is True
    assert bench.state.position.cable_deg is not None
    bench.do(go(180, 45))


def test_a_stalled_axis_is_a_fault_that_holds_until_acknowledged(bench):
    bench.do(go(180, 45))
    future = bench.station.submit(go(300, 45))
    bench.step(0.5)
    bench.device.stall(0)
    bench.step(6)
    assert "azimuth is stalled" in str(future.exception(0))
    assert bench.state.fault.reason == "stall"
    assert "azimuth" in bench.state.fault.what
    with pytest.raises(Held):
        bench.do(go(200, 45))


def test_a_fault_holds_after_a_release_too_until_it_is_acknowledged(bench):
    bench.do(go(180, 45))
    bench.station.submit(go(300, 45))
    bench.step(0.5)
    bench.device.stall(0)
    bench.step(6)
    bench.do(Release("you"))
    since = bench.clock.monotonic()
    with pytest.raises(Held, match="Acknowledge the fault first") as held:
        bench.do(go(200, 45))
    assert held.value.reason == "fault"
    assert bench.moves_since(since) == []


def test_a_dish_that_is_stuck_a_few_degrees_off_has_not_arrived(bench):
    bench.do(go(180, 45))
    bench.device.firmware.stalled = lambda _axis: None
    bench.device.stall(0)
    future = bench.station.submit(go(183, 45))
    bench.step(8)
    assert re.search(r"stands still at 179\.\d\d°/44\.\d\d°, \d\.\d\d° from its target", str(future.exception(0)))


def test_a_stalled_axis_that_the_dish_does_not_tell_of_is_seen(bench):
    bench.do(go(180, 45))
    bench.device.firmware.stalled = lambda _axis: None
    future = bench.station.submit(go(300, 45))
    bench.step(0.5)
    bench.device.stall(0)
    bench.step(6)
    assert "stands still" in str(future.exception(0))
    assert bench.state.fault.reason == "stall"


def test_settings_that_could_not_be_read_refuse_motion_until_accepted():
    from birdcage.station.requests import AcceptLimits

    bench = Bench(options={"refuse_motion": "[motion] of birdcage.toml could not be read."}).connect()
    assert bench.state.position is not None
    with pytest.raises(MotionRefused, match="could not be read"):
        bench.do(go(180, 45))
    bench.do(AcceptLimits("you"))
    bench.do(go(180, 45))


def test_an_offset_stands_between_base_and_world():
    from birdcage.antenna.alignment import Alignment

    bench = Bench(options={"alignment": Alignment(10.0, -1.0)}).connect()
    pointing = bench.do(go(5, 44))
    assert pointing.az_deg == pytest.approx(5, abs=0.07)
    assert pointing.dish_az_deg == pytest.approx(355, abs=0.07)
    assert "a 1 45.00" in bench.lines()


def test_the_time_of_arrival_follows_a_slow_dish():
    bench = Bench("g2?seed=1&az_speed=2").connect()
    bench.do(go(350, 45))
    bench.station.submit(go(330, 45))
    bench.step(3)
    motion = bench.state.motion
    assert motion.eta - bench.clock.monotonic() == pytest.approx(7, abs=1)


def test_a_refused_motion_takes_no_control(bench):
    with pytest.raises(MotionRefused):
        bench.do(go(180, 80, holder="Gpredict"))
    assert bench.state.holder is None
    bench.do(go(180, 45))
    with pytest.raises(BelowFloor):
        bench.do(go(180, 5))
    assert bench.state.holder == "you"


def test_a_slow_dish_that_is_nearly_there_has_not_arrived():
    bench = Bench("g2?seed=1&az_speed=0.3").connect()
    bench.watch("position")
    bench.step(3.0)
    here, moving = bench.state.position, []
    bench.station.subscribe(
        lambda event: moving.append(bench.device.truth().moving) if isinstance(event, MoveEnded) else None
    )
    bench.do(go(here.az_deg + 1.0, here.el_deg), 60.0)
    assert moving == [False]


def test_two_looks_that_agree_are_an_arrival(bench):
    bench.do(go(180, 45))
    bench.step(2.0)
    before = bench.clock.monotonic()
    bench.do(go(181, 45))
    looks = [line for at, line in bench.received() if at > before and line == "a"]
    assert len(looks) >= 2
