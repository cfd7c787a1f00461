"""What the Sun in a map tells of the beam and of the receiver, and which maps tell nothing."""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import UTC, datetime

import pytest
from birdcage.base.beam import Beam, BeamOrigin
from birdcage.base.config import Settings
from birdcage.signal.level_scale import KnownLevel, checked_scale
from birdcage.sim.settings import SimSettings
from birdcage.sky.rise import quiet_sun_k
from birdcage.skymap.lesson_inputs import inputs_for
from birdcage.skymap.map_levels import LessonRefused
from birdcage.skymap.plan import MapFrame, MapPlan
from birdcage.skymap.sun_lesson import teach_sun

from tests.skymap.suns import MORNING, PLACE, Travler, airy, around, half_power_of_the_simulator, map_of, simulated

SUN_EL = 52.0
"""About where it stands on that morning."""
G2 = around(12.0, 12.0, 1.5)
TRAVLER = around(5.0, 7.0, 0.5)


@pytest.fixture(scope="module")
def heard():
    return simulated(SimSettings, G2)


@pytest.mark.parametrize(("settings", "plan"), [(SimSettings, G2), (Travler, TRAVLER)])
def test_the_beam_is_that_of_the_simulator_within_three_percent(settings, plan):
    found = teach_sun(simulated(settings, plan))
    az_deg, el_deg = half_power_of_the_simulator(settings)
    assert (found.az_deg, found.el_deg) == (pytest.approx(az_deg, rel=0.03), pytest.approx(el_deg, rel=0.03))
    assert abs(found.az_deg - az_deg) < 3.0 * found.az_sigma_deg
    assert max(found.az_sigma_deg / az_deg, found.el_sigma_deg / el_deg) < 0.03
    assert math.hypot(found.right_deg, found.up_deg) < 0.05 * az_deg


@pytest.mark.parametrize("width_deg", [1.2, 2.0, 5.5])
def test_the_beam_of_an_evenly_lit_aperture_is_told_without_the_suns_disc(width_deg):
    reach = 2.2 * width_deg
    found = teach_sun(airy(around(reach, reach, width_deg / 5.0), width_deg, 9000.0, 100.0))
    assert (found.az_deg, found.el_deg) == (pytest.approx(width_deg, rel=0.02), pytest.approx(width_deg, rel=0.02))


def test_a_map_in_azimuth_and_elevation_follows_the_sun_by_its_times():
    plan = MapPlan(95.0, 125.0, 38.0, 66.0, 1.5)
    found = teach_sun(simulated(SimSettings, plan))
    assert plan.cells * 3.0 / 3600.0 * 15.0 > 3.0  # degrees by which the Sun has moved meanwhile
    az_deg, el_deg = half_power_of_the_simulator(SimSettings)
    assert (found.az_deg, found.el_deg) == (pytest.approx(az_deg, rel=0.03), pytest.approx(el_deg, rel=0.03))


def test_system_temperature_and_g_over_t_follow_from_the_rise():
    freq_hz, width_deg, system_k = 12.45e9, 2.0, 130.0
    sun_k = quiet_sun_k(freq_hz)
    plan = around(4.4, 4.4, 0.4)
    found = teach_sun(airy(plan, width_deg, sun_k, system_k))
    assert found.noise.system_k == pytest.approx(system_k, rel=0.05)
    low, high = found.noise.system_span_k
    assert (low, high) == (pytest.approx(0.9 * found.noise.system_k), pytest.approx(1.5 * found.noise.system_k))
    # Gain over temperature, by the solid angle of that beam.
    gain_db = 10.0 * math.log10(4.0 * math.pi / (math.pi / 4.0 / math.log(2.0) * math.radians(width_deg) ** 2))
    assert found.noise.gt_db == pytest.approx(gain_db - 10.0 * math.log10(system_k), abs=0.2)
    assert found.noise.gt_span_db[0] < found.noise.gt_db < found.noise.gt_span_db[1]
    noisy = teach_sun(airy(plan, width_deg, sun_k, 2.0 * system_k))
    assert noisy.noise.system_k == pytest.approx(2.0 * found.noise.system_k, rel=0.05)
    assert noisy.noise.gt_db == pytest.approx(found.noise.gt_db - 3.0, abs=0.2)


def test_the_sky_at_the_suns_own_elevation_is_what_it_is_compared_with():
    plain = simulated_power()

    def power(when, az, el):
        return plain(when, az, el) * (1.0 + 0.006 * (SUN_EL - el))

    plan = MapPlan(-12.0, 12.0, -8.0, 18.0, 1.5, frame=MapFrame.TARGET)
    level, sloped = (map_of(plan, each, 0.01, beam_az_deg=5.7, beam_el_deg=5.6) for each in (simulated_power(), power))
    assert teach_sun(sloped).rise_db == pytest.approx(teach_sun(level).rise_db, abs=0.05)


def simulated_power():
    def power(when, az, el):
        from birdcage.base.geometry import offset
        from birdcage.sim.almanac import sun

        x, y = offset(*sun(when, PLACE["latitude_deg"], PLACE["longitude_deg"]), az, el)
        return 1.0 + 0.7 * math.exp(-4.0 * math.log(2.0) * ((x / 5.7) ** 2 + (y / 5.6) ** 2))

    return power


def test_a_beam_that_is_given_leaves_out_satellites_on_a_map_without_its_own():
    plan = MapPlan(90.0, 140.0, 30.0, 66.0, 2.0)
    own = simulated(SimSettings, plan)
    about = {name: value for name, value in own.about.items() if not name.startswith("beam_")}
    width = Beam(own.about["beam_az_deg"], own.about["beam_el_deg"], 12.45e9, BeamOrigin.SCAN)
    bare = replace(own, about=about)
    assert teach_sun(bare).points == plan.cells
    given = teach_sun(bare, beam=width)
    assert given == teach_sun(own)
    assert given.points < plan.cells
    inputs = inputs_for(bare, Settings(), (), width)
    assert inputs.sun().points == given.points


def test_without_a_frequency_the_beam_alone_is_told(heard):
    about = {**heard.about}
    del about["freq_hz"]
    assert teach_sun(replace(heard, about=about)).noise is None
    assert teach_sun(replace(heard, about=about), freq_hz=12.45e9).noise == teach_sun(heard).noise


def test_counts_are_no_power_until_two_levels_are_known(heard):
    db_per_count = 0.02
    counts = replace(
        heard, decibels=False, unit="counts",
        samples=tuple(replace(each, value=400.0 + (each.value + 60.0) / db_per_count) for each in heard.samples),
    )  # fmt: skip
    with pytest.raises(LessonRefused, match="counts are no power"):
        teach_sun(counts)
    scale = checked_scale("tuner", "stock-ku", KnownLevel(400.0, 0.0), KnownLevel(500.0, 2.0))
    assert teach_sun(counts, scale).az_deg == pytest.approx(teach_sun(heard).az_deg, rel=1e-6)


def test_maps_that_do_not_tell_the_sun_say_why(heard):
    with pytest.raises(LessonRefused, match="around Moon"):
        teach_sun(replace(heard, about={**heard.about, "target": "Moon"}))
    with pytest.raises(LessonRefused, match="map a wider region"):
        teach_sun(simulated(SimSettings, around(5.0, 5.0, 1.0)))
    beside = tuple(each for each in heard.samples if heard.plan.at(each.cell)[0] > 0.5)
    with pytest.raises(LessonRefused, match="all four sides"):
        teach_sun(heard.with_samples(beside))
    with pytest.raises(LessonRefused, match="does not stand out"):
        teach_sun(map_of(G2, lambda _when, _az, _el: 1.0, 0.05))
    with pytest.raises(LessonRefused, match="too few"):
        teach_sun(heard.with_samples(heard.samples[:10]))
    night = simulated(SimSettings, MapPlan(95.0, 125.0, 38.0, 66.0, 3.0))
    early = tuple(replace(each, utc=datetime(2026, 6, 20, 7, tzinfo=UTC)) for each in night.samples)
    with pytest.raises(LessonRefused, match="below the horizon"):
        teach_sun(night.with_samples(early))
    with pytest.raises(LessonRefused, match="does not tell where"):
        teach_sun(replace(night, about={}))


def test_the_sun_before_the_arc_is_refused_in_ku_band_only():
    equinox = datetime(2026, 10, 9, 18, 30, tzinfo=UTC)
    assert equinox != MORNING
    sky = map_of(G2, simulated_power(), 0.02, begin=equinox, beam_az_deg=5.7, beam_el_deg=5.6)
    with pytest.raises(LessonRefused, match="from a satellite of the arc"):
        teach_sun(sky)
    assert teach_sun(replace(sky, about={**sky.about, "freq_hz": 1.69e9})).az_deg == pytest.approx(5.7, rel=0.03)
