"""Targets that are always up: their day, and what a person and a program are told of it instead of a duration."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime

import pytest
from birdcage.pursuit.follower import told_reach_end
from birdcage.pursuit.pass_facts import facts_of
from birdcage.sky.elements import ElementSet
from birdcage.sky.ephemeris.bodies import BODIES
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet
from birdcage.sky.slots import Slot
from birdcage.sky.targets.model import BodyTarget, Satellite, SlotTarget
from birdcage.tracking.plan_values import plan_values
from birdcage.tracking.plan_words import plan_lines
from birdcage.tracking.planning.planner import plan_pass

from .orbits import NOW, PLACE, mount


def stationary(inclination_deg=0.05, mean_anomaly_deg=60.0):
    return Satellite(
        ElementSet("GEO", 7, NOW, inclination_deg, 0.0, 0.0001, 0.0, mean_anomaly_deg, 1.00273790935)
    )  # fmt: skip


def over(target, on=None, **options):
    return plan_pass(target, PLACE, on or mount(), NOW, **options)


def text_of(plan):
    lines = plan_lines(plan)
    assert max(map(len, lines)) <= 80
    return "\n".join(lines)


@pytest.fixture(scope="module")
def slot():
    return over(SlotTarget(Slot(-105.0, "")))


def test_a_slot_is_always_up_and_its_plan_tells_no_duration(slot):
    assert (slot.day.always_up, slot.day.always_in_reach, slot.reach_end_s) == (True, True, None)
    text = text_of(slot)
    assert "Sky      always up" in text
    assert "Follow   12:00:03Z until you end it" in text
    for wrong in ("60 min", "13:00:00", "Time ", "Drift"):
        assert wrong not in text
    values = plan_values(slot)
    assert (values["always_up"], values["reach"]["total_s"]) == (True, None)
    assert values["reach"]["intervals"][0]["end"] is None
    assert values["day"]["always_in_reach"]
    assert "unreach" not in {one["what"] for one in values["incidents"]}


def test_a_satellite_that_keeps_its_place_tells_how_far_it_drifts_in_a_day():
    plan = over(stationary(inclination_deg=2.0, mean_anomaly_deg=stationary_anomaly()))
    assert plan.day.always_up
    assert 3.0 < plan.day.el_drift_deg < 6.0
    text = text_of(plan)
    assert "always up" in text
    assert f"Drift    {plan.day.az_drift_deg:.2f}° of azimuth, {plan.day.el_drift_deg:.2f}° of elevation a day" in text


def stationary_anomaly():
    """Where it must be in its orbit to stand in the south of the place now."""
    return min(range(0, 360, 5), key=lambda at: -stationary(2.0, at).look(PLACE, NOW).el_deg)


def test_a_pass_of_the_search_that_neither_begins_nor_ends_is_none(slot):
    target = stationary(0.05, stationary_anomaly())
    (passing,) = search(Fleet([target.elements]), PLACE, NOW, 24.0)
    assert passing.already_up
    assert passing.still_up
    plan = over(target, passing=passing)
    assert plan.passing is None
    assert plan.day.standing == "always up"


def test_what_is_always_up_out_of_reach_says_what_is_in_the_way():
    plan = over(SlotTarget(Slot(-170.0, "")))
    assert plan.day.standing == "always up, out of reach: below the 18° floor"
    assert plan.notes[0] == "Always up, out of reach: below the 18° floor."
    assert "60 min" not in text_of(plan)
    ceiling = over(SlotTarget(Slot(-105.0, "")), mount(el_ceiling_deg=30.0))
    assert ceiling.day.standing == "always up, out of reach: above the 30° ceiling"
    assert over(SlotTarget(Slot(75.0, ""))).day.standing == "never up here"


def test_the_sun_is_told_to_the_end_of_its_reach_and_not_to_that_of_the_plan():
    when = NOW.replace(hour=19)  # noon there
    plan = plan_pass(BodyTarget(BODIES["sun"]), PLACE, mount(), when)
    end = told_reach_end(plan)
    assert (end - when).total_seconds() > 2.0 * 3600.0
    assert plan.day.standing == ""
    text = text_of(plan)
    assert f"until {end:%H:%M:%S}Z" in text
    assert "Sky      sets 23:" in text
    assert plan_values(plan)["always_up"] is False


def test_hooks_get_no_end_for_what_is_always_up(slot):
    facts = facts_of(slot, PLACE)
    told = facts.environment("reach_start")
    assert (told["BIRDCAGE_REACH_END"], told["BIRDCAGE_DURATION_S"]) == ("", "")
    later = facts_of(over(SlotTarget(Slot(-105.0, ""))), PLACE)
    assert facts.is_same_pass(later)
    assert not facts.is_same_pass(replace(later, name="other"))


def test_a_pass_keeps_its_duration():
    from .orbits import plan_of

    plan = plan_of()
    assert plan.day is None
    assert plan_values(plan)["reach"]["total_s"] > 60.0
    assert isinstance(told_reach_end(plan), datetime)
    assert plan.reach_end_s == plan.legs[-1].end_s
