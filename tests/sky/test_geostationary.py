"""Look angles against figures worked out another way."""

import math

import pytest
from birdcage.sky.geostationary import arc, look_angle, look_at_slot, slots_in_sight
from birdcage.sky.observer import Observer
from birdcage.sky.slots import slots
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


def test_the_table_holds_what_these_dishes_were_sold_for_and_what_amateurs_look_for():
    def used_by(network):
        return {slot.longitude_deg for slot in slots() if network in slot.networks}

    assert used_by("DISH") >= {-61.5, -110.0, -119.0, -129.0}
    assert used_by("Bell") == {-82.0, -91.0}
    assert used_by("DIRECTV") == {-99.2, -101.0, -103.0, -119.0}, "119°W carries both"
    assert {slot.longitude_deg: slot.polarization for slot in slots()}[-101.0] == "circular"
    by_name = {slot.name: slot for slot in slots()}
    assert by_name["QO-100"].label == "25.9°E"
    assert {"GOES 18", "GOES 19"} <= by_name.keys()
    longitudes = [slot.longitude_deg for slot in slots()]
    assert longitudes == sorted(set(longitudes), key=lambda east: (east + 180) % 360)


def test_other_bands_are_listed_only_when_asked_for():
    default = {slot.name for slot, _, _ in slots_in_sight(39.1, -95.7)}
    everything = {slot.name for slot, _, _ in slots_in_sight(39.1, -95.7, band=None)}
    assert "GOES 19" not in default
    assert {"GOES 19", "GOES 18"} <= everything - default


# Computed another way, outside this repository; the skew in its exact form.
VECTORS = [
    ("Vienna", 48.20, 16.40, 13.0, 184.56, 34.59, 3.06),
    ("Vienna", 48.20, 16.40, 19.2, 176.24, 34.62, -2.52),
    ("Vienna", 48.20, 16.40, 28.2, 164.33, 33.51, -10.44),
    ("Vienna", 48.20, 16.40, -30.0, 234.66, 19.17, 33.19),
    ("London", 51.50, -0.10, 25.9, 148.05, 26.25, -19.39),
    ("London", 51.50, -0.10, 28.2, 145.45, 25.41, -20.84),
    ("London", 51.50, -0.10, -30.0, 216.33, 24.79, 21.82),
    ("Austin", 30.27, -97.74, -61.5, 124.49, 37.25, -45.58),
    ("Austin", 30.27, -97.74, -99.2, 182.90, 54.71, 2.51),
    ("Recife", -8.05, -34.90, 25.9, 85.53, 20.75, 80.9),
    ("Sydney", -33.87, 151.21, 156.0, 8.56, 50.32, 7.12),
]


@pytest.mark.parametrize(("where", "lat", "lon", "slot", "az", "el", "skew"), VECTORS)
def test_azimuth_elevation_and_skew_of_the_reference(where, lat, lon, slot, az, el, skew):
    seen = look_at_slot(Observer(lat, lon), slot)
    assert seen.az_deg == pytest.approx(az, abs=0.02)
    assert seen.el_deg == pytest.approx(el, abs=0.04), "printed from a spherical Earth, which is 0.03 degrees off"
    assert seen.skew_deg == pytest.approx(skew, abs=0.06)
    assert (seen.az_deg, seen.el_deg) == pytest.approx(look_angle(lat, lon, slot))


# As the textbooks print them, for a spherical Earth, which is up to 0.04 degrees and 15 km off.
PUBLISHED = [
    ("Roddy, examples 3.1 and 3.2", 35.0, -100.0, -90.0, 162.9, 0.05, 48.0, 0.5, 37215.0, 15.0),
    ("Pratt and Bostian, London", 52.0, 0.0, 66.0, 109.333, 0.04, 5.847, 0.04, None, None),
    ("tutorialsweb, elevation misprinted there", -20.0, -30.0, 30.0, 78.83, 0.04, 19.84, 0.04, 39571.0, 15.0),
]


@pytest.mark.parametrize(("book", "lat", "lon", "slot", "az", "daz", "el", "de", "far", "dfar"), PUBLISHED)
def test_published_look_angles(book, lat, lon, slot, az, daz, el, de, far, dfar):
    seen = look_at_slot(Observer(lat, lon), slot)
    assert seen.az_deg == pytest.approx(az, abs=daz)
    assert seen.el_deg == pytest.approx(el, abs=de)
    if far is not None:
        assert seen.range_km == pytest.approx(far, abs=dfar)


@pytest.mark.parametrize(("lat", "turn"), [(0.0, 81.30), (30.0, 79.9), (45.0, 77.7), (60.0, 72.4)])
def test_how_far_along_the_arc_one_sees(lat, turn):
    assert look_at_slot(Observer(lat, 0.0), turn - 0.2).visible
    assert not look_at_slot(Observer(lat, 0.0), turn + 0.2).visible


def test_nothing_of_the_arc_is_seen_near_the_poles():
    assert not any(look_at_slot(Observer(81.5, 0.0), slot).visible for slot in range(-180, 180, 5))


@given(st.floats(-80, 80), st.floats(-180, 180), st.floats(-60, 60))
def test_the_skew_is_what_the_usual_formula_says_within_its_error(lat, lon, turn):
    seen = look_at_slot(Observer(lat, lon), lon + turn)
    usual = math.degrees(math.atan2(-math.sin(math.radians(turn)), math.tan(math.radians(lat))))
    if abs(lat) > 5.0 and seen.visible:
        apart = (seen.skew_deg - usual + 90.0) % 180.0 - 90.0
        assert abs(apart) < 1.0


def test_in_the_zenith_there_is_a_skew_all_the_same():
    assert look_at_slot(Observer(0.0, 25.9), 25.9).skew_deg == 0.0
    assert look_at_slot(Observer(0.0, 25.9, 1000.0), 25.9).range_km == pytest.approx(42164.17 - 6379.137)
