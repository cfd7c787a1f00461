"""The way through the keyhole, against slow searches that cannot be wrong."""

from __future__ import annotations

import numpy as np
import pytest
from birdcage.tracking.planning.forecast import separations_deg
from birdcage.tracking.planning.keyhole_path import Corridor, best_elevation, least_error_deg, limited, through
from hypothesis import given, settings
from hypothesis import strategies as st


def flyover(top_deg, *, step_s=0.25, low=-1e9, high=1e9, ceiling_deg=90.0):
    """A straight line 500 km up at 7.5 km/s over a flat Earth, two minutes about its culmination."""
    t = np.arange(-60.0, 60.01, step_s)
    along, beside = 7.5 * t, 500.0 / np.tan(np.radians(top_deg))
    az = np.degrees(np.unwrap(np.arctan2(along, beside)))
    el = np.minimum(np.degrees(np.arctan2(500.0, np.hypot(along, beside))), ceiling_deg)
    full = np.full_like(t, 1.0)
    return Corridor(t, az, el, low * full, high * full, ceiling_deg * full, full > 0.0)


def error_deg(corridor, path):
    el = np.minimum(best_elevation(path - corridor.az_deg, corridor.el_deg), corridor.ceiling_deg)
    return separations_deg(path, el, corridor.az_deg, corridor.el_deg)


def feasible(corridor, rate, eps):
    """Step by step: where can the azimuth be at each time, if it was where it could be before?"""
    low = high = None
    for az, el, step in zip(corridor.az_deg, corridor.el_deg, np.gradient(corridor.t_s), strict=True):
        angles = np.linspace(0.0, 180.0, 3601)
        off = np.minimum(best_elevation(angles, np.full_like(angles, el)), corridor.ceiling_deg[0])
        room = angles[separations_deg(angles, off, 0.0 * angles, np.full_like(angles, el)) <= eps].max()
        low = az - room if low is None else max(az - room, low - rate * step)
        high = az + room if high is None else min(az + room, high + rate * step)
        if low > high + 0.06:
            return False
    return True


@pytest.mark.parametrize(("top", "rate", "ceiling"), [(86.0, 5.0, 90.0), (89.0, 3.0, 90.0), (84.0, 4.0, 80.0)])
def test_the_least_error_is_what_a_search_step_by_step_finds(top, rate, ceiling):
    corridor = flyover(top, ceiling_deg=ceiling)
    least = least_error_deg(corridor, np.full(len(corridor.t_s), rate))
    assert feasible(corridor, rate, least * 1.02 + 0.01)
    assert not feasible(corridor, rate, least * 0.97)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.floats(75.0, 89.8), st.floats(1.0, 12.0), st.booleans())
def test_the_path_keeps_the_rate_and_nearly_the_least_error(top, rate, stop):
    corridor = flyover(top, high=60.0 if stop else 1e9)
    rates = np.full(len(corridor.t_s), rate)
    path = through(corridor, rates)
    assert np.abs(np.diff(path)).max() <= rate * 0.25 + 1e-6
    assert path.max() <= 60.0 + 1e-9 or not stop
    least = least_error_deg(corridor, rates)
    if least < 60.0:
        assert error_deg(corridor, path).max() <= least * 1.02 + 0.03


def test_a_target_that_can_be_followed_is_followed_exactly():
    corridor = flyover(60.0)
    assert through(corridor, np.full(len(corridor.t_s), 20.0)) == pytest.approx(corridor.az_deg, abs=1e-12)
    assert least_error_deg(corridor, np.full(len(corridor.t_s), 20.0)) == 0.0


def test_no_small_change_of_the_path_is_better_on_average():
    corridor = flyover(87.0)
    path = through(corridor, np.full(len(corridor.t_s), 5.0))
    weight = np.cos(np.radians(corridor.el_deg)) ** 2 + 1e-4
    cost = np.sum(weight * (path - corridor.az_deg) ** 2)
    inside = error_deg(corridor, path) < least_error_deg(corridor, np.full(len(path), 5.0))
    for shift in (-1, 1):
        moved = np.roll(path, shift)
        moved[0], moved[-1] = path[0], path[-1]
        assert np.sum(weight * (moved - corridor.az_deg) ** 2) > cost
    assert inside.any()


def test_a_limited_path_is_as_near_as_a_limited_path_can_be():
    values = np.concatenate([np.zeros(20), np.full(20, 10.0)])
    way = np.arange(40.0) * 0.5
    path = limited(values, way)
    assert np.abs(np.diff(path)).max() <= 0.5 + 1e-9
    assert np.abs(path - values).max() == pytest.approx((10.0 - 0.5) / 2.0)
