"""STOP of a queued move in the moment before its first byte: it never goes out, and nothing is said of its end."""

from __future__ import annotations

from birdcage.station.events import StopSent
from birdcage.station.requests import Goto

from .queued_bench import connected


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
