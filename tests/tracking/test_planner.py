"""What a plan does with single passes that are known to be easy, hard or impossible."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.beam import Beam
from birdcage.base.no_go import NoGoSector
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.targets.model import Fixed
from birdcage.tracking.plan import PlanPart
from birdcage.tracking.plan_words import plan_lines
from birdcage.tracking.planning.bounds import PlanBounds
from birdcage.tracking.planning.forecast import separations_deg
from birdcage.tracking.planning.planner import plan_pass
from birdcage.tracking.planning.routes import route
from birdcage.tracking.planning.target_track import TargetTrack

from .orbits import NOW, NOW_S, PLACE, g2, mount, overhead, plan_of, travler


def off_deg(plan, alignment=None):
    """The angle between course and sky while it follows."""
    alignment = alignment or Alignment()
    times = np.concatenate([np.arange(leg.start_s, leg.end_s, 0.2) for leg in plan.legs if leg.part is PlanPart.FOLLOW])
    az, el = plan.course.sample(times)
    true = np.array([alignment.to_true(a % 360.0, e) for a, e in zip(az, el, strict=True)])
    return separations_deg(true[:, 0], true[:, 1], *plan.sky.sample(times))


@pytest.mark.parametrize("alignment", [Alignment(), Alignment(123.4, -1.5), Alignment(1.0, 0.5, 0.3, 0.8, -0.7)])
def test_a_pass_well_inside_the_limits_is_followed_exactly(alignment):
    on = mount(g2(80.0), alignment=alignment, az_offset_deg=alignment.az_offset_deg, el_floor_deg=20.0)
    plan = plan_of(4.0, on)
    assert 55.0 < plan.passing.max_elevation_deg < 62.0
    assert off_deg(plan, alignment).max() < 1e-3
    assert [leg.part for leg in plan.legs] == [PlanPart.FOLLOW]
    assert (plan.keyholes, plan.share, plan.refined) == ((), None, True)
    assert plan.forecast.rms_deg < 0.05


def test_the_path_is_lifted_by_refraction():
    lifted, bare = plan_of(4.0), plan_of(4.0, refraction="none")
    by = np.interp(lifted.sky.t_s, bare.sky.t_s, bare.sky.el_deg)
    at = np.argmin(np.abs(lifted.sky.el_deg - 18.0))
    assert lifted.sky.el_deg[at] - by[at] == pytest.approx(0.056, abs=0.002)
    assert lifted.legs[0].start_s < bare.legs[0].start_s


@pytest.mark.parametrize(
    ("aside", "speed", "limit"), [(0.37, 5.0, 1.03), (0.07, 5.0, 2.8), (0.37, 3.0, 3.17), (0.07, 3.0, 5.0)]
)
def test_the_keyhole_costs_little_more_than_it_must(aside, speed, limit):
    """Passes like METOP-C's at 86 and 89.1 degrees, close to the zenith."""
    on = mount(travler(speed), at=(200.0, 30.0))
    plan = plan_of(aside, on, orbit={"northbound": False})
    (hole,) = plan.keyholes
    assert hole.limit_deg == pytest.approx(limit, rel=0.05)
    assert hole.limit_deg <= hole.max_error_deg <= 2.6 * hole.limit_deg
    assert off_deg(plan).max() <= hole.max_error_deg
    assert not plan.refined
    assert plan.share == 0.9


def test_a_pass_across_north_gets_a_turn_that_fits_it():
    plan = plan_of(4.0)
    (leg,) = plan.legs
    assert leg.turn == -1
    assert -423.33 < leg.to_az_deg < leg.from_az_deg < 23.33
    assert plan.rewinds == ()
    assert leg.to_az_deg % 360.0 > 350.0 or leg.to_az_deg % 360.0 < 10.0


def test_the_turn_of_the_cable_is_the_one_nearest_to_where_the_dish_stands():
    plans = [plan_pass(Fixed("north-west", 310.0, 40.0), PLACE, mount(at=(at, 30.0)), NOW) for at in (-300.0, -5.0)]
    assert [plan.preposition.az_deg for plan in plans] == pytest.approx([-410.0, -50.0])
    assert [plan.legs[0].turn for plan in plans] == [-2, -1]


def test_the_pass_after_this_one_decides_between_turns_that_suit_this_one_equally():
    later = plan_of(-6.0, orbit={"northbound": False, "inclination_deg": 64.5, "height_km": 550.0})
    assert later.legs[0].turn == -2
    plans = [
        plan_pass(Fixed("north-west", 310.0, 40.0), PLACE, mount(at=(-225.0, 30.0)), NOW, next_tracks=tracks)
        for tracks in ((), (later.sky,))
    ]
    assert [plan.legs[0].turn for plan in plans] == [-1, -2]


def test_a_pass_that_fits_no_turn_gets_one_rewind_that_is_announced():
    """A pass of the space station across north: azimuth 249 to 402 on a cable from -423 to 23."""
    plan = plan_of(-2.0, orbit={"inclination_deg": 51.6, "height_km": 420.0})
    before, rewind, after = plan.legs
    assert [leg.part for leg in plan.legs] == [PlanPart.FOLLOW, PlanPart.REWIND, PlanPart.FOLLOW]
    taken = route(PlanBounds.of(mount()), g2(), (rewind.from_az_deg, 40.0), (rewind.to_az_deg, 38.0))
    assert taken.seconds == pytest.approx(6.0, abs=0.1)
    assert rewind.end_s - rewind.start_s == pytest.approx(1.1 * taken.seconds + 3 * 1.0, abs=0.1), "no time for stops"
    assert (before.end_s, after.start_s) == (rewind.start_s, rewind.end_s)
    assert (before.turn, after.turn) == (-1, -2)
    assert rewind.from_az_deg <= 23.33
    assert all(
        abs(b[0] - a[0]) < 180.0
        for a, b in zip([(rewind.from_az_deg, 0.0), *rewind.waypoints], rewind.waypoints, strict=False)
    )
    (told,) = [one for one in plan.incidents if one.what == "rewind"]
    assert (told.at_s, told.text) == (rewind.start_s, "cable turns back, up to 9.6 s")
    assert any("turns back" in note for note in plan.notes)
    assert plan.reach.reasons == ("floor", "cable")
    assert [one.turn for one in plan.reach.intervals] == [-1, -2]
    assert sum(leg.end_s - leg.start_s for leg in (before, after)) == pytest.approx(plan.reach.total_s, abs=0.01)


def test_a_rewind_goes_through_the_keyhole_where_that_is_near():
    plan = plan_of(0.1, mount(travler(5.0)))
    (rewind,) = plan.rewinds
    assert rewind.start_s < plan.passing.tca.timestamp() < rewind.end_s
    assert abs(rewind.to_az_deg - rewind.from_az_deg) < 220.0
    assert plan.keyholes == ()


@pytest.mark.parametrize("aside_deg", [0.1, 0.7, 2.0])
def test_the_target_is_followed_as_soon_as_a_rewind_can_end(aside_deg):
    """The later a rewind ends the shorter it may be: no second is given away beyond what it may take at the most."""
    on = mount(travler(5.0))
    plan = plan_of(aside_deg, on)
    before, rewind, after = plan.legs
    assert after.start_s == pytest.approx(rewind.end_s, abs=0.01)
    here = plan.course.at(before.end_s)
    for sooner_s in (2.0, 6.0, 12.0):
        target = TargetTrack.of(plan.sky, on).at(after.start_s - sooner_s, after.turn)
        needed = route(PlanBounds.of(on), on.model, here, target)
        assert needed.worst_s > after.start_s - sooner_s - before.end_s


def test_above_the_ceiling_the_dish_stays_at_it_while_that_is_within_half_a_beam():
    narrow, wide = (plan_of(2.5, mount(tolerance_deg=tolerance)) for tolerance in (0.5, 4.0))
    top = wide.passing.max_elevation_deg
    assert 65.5 < top < 69.0
    assert len(narrow.legs) == 2
    assert len(wide.legs) == 1
    assert wide.course.el_deg.max() == pytest.approx(65.0, abs=1e-6)
    assert "ceiling" in wide.reach.reasons
    assert any(one.what == "unreach" and one.text == "above the 65° ceiling" for one in narrow.incidents)
    assert any("waits there while that is near enough: up to 0.5° off" in note for note in narrow.notes)


def test_a_mast_is_passed_above_and_only_when_there_is_time():
    clear = plan_of(4.0)
    t = clear.course.t_s
    az = float(np.interp(np.mean(t), t, clear.course.az_deg)) % 360.0
    masted = plan_of(4.0, mount(no_go=(NoGoSector(az - 8.0, az + 8.0, 62.0, "mast"),)))
    before, after = masted.legs
    assert "no-go: mast" in masted.reach.words()
    assert after.waypoints[0][1] > 62.0
    assert after.waypoints[0][0] == pytest.approx(before.to_az_deg, abs=1e-6)
    assert after.waypoints[-1] == pytest.approx(masted.course.at(after.start_s), abs=1e-6)


def test_what_a_mask_hides_is_told_and_followed_all_the_same():
    trees = HorizonMask([(100.0, 0.0), (100.0, 60.0), (160.0, 60.0), (160.0, 0.0)])
    plan, clear = plan_of(4.0, mount(horizon=trees)), plan_of(4.0, mount())
    assert "horizon" in plan.reach.reasons
    assert plan.reach.total_s < clear.reach.total_s
    assert any(
        "Behind the horizon mask for" in note and "the dish follows, nothing is heard." in note for note in plan.notes
    )
    assert [(leg.start_s, leg.end_s) for leg in plan.legs] == [(leg.start_s, leg.end_s) for leg in clear.legs]
    assert [one.text for one in plan.incidents] == [one.text for one in clear.incidents]
    assert any("╌ behind the horizon mask" in line for line in plan_lines(plan))


def test_the_cable_is_turned_back_while_nothing_is_heard():
    """The same pass across north, and trees where either turn would do."""
    orbit = {"inclination_deg": 51.6, "height_km": 420.0}
    clear = plan_of(-2.0, orbit=orbit)
    trees = HorizonMask([(309.5, 0.0), (310.0, 89.0), (330.0, 89.0), (330.5, 0.0)])
    hidden = plan_of(-2.0, mount(horizon=trees), orbit=orbit)
    before, after = (
        [plan.sky.at((leg.start_s + leg.end_s) / 2)[0] % 360.0 for leg in plan.rewinds] for plan in (clear, hidden)
    )
    assert not 310.0 < before[0] < 330.0
    assert 310.0 < after[0] < 330.0


def test_the_dish_leaves_in_time_and_by_stops_of_less_than_half_a_turn():
    plan = plan_of(4.0, mount(at=(20.0, 60.0)), preposition_s=60.0)
    place = plan.preposition
    points = [(20.0, 60.0), *place.waypoints]
    assert all(abs(b[0] - a[0]) < 180.0 for a, b in itertools.pairwise(points))
    assert place.waypoints[-1] == (place.az_deg, place.el_deg) == pytest.approx(plan.course.at(plan.legs[0].start_s))
    assert plan.legs[0].start_s - place.leave_s >= 60.0 + place.slew_s


def test_a_plan_made_in_mid_pass_begins_when_the_dish_can_be_there():
    target, passing = overhead(4.0)
    plan = plan_pass(target, PLACE, mount(travler(5.0), at=(300.0, 30.0)), passing.tca, passing=passing)
    assert plan.legs[0].start_s > passing.tca.timestamp() + 20.0
    assert plan.preposition.leave_s == passing.tca.timestamp()
    assert plan.sky.start_s == passing.aos.timestamp()


def test_a_satellite_that_comes_late_is_planned_late():
    early, late = plan_of(4.0), plan_of(4.0, time_offset_s=7.5)
    assert late.aim.time_offset_s == 7.5
    times = early.sky.t_s[100:-100:50]
    assert late.sky.sample(times + 7.5)[1] == pytest.approx(early.sky.sample(times)[1], abs=0.2)  # the Earth turns
    assert late.legs[0].start_s - early.legs[0].start_s == pytest.approx(7.5, abs=0.5)


def test_what_does_not_move_is_held():
    plan = plan_pass(Fixed("dish farm", 200.0, 40.0), PLACE, mount(), NOW, hours=2.0)
    (leg,) = plan.legs
    assert (leg.from_az_deg, leg.to_az_deg) == pytest.approx((-160.0, -160.0))
    assert leg.end_s == NOW_S + 7200.0
    assert plan.passing is None


def test_what_stays_below_the_floor_is_not_followed_and_the_plan_says_why():
    plan = plan_pass(Fixed("low", 200.0, 5.0), PLACE, mount(), NOW)
    assert (plan.course, plan.legs, plan.preposition, plan.forecast) == (None, (), None, None)
    assert any("18° floor" in note for note in plan.notes)


def test_decibels_are_told_at_the_frequency_asked_for_and_only_where_the_beam_is_known():
    on = replace(mount(), beam=Beam(2.75, 2.75, 12.0e9))
    at_12, at_6 = (plan_of(4.0, on, frequency_hz=hz).forecast for hz in (12.0e9, 6.0e9))
    assert at_12.loss_db.max() == pytest.approx(4.0 * at_6.loss_db.max())
    assert at_12.loss_db == pytest.approx(12.0 * (at_12.error_deg / 2.75) ** 2)
    assert plan_of(4.0, mount(beam_deg=None)).forecast.loss_db is None
