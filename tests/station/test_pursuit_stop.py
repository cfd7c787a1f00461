"""STOP in every phase of a pursuit: it stops, holds, and ends it."""

from __future__ import annotations

import pytest
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import EndPursuit, Goto, Jog, Release

from .pursuit_bench import PARK, at, g2, plan_of, travler

ON_THE_WAY = [
    Phase.WAITING, Phase.COUNTDOWN, Phase.PREPOSITIONING, Phase.READY, Phase.FOLLOWING, Phase.REWINDING, Phase.PARKING,
]  # fmt: skip


def begun(bench, **options):
    start = at(bench) + 30.0
    plan = plan_of(start, lasts_s=60.0, rewind_s=8.0, az_rate=1.0, leave_s=start - 20.0)
    bench.pursue(plan, asked=False, **PARK | options)
    return bench


def stopped(bench, seconds=60.0):
    bench.station.stop("you")
    since = bench.clock.monotonic()
    bench.step(12.0)
    rest = bench.device.truth()
    assert not rest.moving
    lines = bench.moves_since(since)
    bench.step(seconds)
    after = bench.device.truth()
    assert (after.az_deg, after.el_deg) == pytest.approx((rest.az_deg, rest.el_deg), abs=0.01)
    assert bench.moves_since(since) == lines, "nothing is sent once it rests"
    assert bench.state.held.reason == "stop"
    assert bench.state.holder is None
    assert bench.pursuit.phase is Phase.OVER
    assert "STOP" in bench.pursuit.why
    return lines


@pytest.mark.parametrize("phase", ON_THE_WAY)
def test_stop_in_every_phase(phase):
    bench = begun(g2()).until(phase)
    bench.step(0.3)
    stopped(bench)
    assert bench.state.last_stop.confirmed is True
    bench.do(Release("you"))
    since = bench.clock.monotonic()
    bench.step(20)
    assert bench.moves_since(since) == [], "a release moves nothing"


@pytest.mark.parametrize("phase", [Phase.PREPOSITIONING, Phase.FOLLOWING, Phase.PARKING])
def test_stop_on_a_dish_whose_moves_queue(phase):
    bench = begun(travler()).until(phase)
    bench.step(0.5)
    stopped(bench)


def test_stop_in_the_second_half_of_a_fast_pass_aims_ahead_and_near():
    bench = g2()
    start = at(bench) + 10.0
    bench.pursue(plan_of(start, lasts_s=40.0, az_rate=5.0, leave_s=start - 9.0))
    bench.until(Phase.FOLLOWING).step(15.3)
    before = bench.device.truth()
    assert before.moving
    stopped(bench)
    assert 0.0 <= bench.device.truth().az_deg - before.az_deg < 2.0


def test_stop_while_somebody_else_has_control():
    from birdcage.station.requests import AcquireLease

    bench = begun(g2()).until(Phase.FOLLOWING)
    bench.do(AcquireLease("Gpredict", take_over=True))
    bench.until(Phase.YIELDED)
    stopped(bench)


def test_ending_it_brings_the_dish_to_rest_and_holds_nothing():
    bench = begun(g2()).until(Phase.PREPOSITIONING)
    bench.step(0.2)
    assert bench.device.truth().moving
    before = bench.device.truth().az_deg
    bench.do(EndPursuit("you"))
    bench.step(3)
    assert not bench.device.truth().moving
    assert abs(bench.device.truth().az_deg - before) < 25.0
    assert (bench.pursuit.phase, bench.pursuit.why) == (Phase.OVER, "Ended by you.")
    assert bench.state.held is None
    assert bench.state.activity.value == "idle"
    assert bench.state.holder is None
    bench.do(Goto(180, 40, "you"))


def test_a_hand_on_the_dish_ends_the_pursuit_of_the_same_holder():
    bench = begun(g2()).until(Phase.FOLLOWING)
    bench.step(3)
    bench.do(Goto(180, 40, "you"))
    assert (bench.pursuit.phase, bench.pursuit.why) == (Phase.OVER, "You moved the dish by hand.")
    since = bench.clock.monotonic()
    bench.step(60)
    assert bench.moves_since(since) == []
    assert bench.state.holder == "you"


@pytest.mark.parametrize("phase", [Phase.PREPOSITIONING, Phase.FOLLOWING])
def test_ending_it_on_a_dish_whose_moves_queue(phase):
    bench = begun(travler()).until(phase)
    bench.step(0.6)
    bench.do(EndPursuit("you"))
    bench.step(8)
    assert not bench.device.truth().moving
    assert bench.state.held is None
    assert bench.state.activity.value == "idle"
    bench.do(Goto(180, 40, "you"), 60)


def test_a_jog_in_mid_pass_steps_from_where_the_stream_has_led():
    bench = begun(g2()).until(Phase.FOLLOWING)
    bench.step(20)
    before = bench.device.truth()
    bench.do(Jog(1.0, 0.0, "you"))
    after = bench.device.truth()
    assert after.az_deg - before.az_deg == pytest.approx(1.0, abs=0.6)
    assert bench.pursuit.why == "You moved the dish by hand."
