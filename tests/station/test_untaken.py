"""Answers to a move that tell nothing: no refusal is known of a G2, so the position decides."""

from __future__ import annotations

import pytest
from birdcage.base.errors import NotTaken
from birdcage.station.events import End, MoveEnded
from birdcage.station.requests import Goto
from birdcage.station.state import Activity

from .conftest import Bench
from .test_waiting_dish import stands_at


def connected(options):
    bench = Bench(f"g2?seed=1&az=-180{options}").connect()
    bench.watch("position")
    bench.step(2.0)
    return bench


def refuse(bench, motors, text):
    """Have the dish print a text at a move of these motors, and stay where it is."""
    menu = bench.device.shell._menus["mot"]
    ran = menu.run

    def run(words):
        if len(words) == 3 and words[0] == "a" and int(words[1]) in motors:
            yield text
        else:
            yield from ran(words)

    menu.run = run


def ends(bench):
    return [event.end for event in bench.events if isinstance(event, MoveEnded)]


@pytest.mark.parametrize("style", ["none", "np"])
def test_a_dish_that_moves_has_taken_the_move_whatever_it_said(style):
    bench = connected(f"&move_reply={style}")
    bench.do(Goto(0, 30, "you"))
    assert stands_at(bench, 0, 30)
    assert ends(bench) == [End.ARRIVED]


@pytest.mark.parametrize("text", ["", "Invalid parameter.\n", "Angle out of range.\n", "ok\n"])
def test_a_dish_that_stands_still_has_not_taken_it_and_that_is_no_fault(text):
    bench = connected("")
    refuse(bench, (0, 1), text)
    begun = bench.clock.monotonic()
    with pytest.raises(NotTaken) as untaken:
        bench.do(Goto(0, 30, "you"))
    assert untaken.value.reason == "not_taken"
    assert text.strip() in str(untaken.value)
    assert bench.clock.monotonic() - begun < 1.0
    assert ends(bench) == [End.NOT_TAKEN]
    assert bench.state.fault is None
    assert bench.state.held is None
    assert bench.state.activity is Activity.IDLE
    assert bench.state.motion is None


def test_one_axis_that_does_not_take_its_move_is_told_when_the_other_has_arrived():
    bench = connected("")
    refuse(bench, (1,), "")
    with pytest.raises(NotTaken):
        bench.do(Goto(0, 30, "you"))
    assert stands_at(bench, 0, 45)
    assert bench.state.fault is None


def test_a_target_that_is_not_taken_in_mid_slew_ends_where_the_slew_does_without_a_fault():
    bench = connected("&second_move=refuse&az_speed=20")
    bench.station.submit(Goto(60, 45, "you"))
    bench.step(1.0)
    with pytest.raises(NotTaken, match="busy"):
        bench.do(Goto(200, 45, "you"))
    assert stands_at(bench, 60, 45)
    assert ends(bench) == [End.SUPERSEDED, End.NOT_TAKEN]
    assert bench.state.fault is None


def test_what_is_blocked_after_it_has_taken_a_move_is_a_stall_all_the_same():
    bench = connected("&move_reply=none&az_speed=20")
    future = bench.station.submit(Goto(0, 45, "you"))
    bench.step(2.0)
    bench.device.stall(0)
    bench.step(15.0)
    assert future.done()
    assert bench.state.fault.reason == "stall"


@pytest.mark.parametrize("printed", ["46.4", "46", "46.370", "-313.63"])
def test_an_angle_counts_as_told_with_the_decimals_and_on_the_turn_that_it_is_printed_with(printed):
    bench = connected("")
    menu = bench.device.shell._menus["mot"]
    ran = menu.run

    def run(words):
        for part in ran(words):
            yield part.replace("46.37", printed) if isinstance(part, str) and len(words) == 3 else part

    menu.run = run
    bench.do(Goto(46.37, 30, "you"))
    assert ends(bench) == [End.ARRIVED]
    assert bench.station._antenna.commands.are_sure


def test_stop_behind_an_answer_that_tells_nothing_is_aimed_on_sight():
    bench = connected("&move_reply=none&az_speed=20")
    bench.station.submit(Goto(0, 30, "you"))
    bench.step(0.08)
    before = len(bench.written)
    bench.station.stop("you")
    assert bench.written[before:] == b"\r"
    bench.step(5.0)
    assert bench.state.last_stop.means == "retarget"
    assert bench.state.last_stop.confirmed is True
    assert not stands_at(bench, 0, 30)
