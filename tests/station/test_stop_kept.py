"""STOP in the moment before the first byte of a move: it never goes out, and STOP sends nothing that would move it."""

from __future__ import annotations

import pytest
from birdcage.station.events import StopSent
from birdcage.station.raw import CONSOLE
from birdcage.station.requests import Goto, Jog, ReleaseLease

from .conftest import Bench
from .queued_bench import connected
from .raw_console_bench import TalkBench


def stopped_at(before_first_byte: bool):
    bench = connected()
    bench.step(20.0)
    position = bench.state.position
    assert position is not None
    begun, permit = bench.station._antenna, bench.station._antenna.permit
    pressed: list[float] = []

    def press() -> None:
        if not pressed and begun.motion is not None:
            pressed.append(bench.clock.monotonic())
            if before_first_byte:
                bench.station.stop("you")
            permit()
            if not before_first_byte:
                bench.station.stop("you")

    begun.permit = press
    since = bench.clock.monotonic()
    bench.station.submit(Goto(position.az_deg + 3.0, position.el_deg, "you"))
    bench.step(6.0)
    assert pressed
    said = [event.report for event in bench.events if isinstance(event, StopSent)]
    return bench, bench.sent_moves(since), said[0]


def test_a_move_that_stop_has_kept_is_not_said_to_end_by_itself():
    bench, moves, said = stopped_at(before_first_byte=True)
    assert moves == []
    assert said.means == "nothing moved"
    assert "dropped" in said.sentence
    assert bench.state.last_stop.confirmed is True


def test_a_move_that_was_let_out_is():
    _bench, moves, said = stopped_at(before_first_byte=False)
    assert len(moves) == 1
    assert "it ends in" in said.sentence


def while_it_reads_the_signal(bench):
    bench.watch("rssi", "position")
    while bench.lines()[-1:] != ["rssi 10"]:
        bench.step(0.05)


@pytest.mark.parametrize("menus_walked", [0, 1, 2])
def test_a_dish_at_rest_is_not_moved_by_stop_before_the_first_byte(menus_walked):
    """A jog that comes while its signal is read walks back to the motor menu first: STOP may come on that way."""
    bench = Bench().connect()
    while_it_reads_the_signal(bench)
    bench.step(0.3)
    before = bench.device.truth()
    write, walked = bench.sim.write, []

    def stopping(data):
        write(data)
        if bench.station._antenna.motion is not None and not bench.station.state.held:
            if len(walked) == menus_walked:
                bench.station.stop("you")
            walked.append(data)

    bench.sim.write = stopping
    since = bench.clock.monotonic()
    future = bench.station.submit(Jog(-1.0, 0.0, "you"))
    bench.step(6.0)
    assert future.exception() is not None
    after = bench.device.truth()
    assert len(walked) > menus_walked, "the jog came to its line before"
    assert bench.moves_since(since) == []
    assert (after.az_deg, after.el_deg, after.moving) == (before.az_deg, before.el_deg, False)
    said = next(event.report for event in bench.events if isinstance(event, StopSent))
    assert said.means == "nothing moved"
    assert bench.state.last_stop.confirmed is True


def stopped_before_its_line(bench, request):
    """Have STOP come when the line of a request is about to go out; return what STOP said."""
    begun, permit = bench.station._antenna, bench.station._antenna.permit
    before = len(bench.events)

    def press() -> None:
        begun.permit = permit
        bench.station.stop("you")
        permit()

    begun.permit = press
    bench.station.submit(request)
    bench.step(8.0)
    return next(event.report for event in bench.events[before:] if isinstance(event, StopSent))


def test_what_moves_already_is_stopped_though_its_new_target_is_kept():
    bench = Bench().connect()
    bench.station.submit(Goto(140.0, 45.0, "you"))
    bench.step(1.0)
    here = bench.device.truth()
    assert here.moving
    said = stopped_before_its_line(bench, Goto(150.0, 45.0, "you"))
    assert said.means == "retarget"
    assert abs(bench.device.truth().az_deg - here.az_deg) < 20.0
    assert bench.state.last_stop.confirmed is True


def test_what_a_raw_line_has_set_in_motion_is_looked_for_though_a_move_is_kept():
    bench = TalkBench()
    bench.in_raw_motion("a 0 100", seconds=0.1)
    bench.do(ReleaseLease(CONSOLE))
    said = stopped_before_its_line(bench, Goto(150.0, 45.0, "you"))
    assert said.means == "look"
    assert bench.state.last_stop.confirmed is True
    assert bench.device.truth().az_deg > 100.5, "it went to the end"
