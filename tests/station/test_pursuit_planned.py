"""Real plans of real orbits, carried out by the simulated dish."""

from __future__ import annotations

import sys

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import FeedProfile, Settings
from birdcage.base.geometry import separation
from birdcage.rotator.facts import CableTurn
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto, Home
from birdcage.tracking.plan import PlanPart
from birdcage.tracking.planning.planner import plan_pass

from tests.tracking.orbits import NOW, PLACE, overhead

from .conftest import Bench
from .pursuit_bench import PARK, PursuitBench, at, g2, travler


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
    assert bench.state.turn is CableTurn.COUNTED
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
    assert PlanPart.FOLLOW in {leg.part for leg in plan.legs}


def test_the_forecast_holds_for_a_dish_that_overshoots_as_the_g2_does():
    bench = g2(feed=FeedProfile(beam_deg=2.5))
    plan = planned(bench, -12.0)
    bench.pursue(plan, at_end="stay")
    bench.until(Phase.FOLLOWING, 3000).step(100.0)
    assert bench.pursuit.rms_error_deg == pytest.approx(plan.forecast.rms_deg, rel=0.4)
    assert 0.4 * plan.forecast.max_deg < bench.pursuit.max_error_deg < 1.1 * plan.forecast.max_deg


def slow(bench):
    """Both axes go slower than they say."""
    for axis in bench.device.dish.axes[:2]:
        axis.data.max_rate_deg_s *= 0.93
        axis.data.accel_deg_s2 *= 0.7


@pytest.mark.parametrize(("aside_deg", "wire", "wear"), [
    (-7.0, "", None), (-4.0, "&latency_min=0.1&latency_max=0.3", None), (-4.0, "&latency_max=0.2", slow),
], ids=["as a G2 is", "slow wire", "slow axes"])  # fmt: skip
def test_the_dish_is_on_a_target_that_fits_no_turn_whenever_no_rewind_is_announced(aside_deg, wire, wear):
    """Azimuth 250 to 400 on a cable from -423 to 23: it crosses the sky fastest where the cable ends."""
    bench = PursuitBench(f"g2?seed=1{wire}").connect()
    bench.do(Home("you"), 60)
    bench.do(Goto(20, 40, "you"), 20)
    plan = planned(bench, aside_deg, inclination_deg=51.6)
    (rewind,) = plan.rewinds
    bench.step(rewind.start_s - 25.0 - at(bench))
    bench.pursue(plan, at_end="stay")
    bench.step(15.0)
    if wear is not None:
        wear(bench)
    off_deg, phases = [], set()
    while at(bench) < rewind.end_s + 10.0:
        bench.step(0.05)
        phases.add(bench.pursuit.phase)
        if not rewind.start_s <= at(bench) <= rewind.end_s:
            truth = bench.device.truth()
            off_deg.append(separation(*plan.sky.at(at(bench)), truth.az_deg, truth.el_deg))
    assert Phase.REWINDING in phases
    assert max(off_deg) < 0.3
