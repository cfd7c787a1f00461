"""Real plans of real orbits, carried out by the simulated dish."""

from __future__ import annotations

import sys

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import FeedProfile, Settings
from birdcage.base.geometry import separation
from birdcage.protocol.model import Turn
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit import Phase
from birdcage.station.requests import Goto, Home
from birdcage.tracking.plan import Part
from birdcage.tracking.planning.planner import plan_pass

from tests.tracking.orbits import NOW, PLACE, overhead

from .conftest import Bench
from .pursuit_bench import PARK, g2, travler


@pytest.fixture(autouse=True)
def _at_noon(monkeypatch):
    monkeypatch.setattr(sys.modules[Bench.__module__], "VirtualClock", lambda: VirtualClock(NOW))


def planned(bench, aside_deg, **orbit):
    target, passing = overhead(aside_deg, **orbit)
    return plan_pass(target, PLACE, mount_of(bench.state, Settings()), bench.clock.utc(), passing=passing)


@pytest.mark.parametrize("aside_deg", [4.0, -12.0])
def test_a_pass_with_the_turn_of_the_cable_known(aside_deg):
    bench = g2(feed=FeedProfile(beam_deg=2.5))
    bench.do(Home("you"), 60)
    bench.do(Goto(20, 40, "you"))
    assert bench.state.turn is Turn.COUNTED
    plan = planned(bench, aside_deg)
    assert plan.legs[0].turn is not None
    bench.pursue(plan, **PARK)
    bench.until(Phase.OVER, 3000)
    assert bench.pursuit.why == "The pass is over."
    assert bench.state.fault is None
    assert bench.pursuit.rms_error_deg < 0.1 + 1.2 * plan.forecast.rms_deg
    assert bench.pursuit.sample.loss_db is not None
    low, high = bench.state.cable_min_deg, bench.state.cable_max_deg
    assert low <= bench.state.position.cable_deg <= high
    truth = bench.device.truth()
    assert separation(truth.az_deg, truth.el_deg, 180.0, 45.0) < 0.1


def test_a_dish_whose_moves_queue_follows_its_plan():
    bench = travler()
    plan = planned(bench, -12.0)
    bench.pursue(plan, **PARK)
    bench.until(Phase.OVER, 3000)
    assert bench.pursuit.why == "The pass is over."
    assert bench.state.fault is None
    assert bench.pursuit.rms_error_deg < 1.0
    assert Part.FOLLOW in {leg.part for leg in plan.legs}


def test_the_forecast_holds_for_a_dish_that_overshoots_as_the_g2_does():
    bench = g2(feed=FeedProfile(beam_deg=2.5))
    plan = planned(bench, -12.0)
    bench.pursue(plan, at_end="stay")
    bench.until(Phase.FOLLOWING, 3000).step(100.0)
    assert bench.pursuit.rms_error_deg == pytest.approx(plan.forecast.rms_deg, rel=0.4)
    assert 0.4 * plan.forecast.max_deg < bench.pursuit.max_error_deg < 1.1 * plan.forecast.max_deg
