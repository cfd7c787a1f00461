"""A move from rest goes by the last look, where that is fresh; in all other cases the position is read first."""

from __future__ import annotations

import math

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.antenna.motion_state import MotionState
from birdcage.station.events import LeaseChanged, PositionRead
from birdcage.station.requests import AcquireLease, Goto, Jog, Raw, Release

from .conftest import Bench

READ = "a"
"""What asks a G2 where it is."""


@pytest.fixture
def bench():
    bench = Bench()
    bench.watch("position", rate_hz=1.0)
    return bench.connect(8.0)


def said(bench, request):
    """What the dish hears from now on, until it moves."""
    before = len(bench.lines())
    future = bench.station.submit(request)
    while not any(line.startswith("a ") for line in bench.lines()[before:]):
        assert not future.done(), future.exception(0)
        bench.step(0.01)
    return bench.lines()[before:]


def test_a_jog_at_rest_goes_out_as_the_first_line(bench):
    assert said(bench, Jog(1.0, 0.0, "you"))[0].startswith("a 0 ")


def test_it_goes_where_it_should_and_is_told_as_ever(bench):
    bench.do(Goto(120.0, 40.0, "you"))
    bench.step(2.0)
    bench.do(Jog(-5.0, 0.0, "you"))
    truth = bench.device.truth()
    assert (truth.az_deg, truth.el_deg) == (pytest.approx(115.0, abs=0.07), pytest.approx(40.0, abs=0.07))


@pytest.mark.parametrize("seconds", [0.06, 1.0])
def test_on_its_way_it_is_read_first(bench, seconds):
    """Also before the first look at the motion."""
    bench.station.submit(Goto(120.0, 45.0, "you"))
    bench.step(seconds)
    assert bench.state.motion is not None
    assert said(bench, Jog(1.0, 0.0, "you"))[0] == READ


def test_when_the_last_look_is_old_it_is_read_first():
    bench = Bench().connect(8.0)  # without a watcher the station does not look
    assert said(bench, Goto(20.0, 40.0, "you"))[0] == READ


def test_after_stop_it_is_read_first(bench):
    bench.station.submit(Goto(120.0, 40.0, "you"))
    bench.step(1.0)
    bench.station.stop("you")
    while bench.state.motion is not None or bench.state.last_stop.confirmed is None:
        bench.step(0.02)
    bench.do(Release("you"))
    assert said(bench, Jog(1.0, 0.0, "you"))[0] == READ


def test_after_a_raw_line_that_moves_it_is_read_first(bench):
    bench.do(AcquireLease("console"))
    bench.do(Raw("a 0 200", "console", confirmed=2))
    bench.do(AcquireLease("you", take_over=True))
    assert bench.device.truth().moving
    assert said(bench, Goto(30.0, 40.0, "you"))[0] == READ


def test_while_the_position_is_in_doubt_it_is_read_first(bench):
    bench.do(AcquireLease("console"))
    bench.do(Raw("a 0 200", "console", confirmed=2))
    assert said(bench, Goto(30.0, 40.0, "console"))[0] == READ


def test_after_another_alignment_it_is_read_first(bench):
    bench.station._antenna.align(Alignment(az_offset_deg=2.0))
    assert said(bench, Jog(1.0, 0.0, "you"))[0] == READ


def test_a_dish_at_rest_is_still_judged_by_its_limits(bench):
    before = len(bench.lines())
    with pytest.raises(ValueError, match="below the floor"):
        bench.do(Goto(20.0, 2.0, "you"))
    assert not any(line.startswith("a ") for line in bench.lines()[before:])


def test_a_listener_hears_what_it_asked_for_alone(bench):
    heard = []
    end = bench.station.subscribe(heard.append, LeaseChanged, PositionRead)
    bench.do(Goto(20.0, 40.0, "you"))
    assert {type(event) for event in heard} == {LeaseChanged, PositionRead}
    end()
    heard.clear()
    bench.step(3.0)
    assert heard == []


def test_a_motion_that_is_forgotten_takes_the_last_look_at_rest_with_it():
    moving = MotionState()
    moving.seen_at_rest = 1000.0
    moving.end()
    assert moving.seen_at_rest == 1000.0, "it rested already"
    moving.forget()
    assert moving.seen_at_rest == -math.inf
