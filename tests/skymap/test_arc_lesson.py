"""How the base stands by the arc in a map: right where it is told, and refused where it can't be."""

from __future__ import annotations

from dataclasses import replace

import pytest
from birdcage.antenna.alignment import Alignment
from birdcage.base.config.sections import AlignmentSettings
from birdcage.base.geometry import shortest_turn
from birdcage.calibration.fit import fit
from birdcage.calibration.map_peaks import peaks_of_map
from birdcage.calibration.terms import priors_of
from birdcage.sky.observer import Observer
from birdcage.skymap.arc_lesson import teach_north
from birdcage.skymap.known_sources import arc_over
from birdcage.skymap.map_levels import LessonRefused
from birdcage.skymap.plan import MapFrame, MapPlan

from tests.skymap.arcs import KANSAS, ROTTERDAM, OwnArc, simulated_arc
from tests.skymap.suns import Travler

HERE = arc_over(Observer(*KANSAS.values()), "radio")
THERE = arc_over(Observer(*ROTTERDAM.values()), "radio")
EUROPE = {-5.0: 0.8, 4.8: 0.6, 13.0: 1.2, 16.0: 0.4, 19.2: 1.3, 23.5: 0.7, 28.2: 1.1, 36.0: 0.4, 42.0: 0.5}
"""Two of them are in no table of ours."""
SOUTH = MapPlan(120.0, 240.0, 8.0, 46.0, 1.5)
WITHIN_DEG = 0.2
NEAR_DEG = 40.0
"""All round takes four times as long: one test does it."""


def stands_within(alignment, turn_deg, north_deg, east_deg):
    """Return whether turn and lean are each told within 0.2 degrees."""
    off = (
        shortest_turn(turn_deg, alignment.az_offset_deg), alignment.an_deg - north_deg, alignment.aw_deg + east_deg,
    )  # fmt: skip
    return max(map(abs, off)) < WITHIN_DEG


@pytest.mark.parametrize(("north_deg", "east_deg"), [(1.2, -1.6), (2.0, 0.0), (-1.41, 1.41)])
def test_a_base_turned_by_7_and_tilted_by_2_degrees_is_proposed(north_deg, east_deg):
    found = teach_north(simulated_arc(7.0, north_deg, east_deg), HERE, within_deg=NEAR_DEG)
    assert stands_within(found.alignment, 7.0, north_deg, east_deg), found.alignment
    assert found.runner_up > 2.0
    peaks = peaks_of_map(found)
    assert len(peaks) >= 5
    assert {"119°W", "61.5°W", "110°W"} <= {each.seen.slot.label for each in found.slots}
    # Calibrate fits its own five terms to what it is handed, and comes to the same.
    fitted = fit(peaks, priors_of(AlignmentSettings(), peaks), Alignment())
    assert stands_within(fitted.alignment, 7.0, north_deg, east_deg), fitted.alignment


def test_the_narrow_beam_of_a_larger_dish_is_found_too():
    plan, beam = MapPlan(115.0, 235.0, 24.0, 54.0, 0.8), {"beam_az_deg": 2.3, "beam_el_deg": 3.3}
    found = teach_north(simulated_arc(7.0, 1.2, -1.6, plan, Travler, beam), HERE, within_deg=NEAR_DEG)
    assert stands_within(found.alignment, 7.0, 1.2, -1.6), found.alignment


def test_an_arc_by_other_formulae_is_told_the_same():
    found = teach_north(OwnArc(EUROPE, 7.0, 1.2, -1.6, 2.5).decibels(SOUTH), THERE, within_deg=NEAR_DEG)
    assert stands_within(found.alignment, 7.0, 1.2, -1.6), found.alignment


def test_any_turn_of_the_base_is_found():
    found = teach_north(simulated_arc(170.0, 1.0, 1.0, MapPlan(280.0, 430.0, 18.0, 60.0, 2.0)), HERE)
    assert stands_within(found.alignment, 170.0, 1.0, 1.0), found.alignment


def test_turn_and_lean_are_as_sure_across_the_north_of_the_dish():
    sky_map = OwnArc(EUROPE, 7.0, 1.2, -1.6, 2.5).decibels(SOUTH)
    ahead = teach_north(sky_map, THERE, within_deg=12.0)
    behind = teach_north(replace(sky_map, about={**sky_map.about, "az_offset_deg": 180.0}), THERE, within_deg=12.0)
    assert shortest_turn(ahead.alignment.az_offset_deg, behind.alignment.az_offset_deg) == pytest.approx(-180.0)
    assert behind.sigmas_deg == pytest.approx(ahead.sigmas_deg, rel=0.01)


def test_an_alignment_in_use_is_taken_off_first():
    sky_map = simulated_arc(7.0, 1.2, -1.6)
    used = Alignment(5.0, 0.0, 0.0, 1.0, 0.0)
    moved = tuple(
        replace(each, az_deg=az, el_deg=el)
        for each in sky_map.samples
        for az, el in [used.to_true(each.az_deg, each.el_deg)]
    )
    about = {**sky_map.about, "az_offset_deg": 5.0, "el_offset_deg": 0.0, "ca_deg": 0.0, "an_deg": 1.0, "aw_deg": 0.0}
    found = teach_north(replace(sky_map, about=about, samples=moved), HERE, within_deg=NEAR_DEG)
    assert stands_within(found.alignment, 7.0, 1.2, -1.6), found.alignment


@pytest.mark.parametrize("beside_deg", [0.0, 0.04])
def test_trees_below_the_arc_do_not_turn_it(beside_deg):
    sky_map = simulated_arc(7.0, 1.2, -1.6, trees="100:20,150:30,180:28,260:25")
    # A dish rests a little beside where it was sent.
    samples = tuple(replace(each, az_deg=each.az_deg + beside_deg) for each in sky_map.samples)
    found = teach_north(sky_map.with_samples(samples), HERE, within_deg=NEAR_DEG)
    assert stands_within(found.alignment, 7.0, 1.2, -1.6), found.alignment
    assert found.explained > 0.88, "with the trees left in it is 0.85: no satellite explains them"


@pytest.mark.parametrize(
    ("sent", "why"),
    [
        ({}, "0 satellites stand out"),
        ({13.0: 1.0, 28.2: 1.0}, "2 satellites stand out"),
        ({15.4: 1.0, 22.2: 1.1, 31.5: 1.0}, "do not stand where known slots do|stand in two ways"),
    ],
)
def test_too_few_satellites_and_strange_ones_are_refused(sent, why):
    with pytest.raises(LessonRefused, match=why):
        teach_north(OwnArc(sent, 7.0, 2.0, 0.0, 3.0).decibels(SOUTH), THERE, within_deg=NEAR_DEG)


def test_two_ways_to_stand_that_fit_about_equally_well_are_refused():
    with pytest.raises(LessonRefused, match="two ways that fit"):
        teach_north(simulated_arc(7.0, 1.2, -1.6, MapPlan(180.0, 225.0, 18.0, 60.0, 1.5)), HERE, within_deg=NEAR_DEG)


def test_maps_that_can_not_tell_north_say_why():
    sky_map = simulated_arc(0.0, 0.0, 0.0, MapPlan(180.0, 200.0, 40.0, 46.0, 2.0))
    with pytest.raises(LessonRefused, match="around Moon"):
        teach_north(replace(sky_map, plan=replace(sky_map.plan, frame=MapFrame.TARGET), about={"target": "Moon"}), HERE)
    with pytest.raises(LessonRefused, match="2 known slots"):
        teach_north(sky_map, HERE[:2])
    with pytest.raises(LessonRefused, match="directions above the trees are too few"):
        teach_north(sky_map, HERE)
