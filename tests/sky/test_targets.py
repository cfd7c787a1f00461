"""What people type, and where that stands."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta

import pytest
from birdcage.sky.elements import ElementSet
from birdcage.sky.geostationary import look_at_slot
from birdcage.sky.observer import Observer
from birdcage.sky.targets import Resolver, UnknownTarget
from birdcage.sky.targets.model import NoPosition, Satellite, rate

HERE, OMAHA = Observer(52.0, 4.4, 10.0), Observer(41.3, -96.0)
NOW = datetime(2026, 11, 21, 15, 0, tzinfo=UTC)


def orbit(name, norad_id, mean_motion=15.5, epoch=NOW, **more):
    return ElementSet(name, norad_id, epoch, 51.6, 10.0, 0.001, 20.0, 30.0, mean_motion, **more)


@dataclass
class Hit:
    elements: ElementSet
    time_offset_s: float | None = None


class Shelf:
    """Looks satellites up as the catalogue does: anything whose name or number holds the text."""

    def __init__(self, *elements):
        self.hits = [Hit(each) for each in elements]

    def __len__(self):
        return len(self.hits)

    def names(self):
        return [hit.elements.name for hit in self.hits]

    def search(self, text, limit):
        def holds(hit):
            return text.lower() in hit.elements.name.lower() or text == str(hit.elements.norad_id)

        return [hit for hit in self.hits if holds(hit)][:limit]


def target_of(typed, shelf=None):
    return Resolver(shelf).resolve(typed).target


SHELF = Shelf(
    orbit("ISS (ZARYA)", 25544), orbit("ISS (NAUKA)", 49044), orbit("METEOR-M2 3", 57166), orbit("METEOR-M2 4", 59051),
    orbit("GOES 19", 60133, 1.0027), orbit("FUNCUBE-1", 39444), orbit("SUNSAT", 25636),
    orbit("ASTRA 2E", 39285, 1.0027),
)  # fmt: skip


@pytest.mark.parametrize(
    ("typed", "name", "kind"),
    [
        ("sun", "Sun", "body"),
        ("  MOON ", "Moon", "body"),
        ("Jupiter", "Jupiter", "body"),
        ("28.2E", "28.2°E Astra 28", "slot"),
        ("28.2° e", "28.2°E Astra 28", "slot"),
        ("101w", "101°W DIRECTV 101", "slot"),
        ("77.3W", "77.3°W", "slot"),
        ("QO-100", "25.9°E QO-100", "slot"),
        ("qo100", "25.9°E QO-100", "slot"),
        ("es'hail 2", "25.9°E QO-100", "slot"),
        ("goes west", "137°W GOES 18", "slot"),
        ("25544", "ISS (ZARYA)", "satellite"),
        ("goes-19", "GOES 19", "satellite"),
        ("meteor-m2 4", "METEOR-M2 4", "satellite"),
        ("FUNCUBE", "FUNCUBE-1", "satellite"),
    ],
)
def test_names(typed, name, kind):
    class Loose(Shelf):
        def search(self, text, limit):
            return super().search(text.replace("-19", " 19"), limit)

    target = Resolver(Loose(*(hit.elements for hit in SHELF.hits))).resolve(typed).target
    assert (target.name, target.kind) == (name, kind)


@pytest.mark.parametrize(
    ("typed", "ra", "dec"),
    [
        ("ra=5h34m,dec=+22d", 83.5, 22.0),
        ("RA 83.63 DEC 22.01", 83.63, 22.01),
        ("ra 5:34:32 dec -22:00:36", 83.63333, -22.01),
        ("ra=5h34m32s dec=22d00m36s", 83.63333, 22.01),
        ("ra:83.63,dec:−22.01", 83.63, -22.01),
        ("ra 23h59m59s dec -0d30m", 359.99583, -0.5),
        ("gal 184.5575,-5.7843", 83.633, 22.0145),
        ("galactic 184.5575 -5.7843", 83.633, 22.0145),
        ("gal l=184.5575 b=-5.7843", 83.633, 22.0145),
        ("l=184.5575, b=-5.7843", 83.633, 22.0145),
        ("gal 0,0", 266.405, -28.936),
    ],
)
def test_points_of_the_sky(typed, ra, dec):
    target = target_of(typed)
    assert target.kind == "star"
    assert target.ra_deg == pytest.approx(ra, abs=0.001)
    assert target.dec_deg == pytest.approx(dec, abs=0.001)


@pytest.mark.parametrize(
    ("typed", "az", "el"),
    [
        ("az 180 el 45", 180.0, 45.0),
        ("AZ=180,EL=45", 180.0, 45.0),
        ("az -90.5 el -3", 269.5, -3.0),
        ("az 12el5", 12, 5),
    ],
)
def test_fixed_directions(typed, az, el):
    seen = target_of(typed).look(HERE, NOW)
    assert (seen.az_deg, seen.el_deg, seen.range_km, seen.range_rate_km_s) == (az, el, None, None)


@pytest.mark.parametrize(
    ("typed", "words"),
    [
        ("az 180 el 95", "elevation is -90 to 90 degrees, not 95"),
        ("ra 25h dec 3", "right ascension is 0 to 360 degrees, not 375"),
        ("ra 5h34m dec 91", "declination"),
        ("gal 10,-95", "galactic latitude"),
        ("gal x,y", "'x' is not an angle"),
        ("ra 5h61m dec 3", "60 minutes"),
        ("ra 5 34 dec 3", "5h34m or 5d34m"),
        ("200E", "200E is not a longitude"),
    ],
)
def test_an_angle_that_is_none_is_named(typed, words):
    with pytest.raises(UnknownTarget, match=words):
        target_of(typed)


def test_what_is_not_known_says_what_would_be_understood():
    for typed in ("nonsense", "", "   "):
        with pytest.raises(UnknownTarget) as told:
            target_of(typed, SHELF)
        for word in ("name or number", "moon", "28.2E", "ra=", "gal 120,-5", "az 180 el 45"):
            assert word in str(told.value)
        assert told.value.reason == "unknown"


def test_of_several_the_candidates_are_told():
    with pytest.raises(UnknownTarget, match=r"METEOR-M2 3 \(57166\), METEOR-M2 4 \(59051\)") as told:
        target_of("meteor", SHELF)
    assert told.value.reason == "ambiguous"
    with pytest.raises(UnknownTarget, match=r"ASTRA 2E \(39285\), .*Astra 28 \(28.2E\)"):
        target_of("astra", SHELF)
    many = Shelf(*(orbit(f"STARLINK-{number}", number) for number in range(100, 130)))
    with pytest.raises(UnknownTarget, match=r"STARLINK-107 \(107\) and 22 more"):
        target_of("starlink", many)


def test_without_a_catalogue_all_but_satellites_is_understood():
    assert target_of("GOES 19").kind == "slot"
    with pytest.raises(UnknownTarget, match=r"AO-73 \(39444\) is not among your 0"):
        target_of("FUNCUBE")


def test_of_two_with_one_name_the_newest_elements_count():
    old = orbit("TWIN", 1, epoch=NOW - timedelta(days=9))
    new = orbit("TWIN", 2)
    assert target_of("twin", Shelf(old, new)).elements is new
    assert target_of("twin", Shelf(new, old)).elements is new


def test_every_target_knows_where_it_stands():
    for typed in ("25544", "sun", "28.2E", "ra=5h34m,dec=+22d", "gal 120,-5", "az 180 el 45"):
        seen = target_of(typed, SHELF).look(HERE, NOW)
        assert 0.0 <= seen.az_deg < 360.0
        assert -90.0 <= seen.el_deg <= 90.0


def test_a_satellite_that_comes_later_is_where_its_elements_had_it_before():
    elements = orbit("LATE", 7)
    late = Satellite(elements, 30.0).look(HERE, NOW)
    # The same orbit, half a minute less far along it.
    behind = replace(elements, mean_anomaly_deg=elements.mean_anomaly_deg - 15.5 * 360.0 * 30.0 / 86400.0)
    assert late.az_deg == pytest.approx(Satellite(behind).look(HERE, NOW).az_deg, abs=0.02)
    assert late.az_deg != pytest.approx(Satellite(elements).look(HERE, NOW).az_deg, abs=1.0)


def test_a_satellite_without_a_position_says_why():
    fallen = ElementSet("FALLEN", 9, NOW - timedelta(days=4000), 51.6, 10.0, 0.0, 0.0, 0.0, 16.5, bstar=0.01)
    with pytest.raises(NoPosition, match=r"FALLEN \(epoch 2015-12-09\) give no position"):
        Satellite(fallen).look(HERE, NOW)


def test_the_sky_turns_fifteen_degrees_an_hour_and_slots_stand_still():
    polaris_like = rate(target_of("ra 0 dec 89.99"), HERE, NOW)
    assert abs(polaris_like.el_deg_s) < 1e-4
    seen, turning = target_of("sun").look(HERE, NOW), rate(target_of("sun"), HERE, NOW)
    on_the_sky = math.hypot(turning.az_deg_s * math.cos(math.radians(seen.el_deg)), turning.el_deg_s)
    assert on_the_sky == pytest.approx(15.0 / 3600.0 * math.cos(math.radians(20.0)), rel=0.02)
    still = rate(target_of("28.2E"), HERE, NOW)
    assert (still.az_deg_s, still.el_deg_s) == (0.0, 0.0)


def test_the_skew_is_told_for_linear_polarisation_only():
    assert target_of("28.2E").skew(Observer(51.5, -0.1)).geometry_deg == pytest.approx(-20.84, abs=0.05)
    assert target_of("119W").skew(Observer(40.0, -100.0)) is None


def test_where_the_polarisation_is_not_known_the_skew_is_told_for_a_linear_one():
    target = target_of("103W")
    assert target.slot.polarization is None
    assert target.skew(OMAHA).geometry_deg == pytest.approx(look_at_slot(OMAHA, -103.0).skew_deg)
    assert target_of("123.4W").slot.polarization is None
    assert target_of("119W").skew(Observer(39.1, -95.7)) is None, "it is circular"
