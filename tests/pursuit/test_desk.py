"""The desk as a face meets it: what is chosen, planned, followed, and said."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import pytest
from birdcage.base.config import Settings
from birdcage.base.config.sections import HorizonPoint, MotionSettings, PlaceSettings
from birdcage.base.config.tracking_sections import TrackingSettings
from birdcage.pursuit.now import Mode
from birdcage.sky.catalogue import Catalogue
from birdcage.station.mounting import mount_of
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto, ReleaseLease

STATION = "DEMO LEO 2 station"


def test_what_is_typed_is_found_and_told(bench):
    bench.desk.search("leo 2")
    now = bench.do()
    assert now.query == "leo 2"
    assert now.found[0].name == STATION
    bench.desk.search("")
    assert bench.do().found[0].name == "Sun"


def test_a_choice_is_planned_and_nothing_moves(bench):
    bench.desk.choose(STATION)
    now = bench.do()
    assert (now.choice, now.aim.name, now.mode, now.problem) == (STATION, STATION, Mode.WATCH, "")
    assert now.plan.course is not None
    assert now.passes[0].passing == now.plan.passing
    assert now.look.el_deg < 0.0
    assert now.plan.pointing.median.rms_deg > 0.0
    bench.step(30.0)
    assert bench.pursuit is None
    assert bench.moves() == []


def test_while_something_is_chosen_it_is_told_once_a_second(bench):
    bench.desk.choose(STATION)
    bench.do()
    before = len(bench.told)
    bench.step(10.0)
    assert 9 <= len(bench.told) - before <= 12
    looks = [each.look.el_deg for each in bench.told[-5:]]
    assert looks == sorted(looks)  # it is about to rise
    assert len(set(looks)) == 5


def test_nothing_is_told_while_nothing_is_chosen(bench):
    bench.step(5.0)
    before = len(bench.told)
    bench.step(30.0)
    assert len(bench.told) == before


def test_what_nobody_is_called_is_a_sentence_and_the_choice_stays(bench):
    bench.desk.choose(STATION)
    bench.do()
    bench.desk.choose("no such thing")
    now = bench.do()
    assert "No target is called 'no such thing'" in now.problem
    assert now.choice == STATION


def test_without_a_place_it_says_how_to_set_one(make):
    bench = make(observer=None)
    bench.desk.choose(STATION)
    now = bench.do()
    assert now.problem.startswith("No place is set. `birdcage place add")
    assert now.plan is None
    bench.desk.follow()
    assert bench.do().mode is Mode.WATCH


def test_another_pass_can_be_chosen(bench):
    bench.desk.choose(STATION)
    third = bench.do().passes[2].passing
    bench.desk.choose_pass(third.aos)
    now = bench.do()
    assert now.plan.passing == third
    assert now.passes[0].passing == third


def test_other_limits_make_another_plan(bench):
    bench.desk.choose(STATION)
    before = bench.do().plan
    settings = Settings(motion=MotionSettings(min_elevation_deg=40.0))
    bench.desk.apply(settings, replace(bench.observer, latitude_deg=50.5))
    after = bench.do().plan
    assert after is not before
    assert after.passing != before.passing


def test_a_time_offset_is_remembered_with_its_date_and_moves_the_plan(bench):
    bench.desk.choose(STATION)
    before = bench.do().plan
    bench.desk.set_time_offset(2.5)
    now = bench.do()
    assert now.aim.time_offset_s == 2.5
    assert 2.0 < (now.plan.passing.aos - before.passing.aos).total_seconds() < 3.0
    with Catalogue(bench.paths.catalogue) as catalogue:
        (entry,) = catalogue.search(STATION, 1)
    assert entry.time_offset_s == 2.5
    assert abs(entry.time_offset_set - bench.clock.utc()) < timedelta(seconds=5)
    bench.desk.set_time_offset(9999.0)
    assert "at most 3600 s" in bench.do().problem
    bench.desk.choose("sun")
    bench.desk.set_time_offset(1.0)
    assert "needs a satellite" in bench.do().problem


def test_a_frequency_stands_in_the_plan_and_the_usual_one_comes_back(bench):
    bench.desk.choose(STATION)
    assert bench.do().aim.frequency_hz is None
    bench.desk.set_frequency(1.7e9)
    assert bench.do().aim.frequency_hz == 1.7e9
    bench.desk.set_frequency(None)
    assert bench.do().aim.frequency_hz is None


def test_aim_once_goes_there_and_no_further(bench):
    bench.desk.choose("az 30 el 55")
    bench.desk.aim_once()
    assert bench.do().mode is Mode.AIM
    bench.until(lambda: bench.desk.now.mode is Mode.WATCH, 60.0)
    truth = bench.device.truth()
    assert truth.az_deg % 360.0 == pytest.approx(30.0, abs=0.1)
    assert truth.el_deg == pytest.approx(55.0, abs=0.1)
    assert bench.pursuit is None


def test_aim_at_what_is_below_the_floor_is_refused_with_the_reason(bench):
    bench.desk.choose("az 30 el 5")
    bench.desk.aim_once()
    now = bench.do(1.0)
    assert "floor" in now.problem
    assert now.mode is Mode.WATCH
    assert bench.moves() == []


def test_a_whole_pass_is_followed_from_waiting_to_its_end(bench):
    bench.desk.choose(STATION)
    bench.desk.follow()
    assert bench.do().mode is Mode.FOLLOW
    assert bench.phase() is Phase.WAITING
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.until(lambda: bench.phase() is Phase.OVER)
    now = bench.do()
    assert now.mode is Mode.WATCH
    assert bench.pursuit.max_error_deg < 0.6
    assert now.plan.passing.aos > bench.clock.utc()  # the next one


def test_the_plan_is_made_for_where_the_dish_stands_when_it_leaves(bench):
    bench.step(8.0)  # until it has told its limits
    bench.desk.choose(STATION)
    bench.desk.follow()
    bench.do()
    first = bench.pursuit.plan
    bench.station.submit(Goto(200.0, 55.0, "you"))
    bench.step(20.0)
    bench.station.submit(ReleaseLease("you"))
    bench.step(1.0)
    leave_s = bench.pursuit.plan.preposition.leave_s
    bench.until(lambda: bench.phase() in (Phase.PREPOSITIONING, Phase.READY))
    assert bench.pursuit.number == 1
    assert bench.pursuit.plan is not first
    assert bench.pursuit.plan.made_at.timestamp() == pytest.approx(leave_s, abs=14.0)


def test_a_time_offset_in_mid_pass_comes_in_without_a_break(bench):
    bench.desk.choose(STATION)
    bench.desk.follow()
    bench.do()
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(20.0)
    bench.desk.set_time_offset(1.0)
    bench.do()
    assert (bench.pursuit.number, bench.pursuit.plan.aim.time_offset_s) == (1, 1.0)
    assert bench.phase() is Phase.FOLLOWING


def test_leaving_ends_it_and_the_dish_stays(bench):
    bench.desk.choose(STATION)
    bench.desk.follow()
    bench.do()
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.desk.leave()
    bench.until(lambda: bench.phase() is Phase.OVER, 10.0)
    assert bench.do().mode is Mode.WATCH
    bench.step(3.0)
    here = bench.device.truth().az_deg
    bench.step(20.0)
    assert bench.device.truth().az_deg == pytest.approx(here, abs=0.01)


def test_what_cannot_be_reached_is_not_followed_and_says_why(bench):
    bench.desk.choose("az 30 el 5")
    bench.desk.follow()
    now = bench.do()
    assert now.problem
    assert now.mode is Mode.WATCH
    assert bench.pursuit is None


WALL = (HorizonPoint(0.0, 80.0), HorizonPoint(180.0, 80.0))
"""A horizon mask behind which every pass stays."""


@pytest.mark.parametrize("points", [WALL[:1], WALL], ids=["one point", "all round"])
def test_a_horizon_mask_refuses_no_target(make, points):
    bench = make(settings=Settings(motion=MotionSettings(min_elevation_deg=50.0), place=PlaceSettings(horizon=points)))
    bench.desk.choose(STATION)
    bench.desk.follow()
    assert bench.do().mode is Mode.FOLLOW
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.step(5.0)
    assert bench.moves()
    heard = [one for one in bench.desk.now.plan.notes if "behind the horizon mask" in one.lower()]
    assert len(heard) == (points == WALL)


def test_another_mask_counts_at_once(bench):
    bench.desk.choose(STATION)
    assert "horizon" not in bench.do().plan.reach.reasons
    bench.desk.apply(replace(bench.settings, place=PlaceSettings(horizon=WALL)), bench.observer)
    assert "horizon" in bench.do().plan.reach.reasons


def test_a_dish_that_does_not_know_where_it_is_follows_nothing(make):
    bench = make(address="g2?seed=1&unhomed=1")
    bench.desk.choose("az 30 el 55")
    bench.desk.follow()
    now = bench.do(1.0)
    assert now.problem
    assert now.mode is Mode.WATCH
    assert bench.moves() == []


def test_what_is_followed_goes_on_though_something_else_is_looked_at(bench):
    bench.desk.choose(STATION)
    bench.desk.follow()
    bench.do()
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.desk.choose("moon")
    now = bench.do()
    assert (now.choice, now.mode) == ("moon", Mode.FOLLOW)
    bench.step(10.0)
    assert bench.phase() is Phase.FOLLOWING
    assert bench.pursuit.plan.aim.name == STATION
    bench.desk.choose(str(bench.orbits[1].norad_id))
    now = bench.do()
    assert now.plan is bench.pursuit.plan
    assert now.choice == str(bench.orbits[1].norad_id)


def test_what_does_not_pass_is_carried_on_hour_after_hour(bench, monkeypatch):
    monkeypatch.setattr("birdcage.pursuit.chosen_target.RENEW_S", 60.0)
    bench.desk.choose("az 30 el 55")
    bench.desk.follow()
    bench.do()
    bench.until(lambda: bench.phase() is Phase.FOLLOWING, 60.0)
    first = bench.pursuit.plan
    bench.step(130.0)
    assert (bench.pursuit.number, bench.phase()) == (1, Phase.FOLLOWING)
    assert bench.pursuit.plan.sky.end_s >= first.sky.end_s + 120.0


def test_a_plan_of_axes_that_move_in_turn_is_refined_and_handed_on_before_reach(make, monkeypatch):
    def on_a_slip_ring(state, settings):
        mount = mount_of(state, settings)
        return replace(mount, limits=replace(mount.limits, cable_min_deg=None, cable_max_deg=None, turn_known=True))

    monkeypatch.setattr("birdcage.station.mounting.mount_of", on_a_slip_ring)
    bench = make(address="hal205?seed=1", settings=Settings())
    bench.desk.choose("LEO 10")  # goes through the zenith
    bench.desk.follow()
    bench.do(2.0)
    plans = [each.plan for each in bench.told if each.plan is not None]
    assert plans[0].keyholes
    assert (plans[0].refined, plans[-1].refined) == (False, True)
    assert plans[-1].passing == plans[0].passing
    assert bench.pursuit.plan is plans[-1]
    assert bench.pursuit.number == 1


@pytest.mark.parametrize("at_end", ["next", "stay"])
def test_after_a_pass_it_goes_on_to_the_next_one_only_if_that_is_set(make, at_end):
    settings = Settings(motion=MotionSettings(min_elevation_deg=58.0), tracking=TrackingSettings(at_end=at_end))
    bench = make(settings=settings)
    bench.desk.choose("LEO 2")
    bench.desk.follow()
    bench.do()
    first = bench.pursuit.plan
    bench.until(lambda: bench.phase() is Phase.FOLLOWING)
    bench.until(lambda: bench.phase() is not Phase.FOLLOWING, 120.0)
    bench.step(4.0)
    if at_end == "next":
        assert (bench.pursuit.number, bench.phase(), bench.desk.now.mode) == (2, Phase.WAITING, Mode.FOLLOW)
        assert bench.pursuit.plan.passing.aos > first.passing.los
    else:
        assert (bench.pursuit.number, bench.phase(), bench.desk.now.mode) == (1, Phase.OVER, Mode.WATCH)
