"""Azimuth, elevation, range and range rate against Skyfield with the same UT1, and UT1 - UTC against the IERS."""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta
from pathlib import Path

import astropy_iers_data
import numpy as np
import pytest
from birdcage.sky.dut1 import LIMIT_S, dut1_s, table_end
from birdcage.sky.frames import dut1_at, julian, look, posix_s, sidereal_rad, utc
from birdcage.sky.observer import Observer
from sgp4.api import Satrec
from skyfield.api import EarthSatellite, load, wgs84

LINES = {
    "ISS": (
        "1 25544U 98067A   18021.21573878  .00002217  00000-0  40532-4 0  9993",
        "2 25544  51.6427  49.4461 0003350   8.8293 137.1127 15.54298420 95721",
    ),
    "Molniya": (
        "1 08195U 75081A   06176.33215444  .00000099  00000-0  11873-3 0   813",
        "2 08195  64.1586 279.0717 6877146 264.7651  20.2257  2.00491383225656",
    ),
    "geostationary": (
        "1 28868U 05036A   20011.46493281 -.00000066  00000-0  00000+0 0  9999",
        "2 28868   0.0175  50.4632 0002403 284.1276 195.8977  1.00270824 52609",
    ),
}
PLACES = [Observer(0.5, 32.0, 1200.0), Observer(47.0, 8.0), Observer(78.2, -15.6, 20.0), Observer(-33.9, 151.2, 40.0)]
LEAP_SECONDS = 37.0  # since 2017; TT is 32.184 s ahead of TAI


@pytest.mark.parametrize("place", PLACES, ids=str)
@pytest.mark.parametrize("name", LINES)
def test_look_angles_agree_with_skyfield_within_an_arcsecond(name: str, place: Observer) -> None:
    start = datetime(2026, 9, 20, 6, tzinfo=UTC)
    record = Satrec.twoline2rv(*LINES[name])
    scale = load.timescale(delta_t=32.184 + LEAP_SECONDS - dut1_s(start))
    t_s = posix_s(start) + np.arange(0.0, 86400.0, 97.0)
    _, r, v = record.sgp4_array(*julian(t_s))
    seen = look(place, t_s, r, v)
    times = scale.from_datetimes([utc(t) for t in t_s])
    topos = wgs84.latlon(place.latitude_deg, place.longitude_deg, place.height_m)
    el, az, distance, _, _, rate = (
        (EarthSatellite.from_satrec(record, scale) - topos).at(times).frame_latlon_and_rates(topos)
    )
    across = ((seen.az_deg - az.degrees + 180.0) % 360.0 - 180.0) * np.cos(np.radians(seen.el_deg))
    apart_arcsec = 3600.0 * np.hypot(across, seen.el_deg - el.degrees)
    assert apart_arcsec.max() < 1.0
    assert np.abs(seen.range_km - distance.km).max() < 0.02
    assert np.abs(seen.range_rate_km_s - rate.km_per_s).max() < 1e-4
    assert ((seen.az_deg >= 0.0) & (seen.az_deg < 360.0)).all()


def test_sidereal_time_is_that_of_the_almanac() -> None:
    """Meeus, Astronomical Algorithms, examples 12.a and 12.b: 13h10m46.3668s and 8h34m57.0896s, for UT1."""
    for when, hours in (
        (datetime(1987, 4, 10, tzinfo=UTC), 13 + 10 / 60 + 46.3668 / 3600),
        (datetime(1987, 4, 10, 19, 21, tzinfo=UTC), 8 + 34 / 60 + 57.0896 / 3600),
    ):
        assert math.degrees(float(sidereal_rad(posix_s(when), 0.0))) / 15.0 == pytest.approx(hours, abs=1e-7)


def test_a_naive_time_is_refused() -> None:
    for ask in (posix_s, dut1_s):
        with pytest.raises(ValueError, match="zone"):
            ask(datetime(2026, 1, 1))  # noqa: DTZ001


def test_times_go_through_posix_seconds_and_back() -> None:
    when = datetime(2026, 11, 21, 15, 4, 5, 678901, tzinfo=UTC)
    assert abs(utc(posix_s(when)) - when) <= timedelta(microseconds=1)
    day, part = julian(posix_s(when))
    assert float(day) == 2461365.5
    assert float(part) * 86400.0 == pytest.approx(15 * 3600 + 4 * 60 + 5.678901, abs=1e-6)


def test_ut1_agrees_with_the_iers_within_seven_milliseconds() -> None:
    lines = Path(astropy_iers_data.IERS_B_FILE).read_text(encoding="ascii").splitlines()
    rows = [line.split() for line in lines if not line.startswith("#")]
    checked = 0
    for year, month, day, hour, _, _, _, value, *_ in rows[::3]:
        if int(year) >= 1973:
            when = datetime(int(year), int(month), int(day), int(hour), tzinfo=UTC)
            assert abs(dut1_s(when) - float(value)) < 0.007, when
            assert float(dut1_at(when.timestamp())) == pytest.approx(dut1_s(when), abs=1e-9)
            checked += 1
    assert checked > 6000


def test_ut1_jumps_with_a_leap_second_and_no_sooner() -> None:
    after = datetime(2017, 1, 1, tzinfo=UTC)
    assert dut1_s(after - timedelta(seconds=1)) == pytest.approx(-0.4087, abs=2e-3)
    assert dut1_s(after) == pytest.approx(0.5913, abs=2e-3)


def test_ut1_beyond_the_table_is_its_last_value() -> None:
    end = table_end()
    assert end > datetime(2027, 6, 1, tzinfo=UTC)
    assert dut1_s(end) == dut1_s(datetime(2050, 1, 1, tzinfo=UTC))
    assert abs(dut1_s(end)) < LIMIT_S
    for when in (end, datetime(2050, 1, 1, tzinfo=UTC), datetime(1960, 1, 1, tzinfo=UTC)):
        assert float(dut1_at(when.timestamp())) == dut1_s(when)
    assert dut1_s(datetime(1960, 1, 1, tzinfo=UTC)) == dut1_s(datetime(1973, 1, 1, tzinfo=UTC))
