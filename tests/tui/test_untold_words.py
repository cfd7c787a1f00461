"""What the screen says of a dish that does not tell where it rests: nothing of it read at rest, nothing confirmed."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.station.events import MoveEnded
from birdcage.station.requests import Goto, Release
from birdcage.station.state import Activity
from birdcage_tui.control.last import _hint
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.panes.next_steps import next_steps
from birdcage_tui.shown.held_words import held_words
from birdcage_tui.shown.state_words import ended_text, motion_text
from birdcage_tui.shown.stop_words import stop_text
from birdcage_tui.shown.view import View

from tests.station.conftest import Bench

WITHIN = re.compile(r"ends within (\d+) s")


def met(options=""):
    return Bench(f"carryout?seed=1&second_move=queue{options}", firmware="carryout").connect(8.0)


def view_of(bench):
    return View(bench.state, bench.clock.monotonic(), bench.clock.utc(), AppOptions(), watched=True)


def said(bench):
    view = view_of(bench)
    held = [] if view.state.held is None else [held_words(view)]
    return " ".join([motion_text(view), stop_text(view), *(words for _ink, words in next_steps(view)), *held])


def gone_to(bench, az_deg, el_deg):
    bench.do(Goto(az_deg, el_deg, "you"), 200)


def test_before_its_first_way_nothing_is_said_of_rest_nor_of_steps():
    bench = met()
    words = f"{said(bench)} {_hint(view_of(bench))}"
    assert "It does not tell if it moves." in words
    assert "t rest" not in words
    assert "step 1°" not in words


def test_at_rest_it_only_should_be():
    bench = met()
    gone_to(bench, 205, 38)
    assert "IDLE, should be at rest" in said(bench)
    assert "It should be at rest. You have control." in said(bench)
    ended = next(ended_text(event) for event in reversed(bench.events) if isinstance(event, MoveEnded))
    assert ended == "It should have arrived at 205.00°/38.00°. At rest the dish does not tell."


@pytest.mark.parametrize("options", ["", "&speed=5&accel=5", "&speed=5&accel=5&g_axes=turn", "&record=moving"])
def test_a_move_ends_within_the_time_that_is_named_whenever_one_looks(options):
    bench = met(options)
    gone_to(bench, 205, 38)
    future, named = bench.station.submit(Goto(100, 60, "you")), []
    bench.step(0.3)
    while bench.device.truth().moving:
        found = WITHIN.search(stop_text(view_of(bench)))
        assert found, stop_text(view_of(bench))
        named.append(bench.clock.monotonic() + int(found[1]))
        bench.step(0.5)
    rested = bench.clock.monotonic()
    assert len(named) > 5
    assert min(named) > rested - 0.6
    bench.step(60)
    assert future.done()
    assert "overdue" not in said(bench)


def test_stop_is_never_said_to_have_ended_anything():
    bench = met()
    gone_to(bench, 205, 38)
    future = bench.station.submit(Goto(40, 60, "you"))
    bench.step(2)
    bench.station.stop("you")
    bench.step(1)
    assert str(future.exception(0)) == "STOP by you: the motion was given up."
    assert bench.device.truth().moving
    words = held_words(view_of(bench))
    assert "STOP can't be confirmed: it may still move" in words
    assert "Enter release: it may still be moving" in words
    assert not view_of(bench).late
    bench.step(5)
    assert not view_of(bench).late, "nothing is asked of it now"
    bench.step(60)
    assert bench.state.activity is Activity.IDLE
    words = held_words(view_of(bench))
    assert "STOP can't be confirmed; over by its time" in words
    assert "Enter release: birdcage sends no motion then" in words


def test_stop_at_rest_proves_nothing_either():
    bench = met()
    gone_to(bench, 205, 38)
    bench.station.stop("you")
    bench.step(20)
    assert "checks" not in said(bench)
    assert "nothing moves" not in said(bench)
    bench.do(Release("you"))
    assert "should be at rest" in said(bench)


@pytest.mark.parametrize(
    ("az_deg", "late_s", "words"),
    [
        (160.72, 0.4, "SLEWING: settling"),
        (160.72, -0.2, "SLEWING 0.0° to go, 0.2 s"),
        (162.7, 3.0, "SLEWING 2.0° to go, overdue 3.0 s"),
    ],
)
def test_a_dish_at_its_target_whose_time_is_over_is_settling(az_deg, late_s, words):
    clock = VirtualClock()
    state = stand_in.slewing(clock)
    position = replace(state.position, az_deg=az_deg, el_deg=state.motion.to_el_deg)
    motion = replace(state.motion, eta=clock.monotonic() - late_s)
    view = View(replace(state, position=position, motion=motion), clock.monotonic(), clock.utc(), AppOptions())
    assert motion_text(view) == words
