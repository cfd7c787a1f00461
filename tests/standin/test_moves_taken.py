"""Dishes that wait for a motor, that answer moves with nothing known, or that do not carry them out."""

from __future__ import annotations

import pytest
from birdcage.base.clock import WaitOutcome
from birdcage.base.errors import NotTaken
from birdcage.rotator.facts import SecondMove
from birdcage.station.events import End, LinkChanged, MoveEnded
from birdcage.station.requests import Goto
from birdcage.station.state import LinkPhase

from .bench import Bench

WAITS = {"second_same": "block", "second_other": "block"}


def press_after(bench, seconds):
    """Press STOP in the middle of whatever waits then; return the list that gets when, and what left at once."""
    wait, at, done = bench.clock.wait, bench.clock.monotonic() + seconds, []

    def waiting(endpoint, until, wake):
        if not done and until >= at:
            outcome = wait(endpoint, at, wake)
            if outcome is not WaitOutcome.TIMEOUT:
                return outcome
            done.append(bench.clock.monotonic())
            bench.station.stop("you")
        return wait(endpoint, until, wake)

    bench.clock.wait = waiting
    return done


def stands_at(bench, az_deg, el_deg):
    return not bench.dish.moves() and bench.dish.where() == (
        pytest.approx(az_deg, abs=0.1), pytest.approx(el_deg, abs=0.1),
    )  # fmt: skip


def was_silent(bench):
    return any(isinstance(event, LinkChanged) and event.link.state is LinkPhase.SILENT for event in bench.events)


@pytest.mark.parametrize("more", [
    {}, {"echo_while_busy": True}, {"latency_s": 0.2}, {"az_speed": 20.0}, {"overshoot_deg": 0.05}, {"colour": True},
    {"query_blocks": True}, {"move_answer": "empty"},
], ids=str)  # fmt: skip
def test_a_dish_that_waits_arrives_and_is_learnt(more):
    bench = Bench(**WAITS, **more).connect()
    bench.step(2.0)
    bench.do(Goto(20.0, 30.0, "you"))
    bench.step(1.0)
    assert stands_at(bench, 20.0, 30.0)
    assert bench.state.dish.second_other is SecondMove.BLOCK
    bench.do(Goto(200.0, 60.0, "you"))
    bench.step(1.0)
    assert stands_at(bench, 200.0, 60.0)
    assert not was_silent(bench)
    assert bench.state.held is None


@pytest.mark.parametrize("after_s", [0.5, 1.2, 2.0])
def test_stop_in_mid_move_does_not_lead_it_back(after_s):
    bench = Bench(**WAITS).connect()
    bench.step(2.0)
    pressed = press_after(bench, after_s)
    bench.station.submit(Goto(20.0, 30.0, "you"))
    bench.step(15.0)
    assert pressed
    assert [(asked.axis, asked.deg) for asked in bench.dish.asked()] == [(0, 20.0), (1, 30.0)]
    assert stands_at(bench, 20.0, 30.0)
    assert bench.state.last_stop.confirmed is True


@pytest.mark.parametrize("answer", ["empty", "np", "OK", "Motor moving ..."])
def test_what_a_move_is_answered_with_does_not_matter_where_the_dish_moves(answer):
    bench = Bench(move_answer=answer).connect()
    bench.step(2.0)
    bench.do(Goto(20.0, 30.0, "you"))
    assert stands_at(bench, 20.0, 30.0)
    assert bench.state.fault is None


@pytest.mark.parametrize("answer", ["empty", "np", "OK", "Error"])
def test_where_it_does_not_the_move_was_not_taken_and_that_is_no_fault(answer):
    bench = Bench(move_answer=answer, takes_moves=False).connect()
    bench.step(2.0)
    assert isinstance(bench.do(Goto(20.0, 30.0, "you")), NotTaken)
    assert [event.end for event in bench.events if isinstance(event, MoveEnded)] == [End.NOT_TAKEN]
    assert bench.state.fault is None
    assert bench.state.held is None
    assert not was_silent(bench)
