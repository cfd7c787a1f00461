"""Motion in closed form."""

from __future__ import annotations

import itertools

import pytest
from birdcage.sim.motion import at_rest, plan, stopping_point
from hypothesis import given
from hypothesis import strategies as st

AZ, EL = (65.0, 400.0), (45.0, 400.0)


@pytest.mark.parametrize(
    ("axis", "turn_deg", "seconds"),
    [
        (AZ, 1, 0.10),
        (AZ, 10, 0.32),
        (AZ, 90, 1.55),
        (AZ, 180, 2.93),
        (AZ, 360, 5.70),
        (EL, 1, 0.10),
        (EL, 10, 0.34),
        (EL, 45, 1.11),
    ],
)
def test_move_times_of_section_7_4(axis, turn_deg, seconds):
    there = plan(0.0, 0.0, 0.0, turn_deg, *axis)
    back = plan(0.0, turn_deg, 0.0, 0.0, *axis)
    assert there.end_s == pytest.approx(seconds, abs=0.006)
    assert back.end_s == pytest.approx(there.end_s)


targets = st.lists(
    st.tuples(st.floats(-400, 20), st.floats(0.0, 8.0)),
    min_size=1,
    max_size=6,
)


@given(targets)
def test_retargeting_never_jumps(sequence):
    max_rate, accel = AZ
    motion, now = at_rest(0.0, -100.0), 0.0
    for target, after in sequence:
        position, rate = motion.at(now)
        motion = plan(now, position, rate, target, max_rate, accel)
        assert motion.at(now) == pytest.approx((position, rate), abs=1e-6)
        assert motion.rest_deg == target
        times = [now + (motion.end_s - now) * index / 200 for index in range(201)]
        for (p0, v0), (p1, v1), (t0, t1) in zip(
            itertools.islice(map(motion.at, times), 200),
            map(motion.at, times[1:]),
            itertools.pairwise(times),
            strict=True,
        ):
            assert abs(v1) <= max_rate + 1e-6
            assert abs(v1 - v0) <= accel * (t1 - t0) + 1e-3
            assert abs(p1 - p0) <= max_rate * (t1 - t0) + 1e-6
        now += after


@given(st.floats(-65, 65), st.floats(-300, 300))
def test_it_passes_neither_the_target_nor_the_place_where_it_can_stop(rate, target):
    motion = plan(0.0, 0.0, rate, target, *AZ)
    stop = stopping_point(0.0, rate, 400.0)
    positions = [motion.at(motion.end_s * index / 100)[0] for index in range(101)]
    lowest, highest = min(0.0, target, stop), max(0.0, target, stop)
    assert lowest - 1e-6 <= min(positions)
    assert max(positions) <= highest + 1e-6


def test_an_axis_slows_down_to_a_new_lower_speed():
    motion = plan(0.0, 0.0, 65.0, 100.0, 2.0, 400.0)
    assert motion.at(1.0)[1] == pytest.approx(2.0)
    assert motion.at(motion.end_s - 1e-6)[0] == pytest.approx(100.0, abs=1e-3)
