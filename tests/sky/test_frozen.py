"""The element sets that ship."""

from __future__ import annotations

from datetime import UTC, datetime
from importlib.resources import files

from birdcage.sky.formats import read_text
from birdcage.sky.frozen import frozen
from sgp4.api import WGS72, Satrec


def test_every_set_that_ships_is_read_and_says_that_it_is_frozen() -> None:
    text = files("birdcage.sky").joinpath("data", "frozen.json").read_text(encoding="utf-8")
    assert read_text(text, "frozen").complaints == ()
    sets = frozen()
    assert 15 <= len(sets) <= 20
    assert len(sets) == text.count("OBJECT_NAME")
    assert {one.source for one in sets} == {"frozen"}
    assert len({one.norad_id for one in sets}) == len({one.name for one in sets}) == len(sets)


def test_each_keeps_its_own_epoch() -> None:
    by_name = {one.name: one for one in frozen()}
    iss = by_name.pop("ISS (ZARYA)")
    assert iss.epoch == datetime(2026, 9, 20, 12, 42, 37, 141056, tzinfo=UTC)
    assert all(
        datetime(2018, 1, 14, tzinfo=UTC) < one.epoch < datetime(2018, 1, 23, tzinfo=UTC) for one in by_name.values()
    )


def test_all_kinds_of_orbit_are_there() -> None:
    periods_h = [(one.period_s / 3600.0, one.eccentricity) for one in frozen()]
    assert sum(period < 2.0 for period, _ in periods_h) >= 8
    assert sum(11.0 < period < 15.0 and e < 0.1 for period, e in periods_h) == 2
    assert sum(23.8 < period < 24.1 for period, _ in periods_h) >= 3
    assert sum(e > 0.5 for _, e in periods_h) == 1


def test_sgp4_finds_each_above_the_ground_at_its_epoch() -> None:
    for one in frozen():
        record = Satrec()
        rad, minute = 3.141592653589793 / 180.0, 2 * 3.141592653589793 / 1440.0
        days = (one.epoch - datetime(1949, 12, 31, tzinfo=UTC)).total_seconds() / 86400.0
        record.sgp4init(
            WGS72, "i", 0, days, one.bstar, 0.0, 0.0, one.eccentricity, one.argument_of_perigee_deg * rad,
            one.inclination_deg * rad, one.mean_anomaly_deg * rad, one.mean_motion_rev_day * minute,
            one.raan_deg * rad,
        )  # fmt: skip
        error, position, _ = record.sgp4_tsince(0.0)
        assert error == 0, one.name
        assert sum(x * x for x in position) ** 0.5 > 6378.0 + 300.0, one.name
