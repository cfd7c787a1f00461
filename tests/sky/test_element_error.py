"""The error of elements over a pass: at that pass's range and time, across the line of sight."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from birdcage.base.geometry import separation
from birdcage.sky.element_error import element_error
from birdcage.sky.frozen import frozen
from birdcage.sky.observer import Observer
from birdcage.sky.passes.search import search
from birdcage.sky.propagate import Fleet, track

ISS = next(each for each in frozen() if each.norad_id == 25544)
HERE = Observer(52.0, 5.0)
PASSES = search(Fleet([ISS]), HERE, ISS.epoch + timedelta(hours=2), 24.0)


def over(passing, **changes):
    return element_error(
        replace(ISS, **changes), HERE, passing.aos.timestamp(), passing.los.timestamp()
    )  # fmt: skip


@pytest.mark.parametrize("passing", list(PASSES), ids=str)
def test_it_is_what_a_shift_along_the_track_looks_like(passing):
    """The same kilometres, early and late, by SGP4 itself."""
    found = over(passing)
    seen = track(ISS, HERE, found.t_s)
    late_s = found.closest.along_track_median_km / np.linalg.norm(seen.velocity_km_s, axis=1)
    for index in range(0, len(found.t_s), 20):
        shifted = [track(ISS, HERE, [found.t_s[index]], sign * late_s[index]) for sign in (1.0, -1.0)]
        apart = [separation(seen.az_deg[index], seen.el_deg[index], each.az_deg[0], each.el_deg[0]) for each in shifted]
        # In the shifted time the Earth turns, by a sixteenth of the satellite's own speed at most.
        assert found.median_deg[index] == pytest.approx(max(apart), rel=0.1)


def test_it_is_of_the_time_of_the_pass_and_of_its_range():
    young, old = over(PASSES[0]), over(PASSES[0], epoch=ISS.epoch)
    assert young.closest.age_s == pytest.approx((PASSES[0].tca - ISS.epoch).total_seconds(), abs=10.0)
    assert np.array_equal(young.median_deg, old.median_deg)
    high = max(PASSES, key=lambda each: each.max_elevation_deg)
    low = min(PASSES, key=lambda each: each.max_elevation_deg)
    per_km = [over(each).median_deg.max() / over(each).closest.along_track_median_km for each in (high, low)]
    assert per_km[0] > 2.0 * per_km[1]
    found = over(high)
    assert found.median_deg[0] < found.median_deg.max() / 3.0
    assert found.closest.pointing_median_deg == pytest.approx(found.median_deg.max(), rel=0.05)


def test_beyond_the_table_it_is_unknown_with_the_reason():
    later = element_error(ISS, HERE, *(datetime(2026, 11, 1, 12, minute, tzinfo=UTC).timestamp() for minute in (0, 9)))
    assert later.median_deg is later.p90_deg is None
    assert later.unknown == "figures end at 7 d"


def test_a_made_up_orbit_has_none():
    assert over(PASSES[0], source="demo") is None
