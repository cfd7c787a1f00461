"""Declination where maps of it agree, its sign, and where there is none."""

from __future__ import annotations

from datetime import UTC, datetime

import pytest
from birdcage.sky.magnetic import declination_deg

NEW_YEAR = datetime(2025, 1, 1, tzinfo=UTC)


def test_east_is_positive_and_west_is_negative():
    assert declination_deg(NEW_YEAR, 52.0, 5.0) == pytest.approx(2.5, abs=0.3)
    assert declination_deg(NEW_YEAR, -33.9, 18.4) == pytest.approx(-26.0, abs=1.0)
    assert declination_deg(NEW_YEAR, 47.6, 237.7) == pytest.approx(15.0, abs=0.5)
    assert declination_deg(NEW_YEAR, 40.7, -74.0) == pytest.approx(-12.5, abs=0.5)


def test_is_not_known_outside_the_models_years_and_near_its_poles():
    assert declination_deg(datetime(2031, 1, 1, tzinfo=UTC), 52.0, 5.0) is None
    assert declination_deg(datetime(2024, 12, 31, tzinfo=UTC), 52.0, 5.0) is None
    assert declination_deg(NEW_YEAR, 86.0, 138.0) is None
