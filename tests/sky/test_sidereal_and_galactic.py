"""Sidereal time and galactic coordinates against astropy."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.sky.galactic import equatorial
from birdcage.sky.sidereal import local_sidereal_h, sidereal_words


@pytest.mark.parametrize("when", [datetime(2020, 3, 1, tzinfo=UTC), datetime(2026, 11, 21, 15, 30, 1, tzinfo=UTC)])
@pytest.mark.parametrize("longitude", [-97.5, 0.0, 179.9])
def test_sidereal_time_is_astropys(when, longitude):
    from astropy.time import Time
    from astropy.utils import iers

    with iers.conf.set_temp("auto_download", False), iers.conf.set_temp("auto_max_age", None):
        told = Time(when).sidereal_time("apparent", longitude).hour
    assert local_sidereal_h(when, longitude) * 3600.0 == pytest.approx(told * 3600.0, abs=0.01)


def test_sidereal_time_in_words():
    assert sidereal_words(19.0419) == "19h02m30s"
    assert sidereal_words(0.0) == "00h00m00s"
    assert sidereal_words(23.99999999) == "23h59m59s"


@pytest.mark.parametrize(
    ("l_deg", "b_deg"), [(0.0, 0.0), (120.0, -5.0), (184.5575, -5.7843), (33.0, 90.0), (359.9, -60)]
)
def test_galactic_directions_are_astropys(l_deg, b_deg):
    from astropy.coordinates import SkyCoord

    ra_deg, dec_deg = equatorial(l_deg, b_deg)
    there = SkyCoord(l=l_deg, b=b_deg, unit="deg", frame="galactic").icrs
    assert there.separation(SkyCoord(ra_deg, dec_deg, unit="deg")).arcsec < 0.1
    assert 0.0 <= ra_deg < 360.0
