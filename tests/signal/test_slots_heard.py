"""Which satellites are heard beside which, and which one was found."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.base.config import FeedProfile
from birdcage.signal.acquired import acquired
from birdcage.signal.slots_heard import apart_deg, patterns_near, seen_from, slot_typed, slots_found
from birdcage.sky.observer import Observer
from birdcage.station.state import Pointing

KANSAS = Observer(39.1, -95.7, 250.0)
SEEN = seen_from(KANSAS, "radio")
WIDTH_DEG = 6.0


def seen(label):
    found = slot_typed(label, SEEN)
    assert found is not None
    return found


def labels(found):
    return [each.slot.label for each in found]


def test_only_what_is_up_and_in_use_is_heard():
    assert {"61.5°W", "72.7°W", "119°W"} <= set(labels(SEEN))
    assert not {"19.2°E", "129°W"} & set(labels(SEEN))


@pytest.mark.parametrize("typed", ["119W", "119°w", " 119 W ", "61,5W"])
def test_a_longitude_is_read_as_people_type_it(typed):
    assert slot_typed(typed, SEEN) is not None


@pytest.mark.parametrize("typed", ["", "119", "19.2E", "DISH", "W119"])
def test_what_is_none_of_them_is_none(typed):
    assert slot_typed(typed, SEEN) is None


def test_beside_a_slot_stand_those_within_three_beams():
    one = seen("72.7W")
    (row,) = patterns_near(one.az_deg, one.el_deg, SEEN, WIDTH_DEG)
    beside = list(zip(row[::2], row[1::2], strict=True))
    assert beside[0] == pytest.approx(one.off(seen("77W")))
    assert all(across**2 + up**2 < (3.2 * WIDTH_DEG) ** 2 for across, up in beside)


def test_a_direction_near_several_may_be_any_of_them_or_none():
    one = seen("72.7W")
    rows = patterns_near(one.az_deg + 1.0, one.el_deg, SEEN, WIDTH_DEG)
    assert rows[0] == ()
    assert len(rows) >= 3


def test_how_far_the_nearest_neighbour_is():
    assert apart_deg(seen("72.7W"), SEEN) < 5.5 < 10.0 < apart_deg(seen("61.5W"), SEEN)
    assert apart_deg(seen("119W"), [seen("119W")]) == 180.0


def test_far_from_the_arc_there_is_no_pattern():
    assert patterns_near(10.0, 60.0, SEEN, WIDTH_DEG) == ((),)
    assert patterns_near(200.0, 40.0, (), WIDTH_DEG) == ((),)


def test_elevation_and_network_tell_which_it_may_be():
    one = seen("119W")
    assert labels(slots_found(one.az_deg + 9.0, one.el_deg, SEEN, 15.0))[0] == "119°W"
    assert set(labels(slots_found(one.az_deg, one.el_deg, SEEN, 15.0, "0x1004"))) <= {"110°W", "119°W"}
    assert slots_found(one.az_deg, one.el_deg + 9.0, SEEN, 15.0) == ()


@pytest.mark.parametrize("network", ["none", "", "0x7777", "garbage"])
def test_a_network_that_is_not_known_leaves_nobody_out(network):
    one = seen("101W")
    assert slots_found(one.az_deg, one.el_deg, SEEN, 15.0, network) == slots_found(one.az_deg, one.el_deg, SEEN, 15.0)


def test_the_offsets_make_it_the_satellite_though_the_dish_rests_beside_it():
    one = seen("119W")
    found = {"az_deg": 200.0, "el_deg": 41.0, "sigma_deg": 0.05, "rise": 150.0, "network": "0x1004"}
    # The alignment in force adds 10 and -1; the dish rests a little left of the middle, and below it.
    resting = Pointing(199.9, 40.9, 189.9, 41.9, 0.0, datetime(2026, 11, 24, tzinfo=UTC))
    what = acquired(found, resting, SEEN, 20.0)
    az_deg, el_deg = what.offsets(one, FeedProfile(az_offset_deg=2.0, el_offset_deg=0.5))
    assert (190.0 + az_deg + 2.0) % 360.0 == pytest.approx(one.az_deg, abs=0.01)
    assert 42.0 + el_deg + 0.5 == pytest.approx(one.el_deg, abs=0.01)
    assert what.heard == "150 over the floor, network 0x1004"
