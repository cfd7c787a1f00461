"""STOP: overtakes, latches, says what it did."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.base.errors import Held, Stopped
from birdcage.station.requests import Goto, Home, Release
from birdcage.station.state import Activity

from .conftest import Bench


def in_mid_slew(bench, seconds=1.0):
    bench.do(Goto(60, 45, "you"))
    future = bench.station.submit(Goto(210, 45, "you"))
    bench.step(seconds)
    assert bench.device.truth().moving
    return future


def test_the_bytes_are_out_when_stop_returns(bench):
    in_mid_slew(bench)
    sent = []
    original = bench.sim.write
    bench.sim.write = lambda data: (sent.append(data), original(data))
    bench.station.stop("you")
    assert sent
    assert sent[0].startswith(b"a 0 ")


def test_the_dish_comes_to_rest_ahead_of_where_it_was_and_stays(bench):
    future = in_mid_slew(bench)
    before = bench.device.truth().az_deg
    bench.station.stop("you")
    bench.step(5)
    after = bench.device.truth()
    assert not after.moving
    assert before < after.az_deg < before + 20
    assert bench.state.held.by == "you"
    assert bench.state.last_stop.confirmed is True
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.activity is Activity.IDLE
    with pytest.raises(Stopped):
        future.result(0)
    bench.step(60)
    assert bench.device.truth().az_deg == pytest.approx(after.az_deg, abs=0.01)


def test_a_client_that_asks_every_second_moves_nothing_while_held(bench):
    in_mid_slew(bench)
    bench.station.stop("you")
    bench.step(0.5)
    since = bench.clock.monotonic()
    for second in range(60):
        future = bench.station.submit(Goto(100 + second, 40, "Gpredict"))
        bench.step(1)
        assert isinstance(future.exception(0), Held)
    assert bench.moves_since(since) == []
    assert bench.state.held.ignored == 60
    assert (bench.state.held.next_holder, bench.state.held.next_az_deg) == ("Gpredict", 159)


def test_still_held_after_unplug_and_replug(bench):
    in_mid_slew(bench)
    bench.station.stop("you")
    bench.step(0.5)
    bench.device.unplug()
    bench.step(5)
    bench.device.plug()
    bench.step(10)
    since = bench.clock.monotonic()
    for _second in range(60):
        bench.station.submit(Goto(100, 40, "Gpredict"))
        bench.step(1)
    assert bench.moves_since(since) == []
    assert bench.state.held is not None


def test_a_goto_that_waits_its_turn_is_not_sent_after_stop(bench):
    in_mid_slew(bench)
    late = bench.station.submit(Goto(200, 30, "you"))
    bench.station.stop("you")
    since = bench.clock.monotonic()
    bench.step(60)
    assert isinstance(late.exception(0), Held)
    assert [line for line in bench.moves_since(since) if "200" in line or "30.00" in line] == []


def test_release_lets_a_person_move_again(bench):
    in_mid_slew(bench)
    bench.station.stop("you")
    bench.step(2)
    bench.do(Release("you"))
    assert bench.state.held is None
    bench.step(5)
    assert not bench.device.truth().moving
    bench.do(Goto(200, 30, "you"))


def test_stop_at_rest_latches_and_looks(bench):
    bench.do(Goto(180, 45, "you"))
    bench.station.stop("you")
    bench.step(5)
    assert bench.state.held is not None
    assert bench.state.last_stop.means == "nothing moved"
    assert bench.state.last_stop.confirmed is True


def test_stop_in_a_homing_says_that_nothing_stops_it():
    bench = Bench("g2?seed=1&unhomed=1").connect()
    bench.station.submit(Home("you"))
    bench.session.station.settings  # noqa: B018 - the session is stepped by hand below
    calls = []

    def press(event):
        if type(event).__name__ == "ActivityChanged" and event.activity is Activity.HOMING and not calls:
            calls.append(event)
            bench.station.stop("you")

    bench.station.subscribe(press)
    bench.step(40)
    assert bench.state.last_stop.means == "none"
    assert bench.state.held is not None


@pytest.mark.parametrize("second_move", ["queue", "refuse"])
def test_a_dish_that_takes_no_new_target_is_reported_not_claimed_stopped(second_move):
    bench = Bench(f"g2?seed=1&second_move={second_move}&az_speed=20").connect()
    in_mid_slew(bench, 0.5)
    bench.station.stop("you")
    bench.step(20)
    assert bench.state.last_stop.confirmed is False
    assert bench.state.held is not None


def test_a_lost_answer_is_repeated_at_most_five_times(bench):
    in_mid_slew(bench)
    bench.device.wire.to_host.silent = True
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(20)
    assert bench.state.last_stop.confirmed is False
    assert 1 < sum(line.startswith("a 0") for line in bench.moves_since(since)) <= 5


def test_stop_without_a_link_latches_and_says_so(bench):
    bench.device.unplug()
    bench.step(3)
    bench.station.stop("you")
    bench.step(1)
    assert bench.state.held is not None
    assert bench.state.last_stop.means == "no link"
    assert bench.state.last_stop.confirmed is False


def test_stop_when_the_cable_makes_the_dish_turn_the_other_way(bench):
    """From cable angle 0 the way to 170 is counterclockwise, which is unknown until the dish is seen turning."""
    bench.station.submit(Goto(170, 45, "you"))
    bench.step(1.0)
    before = bench.device.truth()
    assert before.moving
    assert before.cable_deg < 0
    bench.station.stop("you")
    bench.step(2)
    after = bench.device.truth()
    assert not after.moving
    assert before.cable_deg - 20 < after.cable_deg < before.cable_deg
    assert bench.state.last_stop.confirmed is True


def test_a_slow_dish_that_takes_its_time_to_the_aim_is_stopped_all_the_same():
    bench = Bench("g2?seed=1&az_speed=5&az=-180").connect()
    bench.station.submit(Goto(250, 45, "you"))
    bench.step(0.15)
    bench.station.stop("you")
    bench.step(10)
    assert bench.state.last_stop.confirmed is True
    assert bench.state.last_stop.means == "retarget"


def test_a_dish_that_is_slow_to_take_stop_is_not_turned_back():
    """The move was taken in 5 ms, and STOP is taken 80 ms after it left."""
    bench = Bench("g2?seed=1&latency_min=0.005&latency_max=0.005").connect()
    in_mid_slew(bench)
    shell = bench.device.shell
    shell._settings = replace(shell._settings, latency_min=0.08, latency_max=0.08)
    bench.station.stop("you")
    seen = []
    for _ in range(100):
        bench.clock.advance(0.02)
        seen.append(bench.device.truth().az_deg)
    assert not bench.device.truth().moving
    assert max(seen) - seen[-1] < 0.1
