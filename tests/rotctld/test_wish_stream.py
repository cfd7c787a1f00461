"""What is a stream of wishes, where it leads, and what is none."""

from __future__ import annotations

import math

import pytest
from birdcage.base.geometry import separation, shortest_turn, wrap_360
from birdcage.rotctld.wish_stream import FEWEST, INTERVALS, WishStream, fitted, value
from hypothesis import example, given
from hypothesis import strategies as st

ANGLES = st.floats(-720.0, 720.0)
TIMES = st.floats(0.0, 100.0)
ANYTHING = st.tuples(TIMES | st.floats(), ANGLES | st.floats(), st.floats(-90.0, 90.0) | st.floats())
PASSES = st.tuples(
    st.floats(0.0, 360.0), st.floats(10.0, 60.0), st.floats(-2.0, 2.0), st.floats(-0.5, 0.5), st.floats(-0.01, 0.01)
).filter(lambda course: abs(course[2]) > 0.1)


def along(course, time):
    az_deg, el_deg, az_rate, el_rate, bend = course
    return wrap_360(az_deg + az_rate * time + bend * time * time), el_deg + el_rate * time


def streamed(course, count=8, each_s=1.0, **options):
    stream = WishStream(**options)
    for number in range(count):
        stream.take(number * each_s, *along(course, number * each_s))
    return stream


@given(PASSES, st.floats(0.0, 1.0))
def test_it_is_foreseen_between_its_wishes(course, ahead_s):
    stream = streamed(course)
    found = stream.foreseen(7.0 + ahead_s)
    assert found is not None
    assert separation(*found, *along(course, 7.0 + ahead_s)) < 0.01


@given(st.lists(ANYTHING, max_size=20), st.booleans(), st.floats())
@example([(0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.563426465531927e159), (1.0, 17.0, 165.0)], False, 0.0)
def test_any_wishes_lead_to_a_direction_or_to_none(wishes, even, at):
    stream = WishStream(even=even)
    for wish in wishes:
        stream.take(*wish)
        found = stream.foreseen(at)
        if found is not None:
            assert 0.0 <= found[0] < 360.0
            assert -90.0 <= found[1] <= 90.0


@given(
    st.lists(st.tuples(st.floats(0.1, 3.0), st.floats(-3.0, 3.0), st.floats(-1.0, 1.0)), min_size=4), st.floats(0, 99)
)
def test_it_is_never_followed_beyond_its_bound(steps, ahead_s):
    stream, at, az_deg, el_deg = WishStream(even=False), 0.0, 10.0, 40.0
    for wait_s, az_step, el_step in steps:
        at, az_deg, el_deg = at + wait_s, az_deg + az_step, min(max(el_deg + el_step, 10.0), 80.0)
        stream.take(at, az_deg, el_deg)
    found = stream.foreseen(at + ahead_s)
    if found is not None:
        assert stream.until is not None
        assert stream.until <= at + INTERVALS * 3.0 + 1e-6
        assert abs(shortest_turn(wrap_360(az_deg), found[0])) <= INTERVALS * max(abs(s[1]) for s in steps) + 1e-6
        assert abs(found[1] - el_deg) <= INTERVALS * 1.0 + 1e-6
        assert found == stream.foreseen(max(at + ahead_s, min(stream.until, at + ahead_s)))
        assert stream.foreseen(stream.until) == stream.foreseen(stream.until + 50.0), "the target stops there"


@given(ANGLES, st.floats(-90.0, 90.0), st.lists(st.floats(0.1, 3.0), max_size=12))
def test_a_target_that_stands_is_left_alone(az_deg, el_deg, waits):
    stream, at = WishStream(even=False), 0.0
    for wait_s in waits:
        at += wait_s
        stream.take(at, az_deg, el_deg)
        assert stream.foreseen(at) is None


@given(PASSES, st.floats(10.0, 350.0), st.integers(0, FEWEST - 1))
def test_nothing_is_foreseen_over_a_jump(course, by_deg, wishes):
    stream = streamed(course)
    for number in range(8, 8 + wishes):
        az_deg, el_deg = along(course, number)
        stream.take(number, az_deg + by_deg, el_deg)
        assert stream.foreseen(number + 0.5) is None


@given(PASSES, st.floats(0.5, 2.0))
def test_a_small_jump_is_not_followed_either(course, by_deg):
    stream = streamed(course)
    az_deg, el_deg = along(course, 8.0)
    stream.take(8.0, az_deg, el_deg + by_deg)
    found = stream.foreseen(8.5)
    assert found is None or abs(found[1] - el_deg - by_deg) < 1.0


def test_north_is_crossed_without_a_full_turn():
    stream, seen = WishStream(), []
    for number in range(20):
        stream.take(number, wrap_360(350.0 + number), 40.0)
        found = stream.foreseen(number + 0.5)
        if found is not None:
            seen.append(shortest_turn(wrap_360(350.0 + number), found[0]))
    assert len(seen) == 20 - FEWEST + 1
    assert seen == pytest.approx([0.5] * len(seen))


def test_equal_times_count_once_and_earlier_ones_begin_anew():
    stream = streamed((100.0, 40.0, 1.0, 0.0, 0.0))
    stream.take(7.0, 107.0, 40.0)
    assert stream.foreseen(7.5) == pytest.approx((107.5, 40.0))
    stream.take(6.5, 106.5, 40.0)
    assert stream.foreseen(7.5) is None


def test_a_target_that_comes_to_stand_ends_its_stream():
    stream = streamed((100.0, 40.0, 1.0, 0.0, 0.0))
    assert stream.foreseen(8.0) is not None
    stream.take(8.0, 107.0, 40.0)
    assert stream.foreseen(8.5) is None


def test_one_that_is_faster_than_a_satellite_is_none():
    assert streamed((100.0, 10.0, 4.0, 0.0, 0.0)).foreseen(7.5) is None
    assert streamed((100.0, 10.0, 2.5, 0.0, 0.0)).foreseen(7.5) is not None


@pytest.mark.parametrize(("waits", "even"), [((1.0, 2.4, 1.6, 1.0, 2.4), False), ((1.0, 1.1, 0.9, 1.0, 1.2), True)])
def test_uneven_intervals_are_taken_only_where_they_may_be(waits, even):
    found = []
    for only_even in (True, False):
        stream, at = WishStream(even=only_even), 0.0
        stream.take(at, 100.0, 40.0)
        for wait_s in waits:
            at += wait_s
            stream.take(at, 100.0 + at, 40.0)
        found.append(stream.foreseen(at) is not None)
    assert found == [even, True]


def test_what_comes_too_seldom_is_no_stream():
    assert streamed((100.0, 40.0, 0.5, 0.0, 0.0), each_s=3.0).until == pytest.approx(7 * 3.0 + INTERVALS * 3.0)
    assert streamed((100.0, 40.0, 0.5, 0.0, 0.0), each_s=4.0).until is None


@given(st.lists(st.floats(-5.0, 5.0), min_size=3, max_size=3), st.integers(3, 8))
def test_a_polynomial_is_found_again(coefficients, count):
    times = [-0.7 * number - 0.1 * math.sin(number) for number in range(count)]
    found = fitted(times, [value(tuple(coefficients), time) for time in times], 2)
    assert found == pytest.approx(coefficients, abs=1e-6)
