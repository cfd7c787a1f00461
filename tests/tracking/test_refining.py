"""Rehearsals, and the share that they choose."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from birdcage.base.no_go import NoGoSector
from birdcage.protocol.hal.model import TRAVLER
from birdcage.tracking.planning.forecast import saw_tooth_deg
from birdcage.tracking.planning.planner import refine
from birdcage.tracking.planning.rehearsal import rehearse
from birdcage.tracking.steering.choice import controller_for
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steering.queued import queued
from birdcage.tracking.steps import Send, Wait

from .orbits import g2, mount, plan_of, travler


def late(guide):
    """A poor controller: where the target is now, every two seconds."""
    now_s = guide.now_s
    while now_s < guide.until_s:
        for axis, deg in enumerate(guide.course().at(now_s)):
            answer = yield Send(axis, deg)
        now_s = (yield Wait(answer.now_s + 2.0)).now_s


@pytest.fixture(scope="module")
def hard():
    on = mount(travler(5.0), at=(200.0, 30.0))
    return plan_of(0.37, on, orbit={"northbound": False}), on


@pytest.fixture(scope="module")
def by_share(hard):
    """What refining makes of the hard pass with each share alone."""
    plan, on = hard
    return {share: refine(plan, on, queued, shares=(share,)) for share in (0.85, 0.9, 0.95, 1.0)}


def test_a_rehearsal_tells_a_good_controller_from_a_poor_one():
    on = mount(g2(80.0))
    plan = plan_of(4.0, on)
    tca = plan.passing.tca.timestamp()
    within = [(tca - 20.0, tca + 20.0)]
    good, poor = (rehearse(plan, on, controller, within=within) for controller in (fast, late))
    assert good.rms_deg < 0.05 < 0.3 < poor.rms_deg
    assert good.t_s[0] == within[0][0]
    assert rehearse(plan, on, fast, within=within).rms_deg == good.rms_deg
    with pytest.raises(ValueError, match="follows nothing"):
        rehearse(plan, on, fast, within=[(0.0, 1.0)])


def test_what_is_forecast_is_what_a_rehearsal_shows(hard):
    plan, on = hard
    hole = plan.keyholes[0]
    seen = rehearse(plan, on, queued, within=[(hole.start_s, hole.end_s)])
    assert seen.max_deg == pytest.approx(hole.max_error_deg, rel=0.3)


def test_lines_that_may_not_come_too_fast_count_in_both():
    free, paced = (mount(replace(TRAVLER, least_line_interval_s=pace_s), at=(200.0, 30.0)) for pace_s in (None, 0.2))
    plan = plan_of(12.0, free)
    at_s = plan.passing.tca.timestamp() + np.arange(-20.0, 20.0)
    told = [saw_tooth_deg(on.model, plan.course, at_s, plan.legs)[0].size_deg.mean() for on in (free, paced)]
    seen = [rehearse(plan, on, queued, within=[(at_s[0], at_s[-1])]).rms_deg for on in (free, paced)]
    assert 1.03 < told[1] / told[0] < 1.2
    assert 1.03 < seen[1] / seen[0] < 1.5


@pytest.mark.parametrize("model", [g2(80.0), travler(5.0), TRAVLER], ids=["g2", "travler by speed", "travler by times"])
def test_a_calm_pass_is_forecast_as_it_will_be_and_rather_worse(model):
    # A rehearsal has exact kinematics: what an axis overshoots only the forecast counts.
    exact = (replace(axis, overshoot_deg=0.0) for axis in (model.azimuth, model.elevation))
    on = mount(model.with_axes(*exact))
    plan = plan_of(6.0, on)
    assert not plan.keyholes
    seen = rehearse(plan, on, controller_for(model)[1])
    for shown, told in ((seen.rms_deg, plan.forecast.rms_deg), (seen.max_deg, plan.forecast.max_deg)):
        assert shown / 1.2 < told < 2.0 * shown


def test_the_share_is_the_best_of_those_tried(hard, by_share):
    plan, on = hard
    refined = refine(plan, on)
    assert refined.refined
    assert refined.share in by_share
    assert refined.legs[0].start_s == plan.legs[0].start_s
    others = by_share.values()
    assert len({one.forecast.rms_deg for one in others}) == 4
    good = [one for one in others if one.keyholes[0].max_error_deg <= 2.6 * one.keyholes[0].limit_deg]
    if good:
        assert refined.forecast.rms_deg == min(one.forecast.rms_deg for one in good)
    else:
        assert refined.keyholes[0].max_error_deg == min(one.keyholes[0].max_error_deg for one in others)


def test_an_elevation_that_stays_below_the_top_leaves_less_error_in_a_keyhole(hard, by_share, monkeypatch):
    plan, on = hard
    holding = by_share[0.9]
    monkeypatch.setattr("birdcage.tracking.planning.refining.HOLDS", (0.0,))
    climbing = refine(plan, on, queued, shares=(0.9,))
    assert holding.course.el_deg.max() < climbing.course.el_deg.max() - 0.5
    assert holding.forecast.rms_deg < climbing.forecast.rms_deg


def test_a_plan_without_a_keyhole_has_nothing_to_choose():
    on = mount(travler(5.0))
    plan = plan_of(6.0, on)
    assert plan.refined
    refined = refine(replace(plan, refined=False), on, late)
    assert refined.refined
    assert refined.course is plan.course


def test_refining_keeps_the_way_over_a_mast():
    on = mount(travler(3.0), at=(200.0, 30.0), no_go=(NoGoSector(9.0, 10.5, 60.0, "mast"),))
    plan = plan_of(0.37, on, orbit={"northbound": False})
    assert plan.keyholes
    assert any(leg.waypoints for leg in plan.legs)
    refined = refine(plan, on, queued, shares=(0.9,))
    assert [(leg.part, leg.turn, leg.waypoints) for leg in refined.legs] == [
        (leg.part, leg.turn, leg.waypoints) for leg in plan.legs
    ]
    assert refined.course.at(refined.legs[1].start_s) == pytest.approx(plan.course.at(plan.legs[1].start_s))
