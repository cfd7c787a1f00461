"""Dish and elements come to one error: at every moment, over the pass, and in decibels."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import timedelta

import numpy as np
import pytest
from birdcage.sky.age_words import age_words
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet
from birdcage.sky.targets.model import Fixed, Satellite
from birdcage.tracking.plan_values import plan_values
from birdcage.tracking.plan_words import plan_lines
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.planning.refining import refine
from birdcage.tracking.pointing_error import UPDATE, error_words

from .orbits import NOW, PLACE, mount, overhead, travler

LOW = {"inclination_deg": 51.6, "height_km": 420.0}


def aged(days, aside_deg=2.0, on=None, **orbit):
    """The plan of the best pass of a day, by elements that old."""
    old = replace(overhead(aside_deg, **orbit)[0].elements, epoch=NOW - timedelta(days=days))
    found = max(search(Fleet([old]), PLACE, NOW, 24.0), key=lambda each: min(each.max_elevation_deg, 64.0))
    return plan_pass(Satellite(old), PLACE, mount() if on is None else on, NOW, passing=found)


def test_squares_add_at_every_moment_and_over_the_pass():
    plan = aged(2.0, **LOW)
    found = plan.pointing
    added = np.interp(found.dish.t_s, found.elements.t_s, found.elements.median_deg)
    assert found.median.error_deg == pytest.approx(np.sqrt(found.dish.error_deg**2 + added**2))
    assert found.median.rms_deg == pytest.approx(math.hypot(found.dish.rms_deg, math.sqrt((added**2).mean())))
    assert found.median.rms_deg == pytest.approx(math.sqrt((found.median.error_deg**2).mean()), rel=0.02)
    assert found.median.max_deg >= found.median.error_deg.max()
    assert found.p90.rms_deg > found.median.rms_deg > found.dish.rms_deg


def test_decibels_follow_the_same_error():
    found = aged(2.0, **LOW).pointing
    assert found.median.loss_db == pytest.approx(
        found.dish.loss_db * (found.median.error_deg / found.dish.error_deg) ** 2
    )


def test_of_what_the_age_does_not_tell_the_whole_is_unknown():
    plan = aged(3228.0)
    assert plan.pointing.median is plan.pointing.p90 is None
    assert plan.pointing.unknown == "figures end at 7 d"
    assert error_words(plan.pointing) == "unknown"
    text = "\n".join(plan_lines(plan))
    assert "Error    unknown\n         ✗ useless elements, 3228 d old, figures end at 7 d" in text
    assert "`birdcage elements" in text
    assert " dB" not in text
    values = plan_values(plan)
    assert values["forecast"]["rms_error_deg"] is values["forecast"]["max_loss_db"] is None
    assert values["forecast"]["unknown_because"] == "figures end at 7 d"
    assert values["elements"]["elements_grade"] == "useless"
    assert {row["expected_error_deg"] for row in values["path"]} == {row["loss_db"] for row in values["path"]} == {None}


def test_a_plan_says_the_error_of_dish_and_elements_with_grade_age_and_remedy():
    plan = aged(2.0, **LOW)
    text = "\n".join(plan_lines(plan))
    assert max(map(len, plan_lines(plan))) <= 80
    found, forecast = plan.pointing, plan_values(plan)["forecast"]
    assert f"Error    {error_words(found)}, max ±" in text
    assert f"elements, {age_words(found.elements.closest.age_s)}: {UPDATE}" in " ".join(text.split())
    assert f"dish alone {found.dish.rms_deg:.3f}° RMS" in text
    assert forecast["rms_error_deg"] == pytest.approx(found.median.rms_deg, abs=1e-4)
    assert forecast["max_loss_p90_db"] == pytest.approx(float(found.p90.loss_db.max()), abs=1e-4)
    assert plan_values(plan)["dish_forecast"]["rms_error_deg"] < forecast["rms_error_deg"]
    assert forecast["advice"] == UPDATE


def test_fresh_elements_need_no_advice():
    found = aged(0.1).pointing
    assert (found.elements.closest.grade, found.advice) == ("fresh", "")


def test_what_follows_no_elements_has_the_error_of_the_dish_and_no_word_of_age():
    plan = plan_pass(Fixed("high", 200.0, 45.0), PLACE, mount(), NOW)
    assert (plan.elements, plan.pointing.elements) == (None, None)
    assert plan.pointing.median.rms_deg == plan.forecast.rms_deg
    assert "elements" not in "\n".join(plan_lines(plan))
    assert plan_values(plan)["elements"] is None


def test_what_is_never_in_reach_tells_a_re_entry_all_the_same():
    target, passing = overhead(2.0, **LOW)
    sinking = replace(target.elements, mean_motion_dot=1e-3, epoch=NOW - timedelta(days=900))
    out = mount(el_floor_deg=89.9)
    plan = plan_pass(Satellite(sinking), PLACE, out, NOW, passing=replace(passing, name="MADE UP"))
    assert plan.pointing is None
    assert any("By its elements it re-entered about" in note and "still flies" in note for note in plan.notes)


def test_a_refined_plan_keeps_the_elements():
    on = mount(travler(5.0), at=(200.0, 30.0))
    plan = aged(1.0, 0.07, on, northbound=False)
    assert refine(plan, on, shares=(0.9,)).pointing.elements is plan.elements


def test_while_it_follows_the_elements_count_at_that_moment():
    plan = aged(2.0, **LOW)
    found, t_s = plan.pointing, plan.legs[0].start_s
    there = float(np.interp(t_s, found.elements.t_s, found.elements.median_deg))
    assert found.at(t_s, 0.3) == pytest.approx(math.hypot(0.3, there))
    assert aged(3228.0).pointing.at(t_s, 0.3) is None
    assert found.with_dish(0.0)[0] == pytest.approx(math.sqrt(found.median.rms_deg**2 - found.dish.rms_deg**2))
    assert found.with_dish(None) == (None, None)
