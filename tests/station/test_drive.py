"""Driving while a key is held: the dish goes on as long as it is asked for, and ends by itself."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held, LeaseDenied, MotionRefused, Superseded
from birdcage.station.requests import AcquireLease, Drive, Goto
from birdcage.station.state import Activity

from .conftest import Bench


def hold(bench, az, el, seconds, holder="you"):
    for _ in range(round(seconds / 0.2)):
        bench.station.submit(Drive(az, el, holder))
        bench.step(0.2)


@pytest.mark.parametrize(
    ("firmware", "address"), [("g2", "g2?seed=1"), ("hal205", "hal205?seed=1"), ("carryout", "carryout?seed=1")]
)
def test_it_goes_on_while_it_is_held_and_rests_by_itself(firmware, address):
    bench = Bench(address, firmware=firmware).connect(8.0)
    if bench.state.awaits_first_move:
        bench.do(Goto(180.0, 40.0, "you"), 90.0)
    start = bench.state.position.az_deg
    hold(bench, 1, 0, 4.0)
    under_way = bench.state.position.az_deg
    assert bench.state.holder == "you"
    bench.step(8)
    rest = bench.state.position.az_deg
    assert (under_way - start) % 360.0 > 4.0
    assert (rest - start) % 360.0 < 4.0 * 70.0
    assert (bench.state.activity, bench.state.tasks, bench.state.held) == (Activity.IDLE, (), None)
    sent = len(bench.moves_since(0.0))
    bench.step(5)
    assert len(bench.moves_since(0.0)) == sent


def test_what_is_not_asked_for_again_ends_within_two_seconds():
    bench = Bench().connect()
    bench.do(Drive(1, 0, "you"))
    bench.step(0.3)
    assert bench.state.activity is Activity.FOLLOWING
    bench.step(2.5)
    assert bench.state.activity is Activity.IDLE


def test_it_stops_at_the_limit_of_elevation_and_sends_nothing_beyond():
    bench = Bench("g2?seed=1&el=60").connect()
    hold(bench, 0, 1, 3.0)
    bench.step(4)
    assert bench.state.position.el_deg <= bench.state.el_max_deg + 0.1
    for line in bench.moves_since(0.0):
        assert float(line.split()[2]) <= bench.state.el_max_deg + 1e-6


def test_it_turns_round_when_the_other_key_is_held():
    bench = Bench().connect()
    start = bench.state.position.az_deg
    hold(bench, 1, 0, 1.0)
    hold(bench, -1, 0, 4.0)
    bench.step(4)
    assert (bench.state.position.az_deg - start + 180.0) % 360.0 - 180.0 < 0.0


def test_stop_ends_it_and_it_does_not_begin_again_while_held():
    bench = Bench().connect()
    hold(bench, 1, 0, 1.0)
    bench.station.stop("you")
    bench.step(3)
    sent = len(bench.moves_since(0.0))
    with pytest.raises(Held):
        bench.do(Drive(1, 0, "you"))
    bench.step(3)
    assert len(bench.moves_since(0.0)) == sent
    assert not bench.state.tasks


def test_whoever_has_no_control_drives_nothing():
    bench = Bench().connect()
    bench.do(AcquireLease("tracker"))
    with pytest.raises(LeaseDenied):
        bench.do(Drive(1, 0, "you"))
    with pytest.raises(MotionRefused, match="-1, 0 or 1"):
        bench.do(Drive(0, 0, "tracker"))
    assert not bench.moves_since(0.0)


def test_a_drive_replaces_a_go_to_and_nothing_takes_the_dish_for_stalled():
    bench = Bench().connect()
    future = bench.station.submit(Goto(90.0, 40.0, "you"))
    bench.step(0.5)
    hold(bench, 0, 1, 2.0)
    with pytest.raises(Superseded, match="A drive replaced the motion"):
        future.result(0)
    bench.step(8)
    assert (bench.state.fault, bench.state.held, bench.state.activity) == (None, None, Activity.IDLE)
