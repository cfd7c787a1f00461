"""Sun, Moon, planets and stars against astropy, on the same excerpt of DE421."""

from __future__ import annotations

import math
import random
import subprocess
import sys
from datetime import UTC, datetime, timedelta, timezone

import pytest
from birdcage.base.errors import BirdcageError
from birdcage.sky.ephemeris.bodies import BODIES, look_at_star
from birdcage.sky.ephemeris.worker import FIRST, LAST, NotCovered
from birdcage.sky.observer import Observer
from birdcage.sky.sun import sun

DELFT = Observer(52.0, 4.4, 3.0)
NOON = datetime(2026, 6, 21, 12, tzinfo=UTC)


def apart_arcsec(one, other):
    def unit(az, el):
        az, el = math.radians(az), math.radians(el)
        return math.cos(el) * math.cos(az), math.cos(el) * math.sin(az), math.sin(el)

    return math.degrees(2.0 * math.asin(math.dist(unit(*one), unit(*other)) / 2.0)) * 3600.0


def instants(seed, count, until=datetime(2027, 10, 1, tzinfo=UTC)):
    """Times while the Earth's turning is known, all of them on whole milliseconds, and places all over the Earth."""
    dice = random.Random(seed)
    for _ in range(count):
        when = FIRST + (until - FIRST) * dice.random()
        place = Observer(dice.uniform(-85.0, 85.0), dice.uniform(-180.0, 180.0), dice.uniform(0.0, 4000.0))
        yield when.replace(microsecond=0), place


@pytest.mark.parametrize("name", list(BODIES))
def test_it_stands_where_astropy_has_it(sky_by_astropy, name):
    for when, place in instants(name, 12):
        seen = BODIES[name].look(place, when)
        az, el, far_km = sky_by_astropy(name, place, when)
        assert apart_arcsec((seen.az_deg, seen.el_deg), (az, el)) < 2.0, (when, place)
        assert seen.range_km == pytest.approx(far_km, abs=1.0)


@pytest.mark.filterwarnings("ignore")  # astropy says that it does not know the turning of the Earth that far on
@pytest.mark.parametrize("year", [2031, 2044, 2053])
def test_the_excerpt_reaches_to_its_end(sky_by_astropy, year):
    when = datetime(year, 9, 30, tzinfo=UTC)
    for name in ("moon", "mars"):
        seen = BODIES[name].look(DELFT, when)
        az, el, _ = sky_by_astropy(name, DELFT, when)
        # UT1 is unknown then; 15 arcseconds a second, and UTC is kept within 0.9 s.
        assert apart_arcsec((seen.az_deg, seen.el_deg), (az, el)) < 15.0


def test_a_star_stands_where_astropy_has_it(sky_by_astropy):
    for index, (when, place) in enumerate(instants("stars", 12)):
        ra_deg, dec_deg = (index * 37.0) % 360.0, -80.0 + 14.0 * index
        seen = look_at_star(place, when, ra_deg, dec_deg)
        az, el, _ = sky_by_astropy((f"{ra_deg}d", f"{dec_deg}d"), place, when)
        assert apart_arcsec((seen.az_deg, seen.el_deg), (az, el)) < 2.0
        assert (seen.range_km, seen.range_rate_km_s) == (None, None)


@pytest.mark.parametrize("name", list(BODIES))
def test_the_range_rate_is_how_fast_the_range_changes(name):
    step = timedelta(seconds=10)
    before, after = (BODIES[name].look(DELFT, NOON + shift).range_km for shift in (-step, step))
    assert BODIES[name].look(DELFT, NOON).range_rate_km_s == pytest.approx((after - before) / 20.0, abs=0.01)


def test_the_short_formula_for_the_sun_agrees():
    for when, place in instants("sun", 20):
        seen = BODIES["sun"].look(place, when)
        assert apart_arcsec((seen.az_deg, seen.el_deg), sun(when, place.latitude_deg, place.longitude_deg)) < 36.0


def test_sun_and_moon_are_half_a_degree_wide():
    for name in ("sun", "moon"):
        seen = BODIES[name].look(DELFT, NOON)
        assert 0.48 < BODIES[name].width_deg(seen.range_km) < 0.57
    jupiter = BODIES["jupiter"].look(DELFT, NOON)
    assert 30.0 < BODIES["jupiter"].width_deg(jupiter.range_km) * 3600.0 < 50.0


@pytest.mark.parametrize("when", [FIRST - timedelta(days=1), LAST + timedelta(days=1)])
def test_outside_its_years_it_says_so_instead_of_guessing(when):
    with pytest.raises(NotCovered, match="2020-01-02 to 2053-10-08") as told:
        BODIES["sun"].look(DELFT, when)
    assert isinstance(told.value, BirdcageError)
    with pytest.raises(ValueError, match="covers"):
        look_at_star(DELFT, when, 0.0, 0.0)


def test_at_the_very_ends_it_still_answers():
    for when in (FIRST, LAST):
        for body in BODIES.values():
            assert body.look(DELFT, when).range_km > 300_000.0


def test_a_time_without_a_zone_is_refused_and_any_zone_will_do():
    with pytest.raises(ValueError, match="zone"):
        BODIES["sun"].look(DELFT, datetime(2026, 6, 21, 12))  # noqa: DTZ001
    eastern = NOON.astimezone(timezone(timedelta(hours=5)))
    assert BODIES["sun"].look(DELFT, eastern) == BODIES["sun"].look(DELFT, NOON)


def test_no_network_is_touched():
    # In a process of its own: nothing may have been loaded before.
    code = """
import sys
tried = []
sys.addaudithook(lambda event, args: tried.append(event) if event.startswith("socket.") else None)
from datetime import UTC, datetime
from birdcage.sky.ephemeris.bodies import BODIES, look_at_star
from birdcage.sky.observer import Observer
from birdcage.sky.sidereal import local_sidereal_h
when, place = datetime(2026, 11, 21, tzinfo=UTC), Observer(52.0, 4.4)
for body in BODIES.values():
    assert body.look(place, when).range_km > 0
look_at_star(place, when, 83.6, 22.0)
local_sidereal_h(when, 4.4)
print("tried", tried)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert done.stdout.strip() == "tried []", done.stderr


def test_importing_it_loads_nothing_heavy():
    code = "import sys, birdcage.sky.ephemeris.bodies, birdcage.sky.sidereal; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert done.stdout.strip() == "False", done.stderr
