from __future__ import annotations

import pytest
from birdcage.base.geometry import shortest_turn
from birdcage.leapfrog import apply_leapfrog
from hypothesis import given
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("delta", "beyond"), [(0.5, 0), (1.0, 0), (1.01, 0.5), (2.0, 0.5), (2.01, 1.0), (40, 1.0), (-1.5, -0.5), (-3, -1.0)]
)
def test_the_documented_table_for_each_axis_alone(delta, beyond):
    assert apply_leapfrog(180 + delta, 40, 180, 40) == (pytest.approx(180 + delta + beyond), 40)
    assert apply_leapfrog(180, 40 + delta, 180, 40) == (180, pytest.approx(40 + delta + beyond))


def test_the_azimuth_takes_the_shorter_way_round():
    assert apply_leapfrog(3, 40, 358, 40)[0] == pytest.approx(4)
    assert apply_leapfrog(357, 40, 2, 40)[0] == pytest.approx(356)
    assert apply_leapfrog(359.5, 40, 357, 40)[0] == pytest.approx(0.5)


@given(st.floats(0, 359.99), st.floats(0, 90), st.floats(0, 359.99), st.floats(0, 90))
def test_never_more_than_a_degree_and_never_backwards(az, el, current_az, current_el):
    new_az, new_el = apply_leapfrog(az, el, current_az, current_el)
    assert abs(shortest_turn(az, new_az)) <= 1.0 + 1e-9
    assert abs(new_el - el) <= 1.0 + 1e-9
    assert (new_el - el) * (el - current_el) >= 0


@pytest.mark.parametrize(
    ("target", "current", "sent"),
    [
        (365.0, 362.0, 366.0),
        (400.0, 395.0, 401.0),
        (395.0, 400.0, 394.0),
        (401.5, 400.0, 402.0),
        (400.5, 400.0, 400.5),
        (361.0, 358.0, 362.0),
        (359.0, 362.0, 358.0),
        (3.0, 362.0, 2.0),
        (455.0, 100.0, 456.0),
    ],
)
def test_a_turn_beyond_360_is_kept(target, current, sent):
    assert apply_leapfrog(target, 40, current, 40) == (pytest.approx(sent), 40)


def test_a_full_circle_is_no_turn_beyond():
    assert apply_leapfrog(360.0, 40, 357, 40)[0] == pytest.approx(1.0)
    assert apply_leapfrog(357.0, 40, 360.0, 40)[0] == pytest.approx(356.0)


@given(st.floats(360.01, 455), st.floats(0, 455))
def test_beyond_360_the_documented_table_counts_by_the_plain_difference(target, current):
    sent = apply_leapfrog(target, 40, current, 40)[0]
    delta = target - current
    size = 1.0 if abs(delta) > 2 else 0.5 if abs(delta) > 1 else 0.0
    assert sent == pytest.approx(target + (size if delta > 0 else -size))
