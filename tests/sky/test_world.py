"""What a map of the world shows, against Skyfield: points under satellites, from where they are seen, day and night."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from birdcage.sky.coastline import coastline
from birdcage.sky.elements import ElementSet
from birdcage.sky.footprint import footprint, radius_km
from birdcage.sky.frames import posix_s
from birdcage.sky.ground_track import ground_track, orbit_track, sub_points
from birdcage.sky.look_down import Mapped, world_view
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import satrec
from birdcage.sky.terminator import SubSolar, sub_solar

NOW = datetime(2026, 3, 20, 15, 30, tzinfo=UTC)
HERE = Observer(52.1, 5.2)
POLAR = ElementSet("POLAR", 1, NOW, 98.6, 40.0, 0.001, 90.0, 10.0, 14.2)
STATION = ElementSet("STATION", 2, NOW, 51.6, 140.0, 0.0005, 30.0, 200.0, 15.5)
OVER_POLES = ElementSet("OVER POLES", 3, NOW, 90.0, 0.0, 0.001, 0.0, 90.0, 14.0)
MOLNIYA = ElementSet("MOLNIYA", 4, NOW, 63.4, 250.0, 0.72, 270.0, 0.0, 2.006)
STILL = ElementSet("STILL", 5, NOW, 0.05, 0.0, 0.0002, 0.0, 100.0, 1.0027)
ALL = (POLAR, STATION, OVER_POLES, MOLNIYA, STILL)


@pytest.fixture(scope="module")
def timescale():
    """Skyfield's own, with its own table of the turning Earth."""
    from skyfield.api import load

    return load.timescale(builtin=True)


def by_skyfield(elements, timescale):
    from skyfield.api import EarthSatellite

    return EarthSatellite.from_satrec(satrec(elements), timescale)


@pytest.mark.parametrize("elements", ALL, ids=lambda one: one.name)
def test_the_point_under_a_satellite_is_that_of_skyfield(elements, timescale) -> None:
    from skyfield.api import wgs84

    times = posix_s(NOW) + np.arange(0.0, 86400.0, 421.0)
    ours = ground_track(elements, times)
    moments = timescale.from_datetimes([NOW + timedelta(seconds=t - times[0]) for t in times.tolist()])
    under = wgs84.geographic_position_of(by_skyfield(elements, timescale).at(moments))
    assert np.abs(ours.latitude_deg - under.latitude.degrees).max() < 0.01
    turn = (ours.longitude_deg - under.longitude.degrees + 180.0) % 360.0 - 180.0
    assert np.abs(turn * np.cos(np.radians(ours.latitude_deg))).max() < 0.01
    assert np.abs(ours.altitude_km - under.elevation.km).max() < 0.1


def test_a_point_over_a_pole_has_a_height() -> None:
    above = sub_points([posix_s(NOW)], np.array([[0.0, 0.0, 7000.0]]))
    assert above.latitude_deg[0] == pytest.approx(90.0)
    assert above.altitude_km[0] == pytest.approx(7000.0 - 6356.752314245)


@pytest.mark.parametrize("elements", ALL, ids=lambda one: one.name)
def test_from_the_ring_the_satellite_is_seen_in_the_horizon(elements, timescale) -> None:
    from skyfield.api import wgs84

    seen = world_view(NOW, HERE, Mapped(elements))
    assert len(seen.footprint) > 100
    assert seen.footprint[0] == pytest.approx(seen.footprint[-1])
    satellite, moment = by_skyfield(elements, timescale), timescale.from_datetime(NOW)
    for latitude_deg, longitude_deg in seen.footprint[::12]:
        assert -180.0 <= longitude_deg < 180.0
        elevation = (satellite - wgs84.latlon(latitude_deg, longitude_deg)).at(moment).altaz()[0].degrees
        assert abs(elevation) < 0.01


def test_the_ring_is_as_far_as_is_said_and_what_is_under_ground_is_not_seen() -> None:
    ring = footprint(0.0, 10.0, 800.0)
    north = max(latitude for latitude, _ in ring)
    assert math.radians(north) * 6371.0 == pytest.approx(radius_km(800.0), rel=0.01)
    assert footprint(0.0, 10.0, 0.0) == footprint(0.0, 10.0, -20.0) == ()
    assert radius_km(-20.0) == 0.0


@pytest.mark.parametrize("month", range(1, 13))
def test_along_the_terminator_the_sun_stands_in_the_horizon(month, timescale) -> None:
    from importlib.resources import files

    from skyfield.api import load_file, wgs84

    kernel = load_file(str(files("birdcage.sky") / "data" / "de421_2020_2053.bsp"))
    when = datetime(2026, month, 20, (7 * month) % 24, 13, tzinfo=UTC)
    overhead, moment = sub_solar(when), timescale.from_datetime(when)

    def elevation(latitude_deg, longitude_deg):
        place = kernel["earth"] + wgs84.latlon(latitude_deg, longitude_deg)
        return place.at(moment).observe(kernel["sun"]).apparent().altaz()[0].degrees

    for longitude_deg in range(-180, 180, 30):
        latitude_deg = overhead.terminator_deg(longitude_deg)
        assert -90.0 <= latitude_deg <= 90.0
        assert abs(elevation(latitude_deg, longitude_deg)) < 0.1
        assert overhead.elevation_deg(20.0, longitude_deg) == pytest.approx(elevation(20.0, longitude_deg), abs=0.1)
    assert elevation(overhead.latitude_deg, overhead.longitude_deg) > 89.9
    kernel.close()


def test_at_an_equinox_the_terminator_runs_from_pole_to_pole() -> None:
    assert SubSolar(0.0, 0.0).terminator_deg(10.0) == pytest.approx(-90.0)
    assert SubSolar(0.0, 0.0).terminator_deg(170.0) == pytest.approx(90.0)


def test_a_naive_time_is_refused() -> None:
    naive = NOW.replace(tzinfo=None)
    with pytest.raises(ValueError, match="zone"):
        sub_solar(naive)
    with pytest.raises(ValueError, match="zone"):
        world_view(naive, HERE)


@pytest.mark.parametrize("elements", ALL, ids=lambda one: one.name)
def test_the_track_is_one_orbit_either_way_without_gaps(elements) -> None:
    t_s = posix_s(NOW)
    line = orbit_track(elements, t_s)
    assert line.t_s[0] == pytest.approx(t_s - elements.period_s)
    assert line.t_s[-1] == pytest.approx(t_s + elements.period_s)
    assert (np.diff(line.t_s) > 0.0).all()
    assert len(line.t_s) < 2500
    turn = np.abs((np.diff(line.longitude_deg) + 180.0) % 360.0 - 180.0)
    away_from_poles = np.abs(line.latitude_deg[1:]) < 85.0
    assert np.hypot(turn, np.diff(line.latitude_deg))[away_from_poles].max() < 6.0


def test_behind_ends_and_ahead_begins_under_the_satellite() -> None:
    seen = world_view(NOW, HERE, Mapped(POLAR, favourite=True), [Mapped(STATION), Mapped(STILL)])
    assert seen.chosen is not None
    under = (seen.chosen.latitude_deg, seen.chosen.longitude_deg)
    assert seen.behind[-1] == seen.ahead[0] == under
    assert (seen.utc, seen.observer, seen.chosen.name, seen.chosen.favourite) == (NOW, HERE, "POLAR", True)
    assert [one.name for one in seen.satellites] == ["STATION", "STILL"]
    alone = ground_track(STATION, [posix_s(NOW)])
    assert seen.satellites[0].latitude_deg == pytest.approx(alone.latitude_deg[0])
    soon = ground_track(POLAR, [posix_s(NOW) + 60.0])
    nearest = min(math.dist(place, (soon.latitude_deg[0], soon.longitude_deg[0])) for place in seen.ahead)
    assert nearest < 2.0
    assert all(math.dist(place, (soon.latitude_deg[0], soon.longitude_deg[0])) > 2.0 for place in seen.behind)


def test_a_satellite_that_comes_later_is_less_far_on_its_track() -> None:
    late = world_view(NOW, HERE, Mapped(POLAR, time_offset_s=30.0), [Mapped(STATION, 30.0)])
    before = world_view(NOW - timedelta(seconds=30), HERE, Mapped(POLAR), [Mapped(STATION)])
    assert late.chosen is not None
    assert before.chosen is not None
    for one, other in ((late.chosen, before.chosen), (late.satellites[0], before.satellites[0])):
        assert one.latitude_deg == pytest.approx(other.latitude_deg, abs=1e-6)
        turned = (other.longitude_deg - one.longitude_deg) % 360.0
        assert turned == pytest.approx(30.0 * 360.9856 / 86400.0, abs=1e-3)  # the Earth has turned more


def test_what_has_no_position_is_left_out() -> None:
    no_orbit = replace(POLAR, name="NO ORBIT", eccentricity=0.99)
    seen = world_view(NOW, None, Mapped(no_orbit), [Mapped(no_orbit), Mapped(STATION)])
    assert seen.chosen is None
    assert [one.name for one in seen.satellites] == ["STATION"]
    assert seen.behind == seen.ahead == seen.footprint == ()
    assert world_view(NOW, None).satellites == ()


def test_the_coastline_holds_the_world() -> None:
    lines = coastline()
    points = [point for line in lines for point in line]
    assert len(points) > 4500
    assert all(-90.0 < latitude < 84.0 and -180.0 <= longitude <= 180.0 for latitude, longitude in points)
    assert all(len(line) >= 2 for line in lines)
    longest = max(abs(b[1] - a[1]) for line in lines for a, b in itertools.pairwise(line))
    assert longest < 20.0  # none runs around the world to come in at the other edge
    for latitude, longitude, where in ((36.0, -5.6, "Gibraltar"), (-34.4, 18.5, "Cape of Good Hope"),
                                       (-55.5, -68.5, "Cape Horn"), (8.1, 77.5, "Cape Comorin")):  # fmt: skip
        assert min(math.dist((latitude, longitude), point) for point in points) < 1.0, where
    inland = ((48.0, 10.0), (40.0, -100.0), (-25.0, 130.0), (10.0, 20.0), (60.0, 90.0), (-10.0, -55.0))
    assert all(min(math.dist(place, point) for point in points) > 3.0 for place in inland)  # no borders
