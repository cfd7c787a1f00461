"""The Sun against a published worked example and against formulae of another kind."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta, timezone

import pytest
from birdcage.base.geometry import separation
from birdcage.sim import almanac
from birdcage.sky.sun import sun
from hypothesis import given
from hypothesis import strategies as st

YEARS = st.datetimes(datetime(2020, 1, 1), datetime(2049, 12, 31), timezones=st.just(UTC))  # noqa: DTZ001


def test_the_worked_example_of_the_national_renewable_energy_laboratory():
    # Reda and Andreas, NREL/TP-560-34302, appendix A.5: azimuth 194.340241, elevation without refraction 39.872046.
    denver = datetime(2003, 10, 17, 12, 30, 30, tzinfo=timezone(timedelta(hours=-7)))
    az_deg, el_deg = sun(denver, 39.742476, -105.1786)
    assert az_deg == pytest.approx(194.340241, abs=0.01)
    assert el_deg == pytest.approx(39.872046, abs=0.01)


@given(when=YEARS, latitude_deg=st.floats(-89.0, 89.0), longitude_deg=st.floats(-180.0, 180.0))
def test_agrees_with_the_formulae_of_meeus_to_a_hundredth_of_a_degree(when, latitude_deg, longitude_deg):
    other = almanac.sun(when, latitude_deg, longitude_deg)
    assert separation(*sun(when, latitude_deg, longitude_deg), *other) < 0.01


def test_culminates_in_the_south_or_north():
    noon = datetime(2026, 3, 20, 12, 7, 30, tzinfo=UTC)  # the equation of time is -7.5 min on that day
    assert sun(noon, 50.0, 0.0) == (pytest.approx(180.0, abs=0.1), pytest.approx(39.9, abs=0.2))
    assert (sun(noon, -50.0, 0.0)[0] + 180.0) % 360.0 == pytest.approx(180.0, abs=0.1)


def test_refuses_a_time_without_a_zone_and_a_place_off_the_earth():
    with pytest.raises(ValueError, match="zone"):
        sun(datetime(2026, 3, 20), 0.0, 0.0)  # noqa: DTZ001
    with pytest.raises(ValueError, match="latitude 91"):
        sun(datetime(2026, 3, 20, tzinfo=UTC), 91.0, 0.0)
