"""A catalogue in a folder of its own, and satellites to put into it."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.elements import ElementSet

EPOCH = datetime(2026, 7, 1, 12, 0, 0, 123456, tzinfo=UTC)


def satellite(name="NOAA 20", norad_id=43013, days=0.0, **more):
    """Return elements of a satellite, their epoch `days` after EPOCH."""
    values = {
        "epoch": EPOCH + timedelta(days=days), "inclination_deg": 98.7, "raan_deg": 123.4, "eccentricity": 0.0001234,
        "argument_of_perigee_deg": 12.5, "mean_anomaly_deg": 350.25, "mean_motion_rev_day": 14.195,
        "bstar": 1.5e-5, "mean_motion_dot": 2e-7, "mean_motion_ddot": 0.0, "international_designator": "2017-073A",
        "revolution": 41234, "source": "weather", **more,
    }  # fmt: skip
    return ElementSet(name=name, norad_id=norad_id, **values)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "data" / "catalogue.sqlite"


@pytest.fixture
def catalogue(path):
    with Catalogue(path) as catalogue:
        yield catalogue


@pytest.fixture
def sat():
    return satellite
