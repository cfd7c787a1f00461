"""Passes over a dish that does not tell where it rests: never worse than foreseen, whatever it is like."""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta
from functools import cache

import pytest
from birdcage.base.config import Settings
from birdcage.base.geometry import separation
from birdcage.sky.frozen import frozen
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet
from birdcage.sky.targets.model import Satellite
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto, Release
from birdcage.tracking.plan import PlanPart
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.planning.rehearsal import rehearse
from birdcage.tracking.steering.choice import CONTROLLERS

from .pursuit_bench import PursuitBench, at

DAY = datetime(2018, 1, 21, 12, tzinfo=UTC)
HELSINKI = Observer(60.2, 24.9, 20.0, "Helsinki")
EARLY_S = 400.0
SETTLED_S = 5.0


@cache
def passes():
    low = [each for each in frozen() if each.mean_motion_rev_day > 11.0]
    fleet = Fleet([each for each in low if abs(each.epoch - DAY) < timedelta(days=10)])
    table = search(fleet, HELSINKI, DAY, 24.0)
    return [(fleet[int(table.fleet_index[index])], passing) for index, passing in enumerate(table)]


def in_place(passing, guess):
    """Return a dish that was sent somewhere in good time for a pass."""
    bench = PursuitBench(f"carryout?seed=1&latency_min=0.02&latency_max=0.1{guess}", firmware="carryout")
    bench.clock.step_utc(passing.aos.timestamp() - EARLY_S - at(bench))
    bench.connect(8.0)
    bench.do(Release("you"))
    bench.do(Goto(180, 45, "you"), 200)
    return bench


def plan_for(bench, satellite, passing):
    mount = mount_of(bench.state, Settings())
    return plan_pass(Satellite(satellite), HELSINKI, mount, bench.clock.utc(), passing=passing)


@cache
def chosen(low_deg, high_deg, rewinds):
    """Return the first pass that culminates between two elevations, and is followed with so many rewinds."""
    bench = in_place(passes()[0][1], "")
    for satellite, passing in passes():
        if low_deg < passing.max_elevation_deg < high_deg and not passing.already_up:
            plan = plan_for(bench, satellite, passing)
            if plan.legs and [leg.part for leg in plan.legs].count(PlanPart.REWIND) == rewinds:
                return satellite, passing
    raise AssertionError("there is no such pass")


def ready(satellite, passing, guess):
    """Return a dish in place, and the plan of a pass."""
    bench = in_place(passing, guess)
    return bench, plan_for(bench, satellite, passing)


GUESSES = ["", "&record=moving", "&speed=5&accel=5&prompt_when=at_once", "&g_axes=turn&wrap=455"]


@pytest.mark.parametrize(
    "guess", ["", "&record=moving", "&speed=5&accel=5&prompt_when=at_once", "&g_axes=turn&wrap=455"]
)
@pytest.mark.parametrize(("low_deg", "high_deg", "rewinds"), [(30, 40, 0), (60, 70, 0), (35, 80, 1)])
def test_a_pass_is_followed_at_least_as_well_as_foreseen(guess, low_deg, high_deg, rewinds):
    bench, plan = ready(*chosen(low_deg, high_deg, rewinds), guess)
    bench.pursue(plan, at_end="stay")
    errors = []
    for leg in plan.legs:
        bench.step(max(0.0, leg.start_s + SETTLED_S - at(bench)))
        while leg.part is PlanPart.FOLLOW and at(bench) < leg.end_s - 1.0:
            truth = bench.device.truth()
            errors.append(separation(truth.az_deg, truth.el_deg, *plan.sky.at(at(bench))))
            bench.step(0.5)
    assert bench.pursuit.phase is Phase.FOLLOWING
    assert math.sqrt(sum(error**2 for error in errors) / len(errors)) <= plan.forecast.rms_deg
    assert max(errors) <= plan.forecast.max_deg
    assert plan.forecast.rms_deg < 1.0


def test_a_rehearsal_shows_no_more_than_was_foreseen_from_the_course():
    bench, plan = ready(*chosen(60, 70, 0), "")
    shown = rehearse(plan, mount_of(bench.state, Settings()), CONTROLLERS["modelled"])
    assert plan.forecast.rms_deg / 2.0 < shown.rms_deg <= plan.forecast.rms_deg
