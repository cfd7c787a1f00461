"""What the dish hears."""

from __future__ import annotations

import itertools
import re
from datetime import UTC, datetime

import pytest
from birdcage.base.geometry import separation
from birdcage.sim.almanac import geostationary, sun
from birdcage.sim.beam import AZ_PROFILE, EL_PROFILE, FLOOR, PEAK, gain
from birdcage.sim.settings import SimSettings
from birdcage.sim.sky import COMPRESSION, SLOTS, SimSky

NIGHT = datetime(2026, 3, 20, 6, tzinfo=UTC)


def test_sun_against_a_worked_example():
    # NREL Solar Position Algorithm report (NREL/TP-560-34302), table A5.1: topocentric azimuth and elevation without
    # refraction, at 1830 m; the Sun's parallax of 0.002 degrees is left out here.
    az, el = sun(datetime(2003, 10, 17, 19, 30, 30, tzinfo=UTC), 39.742476, -105.1786)
    assert az == pytest.approx(194.34024, abs=0.01)
    assert el == pytest.approx(39.888378 - 0.016332, abs=0.01)


def test_geostationary_slots():
    assert geostationary(-95.7, 39.1, -95.7) == (180.0, pytest.approx(44.73, abs=0.01))
    az, el = geostationary(-119.0, 39.1, -95.7)
    assert az == pytest.approx(214.3, abs=0.2)
    assert el == pytest.approx(38.5, abs=0.3)
    assert geostationary(84.3, 39.1, -95.7)[1] < 0


@pytest.mark.parametrize("offset", range(-6, 7))
def test_the_beam_is_the_measured_one(offset):
    up = FLOOR + (PEAK - FLOOR) * gain(0.0, offset)
    assert up == pytest.approx(EL_PROFILE[offset + 6], abs=0.5)
    right = FLOOR + (PEAK - FLOOR) * gain(offset * 0.891006, 0.0)
    assert right == pytest.approx(AZ_PROFILE[offset + 6], abs=0.5)


@pytest.mark.parametrize("away", [8.0, 8.5, 9.0, -8.0, -8.5, -9.0])
def test_first_sidelobes(away):
    assert 415 <= FLOOR + (PEAK - FLOOR) * gain(0.0, away) <= 420


def test_the_floor_rises_toward_the_horizon():
    sky = SimSky(SimSettings())
    assert sky.floor(58) == pytest.approx(400)
    assert all(402 <= sky.floor(el) <= 403 for el in (18, 20, 22))
    levels = [sky.floor(el) for el in range(18, 66)]
    assert all(low > high for low, high in itertools.pairwise(levels))


def test_peaks_stand_where_the_satellites_are():
    sky = SimSky(SimSettings())
    for (az, el), counts in sky.slots:
        near = [
            (sky.level(NIGHT, az + d_az / 4, el + d_el / 4), d_az, d_el)
            for d_az, d_el in itertools.product(range(-6, 7), repeat=2)
        ]
        alone = counts > 40 and all(separation(az, el, *other) > 8 for (other, _) in sky.slots if other != (az, el))
        if alone:
            assert separation(az, el, az + max(near)[1] / 4, el + max(near)[2] / 4) < 1.0
            assert max(near)[0] == pytest.approx(sky.floor(el) + counts, abs=3)
    assert len(SLOTS) == len(sky.slots)
    assert sky.level(NIGHT, 0.0, 45.0) == pytest.approx(sky.floor(45.0))


def test_what_arrives_adds_up_and_the_detector_squeezes_it():
    sky = SimSky(SimSettings())
    sky.slots = [((180.0, 45.0), 100.0), ((180.0, 45.0), 100.0)]
    assert sky.level(NIGHT, 180.0, 45.0) == pytest.approx(sky.floor(45.0) + 100.0 * 2 ** (1 / COMPRESSION))


def test_the_sun_is_heard():
    sky = SimSky(SimSettings())
    noon = datetime(2026, 6, 21, 23, tzinfo=UTC)
    az, el = sun(noon, 39.1, -95.7)
    assert sky.level(noon, az, el) > sky.floor(el) + 20


def rssi(dish, reads=100):
    reply = dish.ask(f"rssi {reads}", "DVB>")
    return int(re.search(r"avg: (\d+)", reply)[1])


def test_the_console_hears_the_sky(terminal):
    az, el = geostationary(-119.0, 39.1, -95.7)
    dish = terminal(f"az={az - 360}&el={el}")
    dish.ask("dvb", "DVB>")
    assert rssi(dish) == pytest.approx(SimSky(SimSettings()).level(NIGHT, az, el), abs=1)
    assert rssi(dish) > 400 + SLOTS[-119.0]
    empty = terminal("az=0&el=58")
    empty.ask("dvb", "DVB>")
    assert rssi(empty) == pytest.approx(400, abs=1)


def test_the_heading_of_the_base_counts(terminal):
    az, el = geostationary(-119.0, 39.1, -95.7)
    dish = terminal(f"heading={az}&az=0&el={el}")
    dish.ask("dvb", "DVB>")
    assert rssi(dish) > 500


def test_readings_take_time_and_scatter_by_a_count(terminal):
    dish = terminal("latency_min=0&latency_max=0&el=58")
    dish.ask("dvb", "DVB>")
    start = dish.now
    rssi(dish, 50)
    assert dish.now - start == pytest.approx(0.5, abs=1e-6)
    singles = {rssi(dish, 1) for _ in range(40)}
    assert singles <= set(range(396, 405))
    assert len(singles) > 2


@pytest.mark.parametrize("words", ["rssi", "rssi 0", "rssi x", "rssi 1001", "lnbdc", "lnbdc foo"])
def test_what_the_tuner_refuses(terminal, words):
    dish = terminal()
    dish.ask("dvb", "DVB>")
    assert "Invalid parameter." in dish.ask(words, "DVB>")


def test_azimuth_shrinks_with_elevation():
    sky = SimSky(SimSettings())
    sky.slots = [((180.0, 60.0), 100.0)]
    level = sky.level(NIGHT, 186.0, 60.0)
    assert level == pytest.approx(sky.floor(60.0) + 100.0 * gain(3.0, 0.0))
