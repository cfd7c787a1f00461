from __future__ import annotations

import pytest
from birdcage.kinematics import plan_slew, plan_timed, rest_point
from hypothesis import given
from hypothesis import strategies as st

ANGLE = st.floats(-400, 400)
SPEED = st.floats(0, 65)


@pytest.mark.parametrize(
    ("angle_deg", "speed", "time_s"),
    [(1, 65, 0.10), (10, 65, 0.32), (90, 65, 1.55), (180, 65, 2.93), (360, 65, 5.70), (10, 45, 0.34), (45, 45, 1.11)],
)
def test_move_times_of_the_reference(angle_deg, speed, time_s):
    """Trapezoids by the G2's settings (`docs/reference/g2-motors.md`, *Speeds*): 400 deg/s2."""
    assert plan_slew(0, angle_deg, speed, 400).duration_s == pytest.approx(time_s, abs=0.006)


@given(ANGLE, ANGLE, st.floats(-65, 65))
def test_a_slew_starts_where_it_stands_and_rests_at_its_end(start, end, velocity):
    slew = plan_slew(start, end, 65, 400, velocity)
    assert slew.at(slew.duration_s + 1) == (end, 0.0)
    if slew.segments:
        position, speed = slew.at(0)
        assert position == pytest.approx(start)
        assert speed == pytest.approx(velocity, abs=1e-6)
        last, speed = slew.segments[-1].at(slew.segments[-1].duration_s)
        assert last == pytest.approx(end, abs=1e-6)
        assert speed == pytest.approx(0, abs=1e-4)


@given(ANGLE, ANGLE, st.floats(-65, 65), st.floats(0, 1))
def test_position_is_continuous_and_speed_is_limited(start, end, velocity, share):
    slew = plan_slew(start, end, 65, 400, velocity)
    t = share * slew.duration_s
    before, after = slew.at(t), slew.at(t + 1e-4)
    assert abs(after[0] - before[0]) <= 65.1 * 1e-4 + 1e-9
    assert abs(before[1]) <= 65 + 1e-6


@given(st.floats(1, 65), st.booleans())
def test_rest_point_lies_ahead(speed, backwards):
    velocity = -speed if backwards else speed
    aim = rest_point(100, velocity, 400, 0.1)
    assert (aim - 100) * velocity > 0
    assert abs(aim - 100) == pytest.approx(speed * 0.1 + speed**2 / 800)


def test_a_slew_of_known_duration_starts_and_ends_at_rest():
    slew = plan_timed(10.0, -80.0, 13.5)
    assert slew.duration_s == pytest.approx(13.5)
    assert slew.at(0.0) == (10.0, 0.0)
    assert slew.at(6.75)[0] == pytest.approx(-35.0)
    assert slew.at(13.5)[0] == pytest.approx(-80.0)
    assert slew.at(99.0) == (-80.0, 0.0)
