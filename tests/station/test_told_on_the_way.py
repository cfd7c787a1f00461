"""A dish that tells where it is while its motors run: that is shown as read, and nothing of it outlives the motion."""

from __future__ import annotations

import pytest
from birdcage.base.geometry import separation
from birdcage.station.events import StopSent
from birdcage.station.requests import Goto, Release
from birdcage.station.state import Activity

from .conftest import Bench

FORMS = [
    "", "&prompt_when=at_once", "&record_end=cr", "&second_move=block", "&g_axes=turn",
    "&record={az}%20t%20t%20el%20t%20{el}cdeg",
]  # fmt: skip
AWAY_DEG = 8.0
"""How far it goes between two records, and a look of the station."""


def met(options=""):
    return Bench(f"carryout?seed=1{options}", firmware="carryout").connect(8.0)


def at_rest_somewhere(options=""):
    bench = met(options)
    bench.do(Goto(180, 45, "you"), 200)
    return bench


def follow(bench, future):
    """Step to the end of a motion; return what was shown on the way as read, and how far that was from the truth."""
    seen = []
    while not future.done():
        bench.step(0.1)
        here, truth = bench.state.position, bench.device.truth()
        if here is not None and not here.modelled and truth.moving:
            seen.append(separation(here.az_deg, here.el_deg, truth.az_deg, truth.el_deg))
    return seen


@pytest.mark.parametrize("form", FORMS)
def test_what_it_tells_on_its_way_is_shown_as_read(form):
    bench = at_rest_somewhere(form)
    future = bench.station.submit(Goto(40, 70, "you"))
    seen = follow(bench, future)
    assert len(seen) > 20
    assert max(seen) < AWAY_DEG
    here = bench.state.position
    assert here.modelled
    assert (here.az_deg, here.el_deg) == (40.0, 70.0)
    assert bench.state.homed is None


@pytest.mark.parametrize("form", FORMS)
def test_told_that_it_is_there_it_has_arrived_sooner_than_by_its_time(form):
    bench = at_rest_somewhere(form)
    began = bench.clock.monotonic()
    future = bench.station.submit(Goto(40, 70, "you"))
    bench.step(0.5)
    foreseen_s = bench.state.motion.eta - began
    follow(bench, future)
    assert bench.clock.monotonic() - began < foreseen_s / 2
    assert not bench.device.truth().moving
    bench.do(Goto(60, 60, "you"), 100)  # and the next one is not refused
    assert bench.device.truth().az_deg == pytest.approx(60.0, abs=0.1)


def test_on_its_first_way_it_is_where_it_says_and_at_its_end_where_it_was_sent():
    bench = met()
    seen = follow(bench, bench.station.submit(Goto(40, 70, "you")))
    assert len(seen) > 20
    assert max(seen) < AWAY_DEG
    assert bench.state.position.modelled


@pytest.mark.parametrize("form", ["&record=moving", "&record_s=1000&record_last=0"])
def test_without_records_it_arrives_by_its_time_and_nothing_is_shown_as_read(form):
    bench = at_rest_somewhere(form)
    began, future = bench.clock.monotonic(), bench.station.submit(Goto(40, 70, "you"))
    bench.step(0.5)
    foreseen_s = bench.state.motion.eta - began
    assert follow(bench, future) == []
    assert bench.clock.monotonic() - began >= foreseen_s
    assert (bench.state.position.az_deg, bench.state.position.modelled) == (40.0, True)


def test_after_stop_it_is_shown_as_long_as_it_tells_and_then_unknown():
    bench = at_rest_somewhere("&second_move=queue")
    bench.station.submit(Goto(10, 70, "you"))
    bench.step(2)
    bench.station.stop("you")
    bench.step(2)
    truth, here = bench.device.truth(), bench.state.position
    assert truth.moving
    assert not here.modelled
    assert separation(here.az_deg, here.el_deg, truth.az_deg, truth.el_deg) < AWAY_DEG
    assert bench.state.last_stop.confirmed is not True
    bench.step(12)
    assert not bench.device.truth().moving
    assert bench.state.position is None
    assert bench.state.last_stop.confirmed is not True
    bench.step(60)
    bench.do(Release("you"))
    assert bench.state.activity is Activity.IDLE


def test_last_told_far_from_its_target_it_has_not_arrived():
    bench = at_rest_somewhere()
    future = bench.station.submit(Goto(40, 70, "you"))
    bench.step(2)
    bench.device.stall(0)
    follow(bench, future)
    assert "last told that it was at" in str(future.exception(0))
    assert bench.state.fault.reason == "stall"
    assert bench.state.position is None


def test_told_of_somewhere_else_at_rest_it_moves_unasked():
    bench = at_rest_somewhere()
    bench.device.say("az = 18000   el = 4500\n")
    bench.step(1)
    assert bench.state.position.modelled
    for az in (16000, 15000, 14000):
        bench.device.say(f"az = {az}   el = 4000\n")
        bench.step(0.2)
    assert not bench.state.position.modelled
    assert bench.state.fault.reason == "moved"
    bench.station.stop("you")
    bench.step(1)
    sent = [event.report.sentence for event in bench.events if isinstance(event, StopSent)]
    assert "says that it moves" in sent[-1]
    assert bench.state.last_stop.confirmed is not True
    bench.step(5)
    assert bench.state.position is None


@pytest.mark.parametrize("form", FORMS)
def test_what_it_tells_on_its_way_is_no_noise(form):
    bench = at_rest_somewhere(form)
    before = bench.state.link.stray_bytes
    bench.station.submit(Goto(40, 70, "you"))
    bench.step(2)
    bench.station.stop("you")
    bench.step(60)
    assert bench.state.link.stray_bytes == before
    bench.device.say("mouse 17 in the dish\n")
    bench.step(3)
    assert bench.state.link.stray_bytes > before
