"""Look angles against figures worked out another way."""

import math

import pytest
from birdcage.sky.geostationary import SLOTS, arc, look_angle, slots_in_sight
from hypothesis import given
from hypothesis import strategies as st


def test_under_the_satellite_it_stands_overhead():
    assert look_angle(0.0, 13.0, 13.0)[1] == pytest.approx(90.0)


def test_on_its_own_meridian_it_stands_south_or_north():
    assert look_angle(50.0, 10.0, 10.0)[0] == pytest.approx(180.0)
    assert look_angle(-33.0, 151.0, 151.0)[0] == pytest.approx(0.0, abs=1e-9)


def test_the_equators_horizon_is_at_81_degrees():
    edge = math.degrees(math.acos(6378.137 / 42164.17))
    assert look_angle(0.0, 0.0, edge)[1] == pytest.approx(0.0, abs=1e-9)
    assert look_angle(0.0, 0.0, edge)[0] == pytest.approx(90.0)


def test_elevation_on_the_meridian_from_plane_geometry():
    # At 45 N the ellipsoid's point lies at rho cos phi', rho sin phi' = 4517.590879, 4487.348409 km (WGS84).
    x, z = 4517.590879, 4487.348409
    up = math.radians(45.0)
    dx, dz = 42164.17 - x, -z
    el = math.degrees(math.asin((dx * math.cos(up) + dz * math.sin(up)) / math.hypot(dx, dz)))
    assert look_angle(45.0, 0.0, 0.0)[1] == pytest.approx(el, abs=1e-6)


def test_east_and_west_mirror_each_other():
    east, west = look_angle(40.0, 0.0, 25.0), look_angle(40.0, 0.0, -25.0)
    assert east[0] == pytest.approx(360.0 - west[0])
    assert east[0] < 180.0
    assert east[1] == pytest.approx(west[1])


@given(st.floats(-90, 90), st.floats(-720, 720), st.floats(-720, 720))
def test_whole_turns_do_not_matter(lat, lon, slot):
    az, el = look_angle(lat, lon, slot)
    assert 0.0 <= az < 360.0
    assert -90.0 <= el <= 90.0
    assert look_angle(lat, lon + 360.0, slot)[1] == pytest.approx(el, abs=1e-9)


@pytest.mark.parametrize("place", [(91.0, 0.0, 0.0), (math.nan, 0.0, 0.0), (0.0, math.inf, 0.0)])
def test_no_place_on_earth_is_refused(place):
    with pytest.raises(ValueError, match="no place"):
        look_angle(*place)


def test_the_arc_is_what_stands_above_the_limit_in_order():
    points = arc(40.0, -95.0, 1.0, 10.0)
    assert points
    assert all(el >= 10.0 for _, _, el in points)
    azimuths = [az for _, az, _ in points]
    assert azimuths == sorted(azimuths, reverse=True)
    assert arc(89.0, 0.0) == []
    with pytest.raises(ValueError, match="step"):
        arc(40.0, 0.0, 0.0)


def test_slots_in_sight_are_within_their_limits():
    found = slots_in_sight(39.1, -95.7, 18.0, 65.0)
    assert {slot.label for slot, _, _ in found} >= {"101°W", "119°W", "61.5°W"}
    assert "19.2°E" not in {slot.label for slot, _, _ in found}
    assert all(18.0 <= el <= 65.0 for _, _, el in found)
    assert len({slot.longitude_deg for slot in SLOTS}) == len(SLOTS)
