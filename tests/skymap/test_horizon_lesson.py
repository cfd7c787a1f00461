"""What a map tells of trees and roofs, and what it must not take for them."""

import math
import random
from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.base.beam import Beam
from birdcage.signal.slots_heard import seen_from
from birdcage.sim.settings import SimSettings
from birdcage.sim.sky import SimSky
from birdcage.sim.trees import TreeLine
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.observer import Observer
from birdcage.skymap.horizon_accepted import chosen_by, with_accepted
from birdcage.skymap.horizon_lesson import HorizonEdge, teach_horizon
from birdcage.skymap.map_levels import LessonRefused
from birdcage.skymap.plan import MapFrame, MapPlan

from tests.skymap.made import made_map

NIGHT = datetime(2026, 3, 20, 6, tzinfo=UTC)
TREES = "150:18,160:26,175:30,190:24,205:32,206:10"
PLAN = MapPlan(120.0, 240.0, 10.0, 60.0, 1.0)
KNOWN = {"beam_az_deg": 6.4, "beam_el_deg": 6.3}
PLACE = Observer(39.1, -95.7)
ARC = tuple((seen.az_deg, seen.el_deg) for seen in seen_from(PLACE, "radio"))


def counts(trees, plan=PLAN, **other):
    sky, dice = SimSky(SimSettings(trees=trees)), random.Random(1)
    return made_map(plan, lambda az, el: sky.level(NIGHT, az, el) + dice.gauss(0.0, 0.5), about=KNOWN, **other)


def decibels(trees, plan=PLAN):
    sky, dice = SimSky(SimSettings(trees=trees)), random.Random(1)
    return made_map(
        plan, lambda az, el: 10.0 * math.log10(1.0 + sky.warmth(NIGHT, az, el)) - 60.0 + dice.gauss(0.0, 0.1),
        about=KNOWN, decibels=True, unit="dB",
    )  # fmt: skip


@pytest.mark.parametrize(("heard", "within"), [(counts, 1.3), (decibels, 1.0)])
def test_a_planted_tree_line_is_proposed_in_front_of_the_arc(heard, within):
    line = TreeLine(TREES)
    found = teach_horizon(heard(TREES), ARC)
    inside = [edge for edge in found.edges if 153.0 <= edge.az_deg <= 202.0]
    assert len(inside) == 50
    assert [edge.az_deg for edge in inside if abs(edge.el_deg - line.at(edge.az_deg)) > within] == []
    assert not any(edge.is_clear for edge in inside)
    assert all(edge.is_clear for edge in found.edges if not 147.0 <= edge.az_deg <= 209.0)
    assert 8 <= len(found.points) <= 20
    proposed = HorizonMask((edge.az_deg, edge.el_deg) for edge in found.points)
    assert max(abs(proposed.at(edge.az_deg) - edge.el_deg) for edge in inside) < 1.0


def test_a_satellite_right_above_the_trees_lifts_no_tree():
    # 61.5 W stands at 132.8/32.6, and its glow reaches down into the trees: there the map says nothing.
    found = teach_horizon(counts("110:27,160:27"), ARC)
    told = {edge.az_deg: edge.el_deg for edge in found.edges if not edge.is_clear}
    assert [az for az in told if az < 157.0 and abs(told[az] - 27.0) > 1.2] == []
    assert not any(128.0 < az < 138.0 for az in told)
    assert all(float(az) in told for az in range(147, 157))


def test_a_few_trees_in_a_wide_map_are_found():
    found = teach_horizon(counts("160:22,176:22"), ARC)
    told = {edge.az_deg: edge.el_deg for edge in found.edges if not edge.is_clear}
    assert [az for az in range(163, 174) if abs(told[float(az)] - 22.0) > 1.2] == []


def test_beyond_the_trees_the_sky_hides_no_satellite():
    sky = SimSky(SimSettings(trees="205:50,225:50"))
    open_sky = SimSky(SimSettings())
    (az_deg, el_deg), counts_alone = open_sky.slots[8]
    assert counts_alone == 145.0
    assert open_sky.level(NIGHT, az_deg, el_deg) - sky.level(NIGHT, az_deg, el_deg) > 60.0
    assert sky.level(NIGHT, 120.0, 40.0) == open_sky.level(NIGHT, 120.0, 40.0)


def test_satellites_over_a_clear_horizon_are_no_trees():
    low = MapPlan(120.0, 240.0, 33.0, 60.0, 1.0)
    with pytest.raises(LessonRefused, match="No trees stand out"):
        teach_horizon(counts("", low), ARC)


@pytest.mark.parametrize("lowest", [5.0, 10.0, 18.0])
def test_air_that_grows_thicker_toward_the_horizon_is_no_tree(lowest):
    plan, dice = MapPlan(0.0, 40.0, lowest, 60.0, 1.0), random.Random(2)
    air = made_map(plan, lambda _az, el: 400.0 + 6.0 / math.sin(math.radians(el)) + dice.gauss(0.0, 0.5), about=KNOWN)
    with pytest.raises(LessonRefused, match="No trees stand out"):
        teach_horizon(air)


def test_a_line_of_trees_in_thick_air_lies_where_it_lies():
    plan, dice = MapPlan(0.0, 20.0, 10.0, 60.0, 1.0), random.Random(3)

    def level(_az, el):
        trees = 0.5 - 0.5 * math.erf((el - 22.0) / 2.675 / math.sqrt(2.0))
        air = 1.0 - math.exp(-0.03 / math.sin(math.radians(el)))
        return 10.0 * math.log10(100.0 + 280.0 * (trees + (1.0 - trees) * air)) + dice.gauss(0.0, 0.05)

    found = teach_horizon(made_map(plan, level, about=KNOWN, decibels=True))
    assert all(edge.el_deg == pytest.approx(22.0, abs=0.4) for edge in found.edges)


def test_what_was_not_heard_says_nothing():
    whole = counts(TREES)
    cells = [sample for sample in whole.samples if not 160.0 <= sample.az_deg <= 165.0 or sample.el_deg > 40.0]
    low = [sample for sample in cells if not (sample.az_deg == 180.0 and 15.0 < sample.el_deg < 35.0)]
    found = teach_horizon(whole.with_samples(tuple(low)), ARC)
    told = {edge.az_deg: edge for edge in found.edges}
    # Of 160 to 165 only that no tree reaches to 41; of 180 nothing: the line lies in its gap.
    assert all(told[float(az)].is_clear and told[float(az)].el_deg == 41.0 for az in range(160, 166))
    assert 180.0 not in told
    assert found.unknown == teach_horizon(whole, ARC).unknown + 1


def test_maps_that_tell_no_trees_say_why():
    around = replace(counts(TREES), plan=replace(PLAN, frame=MapFrame.TARGET), about={"target": "Sun"})
    with pytest.raises(LessonRefused, match="around Sun"):
        teach_horizon(around)
    with pytest.raises(LessonRefused, match="beam is not known"):
        teach_horizon(replace(counts(TREES), about={}))
    with pytest.raises(LessonRefused, match="Nothing was heard"):
        teach_horizon(counts(TREES).with_samples(()))
    assert teach_horizon(replace(counts(TREES), about={}), ARC, Beam(6.4, 6.3)).points


LINE = tuple(HorizonEdge(az, el, 0.3, is_clear=False) for az, el in ((150.0, 18.0), (160.0, 26.0), (170.0, 20.0)))


def test_a_flat_horizon_stays_flat_beside_what_was_accepted():
    mask = with_accepted(HorizonMask(), LINE, [0, 1, 2])
    assert [mask.at(az) for az in (140.0, 149.0, 150.0, 155.0, 160.0, 165.0, 171.0, 180.0, 0.0)] == [
        0.0, 0.0, 18.0, 22.0, 26.0, 23.0, 0.0, 0.0, 0.0,
    ]  # fmt: skip


def test_a_point_that_was_not_accepted_leaves_the_mask_there_as_it_was():
    before = HorizonMask([(0.0, 5.0), (155.0, 7.0), (158.0, 9.0), (250.0, 12.0)])
    mask = with_accepted(before, LINE, [0, 2])
    assert (mask.at(150.0), mask.at(170.0)) == (18.0, 20.0)
    assert all(mask.at(az) == pytest.approx(before.at(az)) for az in (0.0, 100.0, 149.0, 151.0, 155.0, 160.0, 168.0))
    assert with_accepted(before, LINE, [0, 1]).at(158.0) == pytest.approx(24.4)


def test_a_clear_azimuth_lowers_the_mask_and_never_raises_it():
    clear = (HorizonEdge(100.0, 18.0, 0.3, is_clear=True), HorizonEdge(110.0, 18.0, 0.3, is_clear=True))
    assert with_accepted(HorizonMask(), clear, [0, 1]).at(105.0) == 0.0
    high = HorizonMask([(90.0, 30.0), (120.0, 30.0)])
    assert with_accepted(high, clear, [0, 1]).at(105.0) == 18.0
    assert with_accepted(high, clear, []) == high


def test_points_are_chosen_by_azimuth():
    assert chosen_by(LINE, [160.4, -190.0]) == [1, 2]
    with pytest.raises(LookupError, match="within 1° of 155°"):
        chosen_by(LINE, [155.0])


@pytest.mark.parametrize("text", ["150", "150:5", "a:b,c:d", "150:5,160:85", "10:5,350:5,20:5"])
def test_the_simulator_refuses_what_is_no_line_of_trees(text):
    with pytest.raises(ValueError, match="trees="):
        TreeLine(text)


def test_a_line_of_trees_may_go_through_north():
    line = TreeLine("350:10,10:20")
    assert (line.at(0.0), line.at(355.0), line.at(20.0)) == (15.0, 12.5, -90.0)


def clear(*points):
    return tuple(HorizonEdge(az, el, 0.3, is_clear=True) for az, el in points)


def test_a_clear_stretch_keeps_what_lies_below_its_line_and_lowers_what_lies_above():
    ends = clear((100.0, 18.0), (110.0, 18.0))
    dip = HorizonMask([(90.0, 10.0), (100.0, 10.0), (105.0, 0.0), (110.0, 10.0), (120.0, 10.0)])
    assert [with_accepted(dip, ends, [0, 1]).at(az) for az in (100.0, 102.5, 105.0, 110.0)] == [10.0, 5.0, 0.0, 10.0]
    roof = HorizonMask([(90.0, 0.0), (100.0, 0.0), (105.0, 40.0), (110.0, 0.0), (120.0, 0.0)])
    after = with_accepted(roof, ends, [0, 1])
    assert [after.at(az) for az in (100.0, 101.0, 103.0, 105.0, 107.0, 109.0)] == pytest.approx([0, 8, 18, 18, 18, 8])
    one = HorizonMask([(105.0, 12.0)])
    assert with_accepted(one, ends, [0, 1]).at(105.0) == 0.0, "one point alone says nothing of the sky"


@pytest.mark.parametrize("last_deg", [359.0, 359.8, 357.5])
def test_a_map_all_round_replaces_the_whole_mask(last_deg):
    old = HorizonMask([(0.5, 70.0), (90.0, 70.0), (180.0, 70.0), (359.0, 70.0), (359.9, 70.0)])
    azimuths = (0.0, 120.0, 240.0, last_deg)
    edges = tuple(HorizonEdge(az, 20.0, 0.3, is_clear=False) for az in azimuths)
    after = with_accepted(old, edges, range(4))
    assert after.points == tuple((az, 20.0) for az in azimuths)
    # Without the point at 120 the mask between its neighbours stays, and beside them.
    part = with_accepted(old, edges, [0, 2, 3])
    assert [part.at(az) for az in (0.0, 1.0, 120.0, 239.0, 240.0, 300.0, last_deg)] == pytest.approx(
        [20.0, 70.0, 70.0, 70.0, 20.0, 20.0, 20.0]
    )
    assert part.at((last_deg + 360.0) / 2.0) == 20.0


def test_both_ends_of_a_whole_turn_are_one_azimuth():
    plan = MapPlan(0.0, 360.0, 10.0, 60.0, 3.0)
    found = teach_horizon(counts("340:20,20:20", plan), ARC)
    azimuths = [edge.az_deg for edge in found.edges]
    assert len(set(azimuths)) == len(azimuths) <= 120
    assert min(azimuths) == 0.0
    assert found.unknown == 120 - len(azimuths)


def test_an_azimuth_just_below_north_is_0_and_not_360():
    found = teach_horizon(counts("340:20,20:20", MapPlan(-30.0 - 1e-10, 30.0, 10.0, 60.0, 1.0)), ARC)
    assert 0.0 in {edge.az_deg for edge in found.edges}
    assert max(edge.az_deg for edge in found.edges) < 360.0


def test_rows_that_are_closer_than_columns_tell_the_same_line():
    line = TreeLine(TREES)
    found = teach_horizon(counts(TREES, replace(PLAN, step_deg=2.0, y_step_deg=1.0)), ARC)
    inside = [edge for edge in found.edges if 153.0 <= edge.az_deg <= 202.0]
    assert len(inside) > 20
    assert [edge.az_deg for edge in inside if abs(edge.el_deg - line.at(edge.az_deg)) > 1.5] == []


def test_an_unknown_source_lifts_no_tree_where_rows_are_closer_than_columns():
    dice = random.Random(4)

    def level(az, el):
        trees = (0.5 - 0.5 * math.erf((el - 22.0) / 2.675 / math.sqrt(2.0))) * (150.0 <= az <= 190.0)
        off = math.hypot((az - 170.0) * math.cos(math.radians(28.0)) / 6.4, (el - 28.0) / 6.3)
        return 10.0 * math.log10(100.0 + 280.0 * (trees + 2.0 * 0.5 ** (4.0 * off**2))) + dice.gauss(0.0, 0.05)

    plan = replace(PLAN, step_deg=2.0, y_step_deg=1.0)
    found = teach_horizon(made_map(plan, level, about=KNOWN, decibels=True, unit="dB"))
    heights = [edge.el_deg for edge in found.edges if not edge.is_clear]
    assert len(heights) >= 6
    assert heights == pytest.approx([22.0] * len(heights), abs=0.5)


@pytest.mark.parametrize("typed", [math.nan, math.inf, -math.inf])
def test_what_is_no_angle_chooses_no_point(typed):
    with pytest.raises(LookupError, match="is no azimuth"):
        chosen_by(LINE, [150.0, typed])
