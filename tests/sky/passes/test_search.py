"""What callers of the search see besides the passes themselves."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from birdcage.sky import propagate
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search, search_in_parts
from birdcage.sky.passes.table import PassTable
from birdcage.sky.propagate import Fleet

HERE = Observer(47.0, 8.0, 500.0)
DECAYED = (
    "1 24794U 97020C   17357.29133070  .33479621 -16083-5  31051-3 0  9994",
    "2 24794  86.3482 237.4619 0038730  97.6871 263.3574 16.47860342 80605",
)


def test_passes_come_in_order_and_carry_their_satellite(orbits, start) -> None:
    elements = orbits(20, 1)
    table = search(Fleet(elements), HERE, start, 12.0, 10.0)
    passes = list(table)
    assert len(passes) == len(table) > 5
    assert [one.aos for one in passes] == sorted(one.aos for one in passes)
    for one, index in zip(passes, table.fleet_index, strict=True):
        assert (one.name, one.norad_id) == (elements[index].name, elements[index].norad_id)
        assert start <= one.aos <= one.tca <= one.los <= start + timedelta(hours=12)
        assert one.aos.tzinfo is UTC
        assert one.max_elevation_deg >= 10.0


def test_azimuths_are_those_of_the_look_angles(orbits, start) -> None:
    elements = orbits(10, 2)
    for one in search(Fleet(elements), HERE, start, 24.0):
        times = [propagate.posix_s(when) for when in (one.aos, one.tca, one.los)]
        seen = propagate.track(elements[one.norad_id - 1], HERE, times)
        told = np.array([one.aos_azimuth_deg, one.tca_azimuth_deg, one.los_azimuth_deg])
        error_deg = (seen.az_deg - told + 180.0) % 360.0 - 180.0
        assert np.all(np.abs(error_deg) * np.cos(np.radians(seen.el_deg)) < 1e-3)


def test_decayed_satellites_and_broken_elements_are_named_and_the_rest_is_found(tle, orbits) -> None:
    start = datetime(2018, 1, 21, 12, tzinfo=UTC)
    good = [replace(one, epoch=start) for one in orbits(6, 4)]
    broken = replace(good[0], name="NO ORBIT", eccentricity=1.5)
    still = replace(good[0], name="NO MOTION", mean_motion_rev_day=0.0)
    table = search(Fleet([broken, *good, tle("IRIDIUM", *DECAYED), still]), HERE, start, 24.0)
    assert [one.name for one in table.failed] == ["NO ORBIT", "IRIDIUM", "NO MOTION"]
    assert [one.fleet_index for one in table.failed] == [0, 7, 8]
    assert "eccentricity" in table.failed[0].why
    assert set(table.fleet_index) <= set(range(1, 7))
    alone = search(Fleet(good), HERE, start, 24.0)
    assert list(alone.aos_s) == list(table.aos_s)


def test_passes_before_a_decay_are_kept(tle) -> None:
    iridium = tle("IRIDIUM", *DECAYED)
    start = iridium.epoch
    table = search(Fleet([iridium]), HERE, start, 240.0)
    (failure,) = table.failed
    assert start < datetime.fromtimestamp(failure.t_s, UTC) < start + timedelta(hours=240)
    assert len(table) == 2
    assert table.los_s.max() < failure.t_s
    assert not table.still_up.any()


def test_no_pass_is_made_across_a_gap_of_sgp4(orbits, start) -> None:
    """A perigee below the ground gives errors around each perigee, and positions again between them."""
    dive = replace(orbits(1, 1)[0], mean_motion_rev_day=4.0, eccentricity=0.63, inclination_deg=50.0, epoch=start)
    counts = []
    for anomaly_deg in range(0, 360, 30):
        table = search(Fleet([replace(dive, mean_anomaly_deg=float(anomaly_deg))]), HERE, start, 24.0)
        (failure,) = table.failed
        assert all(table.los_s < failure.t_s)
        counts.append(len(table))
    assert max(counts) > 0


def test_parts_make_the_whole(orbits, start) -> None:
    fleet = Fleet(orbits(150, 5))
    offsets = {3: 30.0, 100: -20.0}
    parts = list(search_in_parts(fleet, HERE, start, 6.0, 5.0, offsets))
    whole = search(fleet, HERE, start, 6.0, 5.0, offsets)
    assert len(parts) == 2
    assert parts[0].fleet_index.max() < 64 <= parts[1].fleet_index.min()
    joined = PassTable.joined(parts)
    assert np.array_equal(joined.fleet_index, whole.fleet_index)
    assert np.allclose(joined.aos_s, whole.aos_s, rtol=0.0, atol=1e-6)


def test_closing_the_parts_ends_the_search(orbits, start, monkeypatch) -> None:
    parts = search_in_parts(Fleet(orbits(150, 5)), HERE, start, 6.0)
    next(parts)
    monkeypatch.setattr(propagate, "over_grid", lambda *_: pytest.fail("searched on"))
    parts.close()
    assert next(parts, None) is None


def test_who_comes_ten_seconds_later_rises_about_as_much_later(orbits, start) -> None:
    low = [one for one in orbits(10, 6) if one.mean_motion_rev_day > 12.0]
    fleet = Fleet(low)
    plain, late = search(fleet, HERE, start, 24.0), search(fleet, HERE, start, 24.0, 0.0, {0: 10.0})
    mine, moved = plain.aos_s[plain.fleet_index == 0], late.aos_s[late.fleet_index == 0]
    assert len(mine) == len(moved) > 0
    assert np.all(np.abs(moved - mine - 10.0) < 2.0)
    assert np.array_equal(plain.aos_s[plain.fleet_index == 1], late.aos_s[late.fleet_index == 1])


def test_nothing_to_search_finds_nothing(orbits, start) -> None:
    assert list(search(Fleet([]), HERE, start, 24.0)) == []
    assert len(search(Fleet(orbits(1, 1)[:0]), HERE, start, 24.0)) == 0


def test_what_cannot_be_asked_is_refused(orbits, start) -> None:
    fleet = Fleet(orbits(1, 1))
    for hours in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="span"):
            search(fleet, HERE, start, hours)
    for mask_deg in (90.0, -90.0, float("nan")):
        with pytest.raises(ValueError, match="elevation"):
            search(fleet, HERE, start, 1.0, mask_deg)
    for ask in (search, search_in_parts):
        with pytest.raises(ValueError, match="zone"):
            ask(fleet, HERE, start.replace(tzinfo=None), 1.0)
