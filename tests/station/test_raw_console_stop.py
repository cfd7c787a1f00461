"""STOP while somebody talks."""

from __future__ import annotations

import pytest
from birdcage.base.errors import (
    Held,
    Stopped,
)
from birdcage.station.raw import Grade
from birdcage.station.state import Activity
from birdcage.station.state import LinkPhase as LinkNow

from .raw_console_bench import TalkBench, lines_since


@pytest.fixture
def bench():
    return TalkBench()


def test_stop_of_a_raw_motion_leaves_at_once_and_ahead_of_the_dish(bench):
    before = bench.counted().in_raw_motion()
    sent = []
    original = bench.sim.write
    bench.sim.write = lambda data: (sent.append(data), original(data))
    bench.station.stop("you")
    assert sent
    assert sent[0].startswith(b"a 0 ")  # from the caller's own thread
    bench.step(2)
    assert bench.at_rest()
    assert before - 40 < bench.device.truth().az_deg < before
    assert bench.state.holder is None
    assert bench.state.held is not None
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True
    bench.step(20)
    assert bench.at_rest()


def test_stop_leaves_at_once_while_the_raw_motion_waits_for_its_prompt(bench):
    bench.counted()
    future = bench.begin("a 0 100", confirmed=Grade.RUINS)
    bench.step(0.001)
    assert not future.done()
    bench.station.stop("you")
    bench.step(2)
    assert bench.at_rest()
    assert 270 < bench.device.truth().az_deg <= 300
    assert future.result(0)
    assert bench.state.last_stop.confirmed is True
    assert bench.state.link.state is LinkNow.UP


@pytest.mark.parametrize("line", ["a 0 170", "a 0 -170"])
def test_stop_of_a_raw_motion_that_is_not_foreseen_looks_and_aims(bench, line):
    # The turn of the cable is not known: `a 0 170` from 0 goes counterclockwise, as the cable has no more room.
    bench.type(line, confirmed=Grade.RUINS)
    bench.step(0.5)
    before = bench.device.truth().az_deg
    bench.station.stop("you")
    bench.step(6)
    assert bench.at_rest()
    assert before - 40 < bench.device.truth().az_deg < before
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True


@pytest.mark.parametrize("counted", [True, False])
def test_stop_from_another_menu_goes_to_the_motor_menu_first(counted):
    bench = TalkBench("g2?seed=1&az_speed=5&root_q=kill")
    if counted:
        bench.counted()
    before = bench.in_raw_motion()
    bench.type("q")
    bench.type("dvb")
    bench.station.stop("you")
    assert bench.state.held is None  # the station has not run yet
    bench.step(0.5)
    assert bench.state.last_stop.by == "you"
    bench.step(6)
    assert bench.state.menu == "mot"
    assert bench.at_rest()
    assert before - 30 < bench.device.truth().az_deg < before
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True
    assert bench.device.truth().shell_alive


@pytest.mark.parametrize("menu", ["dvb", "nvs", "os", "step"])
def test_no_stop_line_is_typed_into_another_menu(menu):
    bench = TalkBench("g2?seed=1&az_speed=5").counted()
    bench.in_raw_motion()
    bench.type("q")
    bench.type(menu)
    wrong = []
    original = bench.sim.write
    bench.sim.write = lambda data: (
        wrong.append((bench.device.shell.menu, data)) if data.startswith(b"a ") else None,
        original(data),
    )
    bench.station.stop("you")
    bench.step(4)
    assert {where for where, _ in wrong} == {"mot"}
    assert bench.at_rest()


def test_stop_in_the_middle_of_a_stream_ends_it_first():
    bench = TalkBench("g2?seed=1&az_speed=2&root_q=kill")
    before = bench.in_raw_motion()
    bench.type("q")
    bench.type("dvb")
    stream = bench.begin("agc")
    bench.step(2)
    bench.station.stop("you")
    bench.step(12)
    assert stream.result(0).ended_by_key
    assert bench.state.menu == "mot"
    assert bench.at_rest()
    assert before - 40 < bench.device.truth().az_deg < before
    assert bench.state.last_stop.confirmed is True
    assert bench.device.truth().shell_alive


def test_stop_with_nothing_moving_ends_the_talk(bench):
    bench.type("q")
    bench.type("dvb")
    bench.station.stop("you")
    bench.step(3)
    assert bench.state.holder is None
    assert bench.state.held is not None
    assert bench.state.last_stop.confirmed is True
    assert "Stands still" in bench.state.last_stop.sentence
    assert bench.state.activity is Activity.IDLE


def test_stop_holds_back_a_motion_that_was_typed_before_it(bench):
    bench.type("a")
    since = bench.clock.monotonic()
    future = bench.begin("a 0 200", confirmed=Grade.RUINS)
    bench.station.stop("you")
    bench.step(5)
    assert isinstance(future.exception(0), (Held, Stopped))
    assert "a 0 200" not in lines_since(bench, since)
    assert bench.at_rest()


def test_stop_during_raw_homing_says_that_nothing_stops_it(bench):
    homing = bench.begin("h 0", confirmed=Grade.RUINS)
    bench.step(0.5)
    bench.station.stop("you")
    bench.step(0.5)
    assert bench.state.last_stop.means == "none"
    assert "cannot be stopped" in bench.state.last_stop.sentence
    bench.step(20)
    assert homing.done()
    assert bench.at_rest()
    assert bench.state.held is not None
    assert bench.state.link.state is LinkNow.UP


def test_two_raw_axes_are_both_stopped(bench):
    bench.counted()
    bench.type("a 0 100", confirmed=Grade.RUINS)
    bench.type("a 1 20", confirmed=Grade.RUINS)
    bench.step(0.1)
    bench.station.stop("you")
    bench.step(3)
    assert bench.at_rest()
    assert bench.device.truth().az_deg > 250
    assert bench.device.truth().el_deg > 25
    assert bench.state.last_stop.confirmed is True


def test_a_raw_motion_that_the_dish_refused_is_not_retargeted(bench):
    bench.counted()
    bench.device.board.nvram.active[102] = 50.0  # a limit we were not told of
    assert bench.station.judge("a 1 60").limit == ""
    assert bench.type("a 1 60", confirmed=Grade.RUINS).lines == ("Angle out of range.",)
    since = bench.clock.monotonic()
    bench.station.stop("you")
    bench.step(2)
    assert bench.moves_since(since) == []
    assert bench.state.last_stop.means == "look"


def test_stop_leaves_at_once_again_when_the_console_is_back_in_the_motor_menu():
    bench = TalkBench("g2?seed=1&az_speed=5").counted()
    bench.in_raw_motion()
    bench.type("q")
    bench.type("mot")
    sent = []
    original = bench.sim.write
    bench.sim.write = lambda data: (sent.append(data), original(data))
    bench.station.stop("you")
    assert sent
    assert sent[0].startswith(b"a 0 ")


def test_stop_between_the_warning_and_the_bytes_keeps_the_motion_back():
    bench = TalkBench()

    def stop(text):
        bench.remarks.append(text)
        if text.startswith("raw by"):
            bench.station.stop("you")

    bench.station._raw_console._effects._remark = stop
    with pytest.raises(Stopped):
        bench.type("a 1 60", confirmed=Grade.RUINS)
    bench.step(2)
    assert "a 1 60" not in bench.lines()
    assert bench.remarks[-1].startswith("not sent: ")
    assert bench.at_rest()
    assert bench.state.position_lost is None
