"""The demo's sky: full from the first second, wherever the observer stands, and honest in its names."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from birdcage.sky.demo_orbits import FIRST_ID, demo_orbits
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import track

NOW = datetime(2026, 11, 21, 15, 0, 3, tzinfo=UTC)
PLACES = [(43.6, -114.3), (0.0, 0.0), (-35.0, 149.0), (52.0, 13.0), (70.0, 25.0), (-78.0, 166.0), (60.0, -180.0)]
EVERYWHERE = [*PLACES, (90.0, 0.0), (-90.0, 0.0)]


def elevations(lat: float, lon: float, now: datetime, hours: float, step_s: float) -> dict[str, np.ndarray]:
    observer = Observer(lat, lon, 100.0)
    t = now.timestamp() + np.arange(0.0, hours * 3600.0, step_s)
    return {one.name: np.asarray(track(one, observer, t).el_deg) for one in demo_orbits(now, observer)}


@pytest.mark.parametrize(("lat", "lon"), EVERYWHERE)
@pytest.mark.parametrize("now", [NOW, NOW + timedelta(days=3000, hours=7.3)])
def test_several_are_up_all_the_time(lat: float, lon: float, now: datetime) -> None:
    up = sum((el > 5.0).astype(int) for el in elevations(lat, lon, now, 3.0, 60.0).values())
    assert np.min(up) >= 4
    if abs(lat) <= 70.0:
        assert np.min(up) >= 8


@pytest.mark.parametrize(("lat", "lon"), EVERYWHERE)
def test_a_low_orbit_is_above_thirty_degrees_within_two_minutes_and_another_rises(lat: float, lon: float) -> None:
    low = {name: el for name, el in elevations(lat, lon, NOW, 0.3, 10.0).items() if " LEO " in name}
    assert any(el[:13].max() > 30.0 for el in low.values())
    if abs(lat) < 89.0:
        assert any(el[0] < 0.0 < el[12] and el.max() > 30.0 for el in low.values())


@pytest.mark.parametrize(("lat", "lon"), PLACES)
def test_passes_come_about_every_ten_minutes_for_two_hours(lat: float, lon: float) -> None:
    low = [el for name, el in elevations(lat, lon, NOW, 2.1, 30.0).items() if " LEO " in name]
    inside = [(el[1:-1] > el[:-2]) & (el[1:-1] >= el[2:]) & (el[1:-1] > 20.0) for el in low]
    tops = np.flatnonzero(np.any(inside, axis=0)) * 0.5
    assert len(tops) >= 12
    assert np.diff(tops).max() < 16.0


@pytest.mark.parametrize(("lat", "lon"), PLACES)
def test_medium_high_and_stationary_orbits_are_in_sight(lat: float, lon: float) -> None:
    now_up = [name for name, el in elevations(lat, lon, NOW, 0.1, 60.0).items() if el[0] > 1.0]
    for kind, least in (("MEO", 4), ("HEO", 2), ("GEO", 5 if abs(lat) < 60.0 else 2)):
        assert sum(f" {kind} " in name for name in now_up) >= least, (kind, now_up)


def test_a_stationary_one_stands_over_the_longitude_in_its_name() -> None:
    observer = Observer(0.0, -112.0, 0.0)
    (above,) = [one for one in demo_orbits(NOW, Observer(40.0, -114.0)) if one.name == "DEMO GEO 112W"]
    found = track(above, observer, NOW.timestamp() + np.arange(0.0, 86400.0, 600.0))
    assert np.min(found.el_deg) > 89.5


def test_names_and_numbers_belong_to_no_real_satellite_and_the_epoch_is_now() -> None:
    sets = demo_orbits(NOW, Observer(40.0, -105.0))
    assert 25 <= len(sets) <= 30
    assert all(one.name.startswith("DEMO ") and one.source == "demo" and one.epoch == NOW for one in sets)
    assert sorted(one.norad_id for one in sets) == list(range(FIRST_ID, FIRST_ID + len(sets)))
    assert len({one.name for one in sets}) == len(sets)


def test_a_naive_time_is_refused() -> None:
    with pytest.raises(ValueError, match="zone"):
        demo_orbits(NOW.replace(tzinfo=None), Observer(0.0, 0.0))
