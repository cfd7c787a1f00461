"""Autotrack at the desk: the dry run, and pass after pass of the favourites."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import pytest
from birdcage.base.config import Settings
from birdcage.base.config.sections import MotionSettings
from birdcage.base.config.station_section import StationSection
from birdcage.base.config.tracking_sections import AutotrackSettings
from birdcage.pursuit.now import Mode
from birdcage.sky.catalogue import Catalogue
from birdcage.station.events import FaultRaised, PursuitChanged, Recovered
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Release

RULES = Settings(
    autotrack=AutotrackSettings(min_elevation_deg=5.0, min_duration_s=20.0, hours=2.0),
    motion=MotionSettings(min_elevation_deg=50.0),
)
FAVOURITES = (1, 2, 3)


@pytest.fixture
def auto(make):
    bench = make(settings=RULES, favourites=FAVOURITES)
    bench.do(2.0)
    return bench


def test_the_dry_run_is_shown_and_nothing_moves(auto):
    rows = auto.desk.now.schedule
    assert {row.name for row in rows} <= {auto.orbits[index].name for index in FAVOURITES}
    assert any(row.kept for row in rows)
    assert [row.reach_start for row in rows] == sorted(row.reach_start for row in rows)
    auto.step(20.0)
    assert auto.pursuit is None


def test_without_favourites_there_is_no_schedule_and_it_says_so(make):
    bench = make(settings=RULES)
    bench.desk.set_autotrack(True)
    now = bench.do()
    assert now.schedule == ()
    assert "you have none" in now.problem


def test_it_follows_one_pass_after_the_other_each_after_a_countdown(auto):
    kept = [row for row in auto.desk.now.schedule if row.kept]
    auto.desk.set_autotrack(True)
    now = auto.do(2.0)
    assert now.autotrack
    assert (now.mode, now.aim.name) == (Mode.FOLLOW, kept[0].name)
    auto.until(lambda: auto.phase() is Phase.FOLLOWING)
    assert auto.pursuit.plan.aim.name == kept[0].name
    auto.until(lambda: auto.pursuit.number == 2, 600.0, every=1.0)
    assert auto.pursuit.plan.aim.name == kept[1].name
    assert auto.pursuit.plan.passing.los > kept[1].reach_start
    auto.until(lambda: auto.phase() is Phase.FOLLOWING, 1200.0, every=1.0)
    seen = {event.pursuit.phase for event in auto.events if isinstance(event, PursuitChanged)
            and event.pursuit.number == 2}  # fmt: skip
    assert Phase.COUNTDOWN in seen  # that one was not just asked for


def test_stop_switches_it_off_for_good(auto):
    auto.desk.set_autotrack(True)
    auto.do(2.0)
    auto.until(lambda: auto.phase() is Phase.FOLLOWING)
    auto.station.stop("you")
    auto.step(5.0)
    assert not auto.desk.now.autotrack
    assert "STOP has switched autotrack off" in auto.desk.now.problem
    auto.station.submit(Release("you"))
    auto.step(60.0)
    assert auto.phase() is Phase.OVER
    assert auto.pursuit.number == 1


def test_leaving_switches_it_off(auto):
    auto.desk.set_autotrack(True)
    auto.do(2.0)
    auto.desk.leave()
    auto.step(30.0)
    assert not auto.desk.now.autotrack
    assert auto.phase() is Phase.OVER
    assert auto.pursuit.number == 1


def test_what_a_person_follows_is_not_taken_away(auto):
    auto.desk.choose("az 30 el 55")
    auto.desk.follow()
    auto.do()
    auto.desk.set_autotrack(True)
    auto.step(330.0, every=1.0)
    assert auto.pursuit.plan.aim.kind == "fixed"


def test_a_new_favourite_comes_into_the_schedule(auto):
    before = {row.name for row in auto.desk.now.schedule}
    with Catalogue(auto.paths.catalogue) as catalogue:
        catalogue.set_favourite(auto.orbits[5].norad_id)
    auto.step(7.0)
    assert {row.name for row in auto.desk.now.schedule} - before == {auto.orbits[5].name}
    assert auto.desk.now.schedule[0].reach_end > auto.clock.utc() - timedelta(minutes=1)


@pytest.fixture
def night(make):
    """Autotrack at work at a dish that is homed again by itself."""
    rules = replace(RULES, station=StationSection(after_reboot="home"))
    bench = make(settings=rules, favourites=FAVOURITES, options={"home_after_reboot": True})
    bench.do(2.0)
    bench.desk.set_autotrack(True)
    bench.do(2.0)
    return bench


@pytest.mark.parametrize("phase", [Phase.WAITING, Phase.FOLLOWING])
def test_a_dish_whose_power_fails_at_night_follows_the_next_pass_and_one_event_says_so(night, phase):
    kept = [row for row in night.desk.now.schedule if row.kept]
    night.until(lambda: night.phase() is phase)
    night.device.reboot()
    night.until(lambda: any(isinstance(event, FaultRaised) for event in night.events))
    night.until(lambda: night.station.state.fault is None, 300.0)
    assert night.station.state.held is None
    for row in kept[:2]:
        night.until(
            lambda row=row: night.phase() is Phase.FOLLOWING and night.pursuit.plan.aim.name == row.name, 2400.0
        )
    assert [type(event) for event in night.events].count(Recovered) == 1
    assert night.desk.now.autotrack


def test_a_persons_stop_after_its_power_has_failed_ends_autotrack(night):
    night.until(lambda: night.phase() is Phase.FOLLOWING)
    night.device.reboot()
    night.until(lambda: night.station.state.fault is not None)
    night.station.stop("you")
    night.until(lambda: not night.desk.now.autotrack)
    assert night.desk.now.problem == "STOP has switched autotrack off."


def test_unless_it_is_homed_by_itself_a_restart_ends_autotrack(auto):
    auto.desk.set_autotrack(True)
    auto.do(2.0)
    auto.until(lambda: auto.phase() is Phase.FOLLOWING)
    auto.device.reboot()
    auto.until(lambda: not auto.desk.now.autotrack, 120.0)
