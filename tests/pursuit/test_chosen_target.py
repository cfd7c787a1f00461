"""A choice: which pass is meant, and when a plan is made anew."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.base.beam import Beam
from birdcage.base.config import Settings
from birdcage.base.config.tracking_sections import TrackingSettings
from birdcage.pursuit.choosing import choice_of
from birdcage.pursuit.circumstances import Circumstances
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer
from birdcage.sky.targets import Resolver
from birdcage.sky.targets.model import Satellite
from birdcage.station.known import list_models
from birdcage.station.reach_limits import reach_limits
from birdcage.tracking.mount import Mount, Standing

NOW = datetime(2026, 11, 21, 12, tzinfo=UTC)
HERE = Observer(50.0, 10.0, 300.0)
STATION = demo_orbits(NOW, HERE)[1]
G2 = next(model for model in list_models() if model.firmware == "g2")
SETTINGS = Settings()
MOUNT = Mount(G2, reach_limits(SETTINGS, G2), standing=Standing(-180.0, 45.0))
AT = Circumstances(NOW, HERE, MOUNT, SETTINGS)


@pytest.fixture
def choice():
    return choice_of("station", Satellite(STATION), None)


def later(at, seconds, **changes):
    return replace(at, now=at.now + timedelta(seconds=seconds), **changes)


def test_the_next_pass_in_reach_is_planned_once(choice):
    assert choice.refresh(AT)
    first = choice.rows[0].passing
    assert choice.plan.passing == first
    assert choice.plan.course is not None
    assert first.aos > NOW
    assert choice.shown(NOW)[0].passing == first
    plan = choice.plan
    assert not choice.refresh(later(AT, 60.0))
    assert choice.plan is plan


@pytest.mark.parametrize("change", [
    {"mount": replace(MOUNT, limits=replace(MOUNT.limits, el_floor_deg=30.0))},
    {"mount": replace(MOUNT, model=G2.with_axes(replace(G2.azimuth, speed_deg_s=20.0)))},
    {"mount": replace(MOUNT, standing=Standing(-380.0, 45.0))},
    {"mount": replace(MOUNT, beam=Beam(3.0, 3.0))},
    {"observer": Observer(50.1, 10.0, 300.0)},
    {"settings": replace(SETTINGS, tracking=TrackingSettings(preposition_s=10.0))},
], ids=["limits", "speed", "turn", "beam", "place", "settings"])  # fmt: skip
def test_what_a_plan_rests_on_makes_another(choice, change):
    choice.refresh(AT)
    assert choice.refresh(later(AT, 1.0, **change))
    assert not choice.refresh(later(AT, 2.0, **change))


def test_a_dish_that_only_points_elsewhere_keeps_the_plan_but_is_noticed(choice):
    choice.refresh(AT)
    moved = later(AT, 1.0, mount=replace(MOUNT, standing=Standing(-150.0, 45.0)))
    assert not choice.refresh(moved)
    assert choice.stood_elsewhere(moved, 1.0)
    assert not choice.stood_elsewhere(AT, 1.0)


def test_a_dish_that_turns_by_the_plan_keeps_it_whatever_turn_it_comes_through(choice):
    choice.refresh(AT)
    through = later(AT, 1.0, mount=replace(MOUNT, standing=Standing(-380.0, 45.0)))
    assert not choice.refresh(through, keep_turn=True)


def test_another_pass_can_be_meant_and_the_list_begins_with_it(choice):
    choice.refresh(AT)
    third = choice.rows[2].passing
    choice.wanted_at = third.aos
    assert choice.refresh(AT)
    assert choice.plan.passing == third
    assert choice.shown(NOW)[0].passing == third
    assert all(row.passing.aos >= third.aos for row in choice.shown(NOW))


def test_what_is_followed_stays_though_something_else_was_meant(choice):
    choice.refresh(AT)
    first, third = choice.rows[0].passing, choice.rows[2].passing
    choice.wanted_at = third.aos
    assert not choice.refresh(AT, pinned=first)
    assert choice.plan.passing == first


def test_once_it_is_out_of_reach_the_next_one_is_meant(choice):
    choice.refresh(AT)
    end = choice.rows[0].reach.intervals[-1].end
    second = choice.rows[1]
    assert choice.refresh(replace(AT, now=end + timedelta(seconds=1)))
    assert choice.plan.passing.aos >= second.passing.aos


def test_a_time_offset_moves_pass_and_plan(choice):
    choice.refresh(AT)
    before = choice.plan
    choice.time_offset_s = 10.0
    assert choice.refresh(AT)
    assert choice.plan.aim.time_offset_s == 10.0
    moved = (choice.plan.passing.tca - before.passing.tca).total_seconds()
    assert moved == pytest.approx(10.0, abs=1.0)  # the Earth turns on meanwhile
    top, was = choice.plan.sky.at(choice.plan.passing.tca.timestamp()), before.sky.at(before.passing.tca.timestamp())
    assert top[1] == pytest.approx(was[1], abs=0.5)


def test_what_does_not_pass_is_planned_for_an_hour_and_again_before_that_is_over():
    choice = choice_of("az 180 el 40", Resolver().resolve("az 180 el 40").target, None)
    assert choice.refresh(AT)
    assert choice.plan.passing is None
    assert choice.plan.sky.end_s - choice.plan.sky.start_s == pytest.approx(3600.0)
    assert not choice.refresh(later(AT, 1700.0))
    assert choice.refresh(later(AT, 1801.0))
    assert choice.plan.sky.end_s == pytest.approx(AT.now.timestamp() + 1801.0 + 3600.0)


def test_elements_that_give_no_position_are_a_sentence():
    fallen = replace(STATION, mean_motion_rev_day=17.5, bstar=0.5)
    choice = choice_of("fallen", Satellite(fallen), None)
    far = replace(AT, now=NOW + timedelta(days=300))
    choice.refresh(far)
    assert choice.plan is None
    assert "decays" in choice.problem
    assert choice.look(far) is None


def test_expected_error_is_of_the_planned_pass():
    choice = choice_of("station", Satellite(replace(STATION, source="")), None)
    choice.refresh(AT)
    age = choice.plan.passing.tca - STATION.epoch
    assert choice.plan.elements.closest.age_s == pytest.approx(age.total_seconds(), abs=10.0)
