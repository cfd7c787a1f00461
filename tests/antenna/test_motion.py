"""Where STOP aims: ahead of the axis, never behind it, never beyond the target."""

from __future__ import annotations

import pytest
from birdcage.antenna.motion import plan_axis, start_motion
from birdcage.antenna.rest import RestWatch
from birdcage.kinematics import plan_slew
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.values import Position
from hypothesis import given
from hypothesis import strategies as st


@given(
    st.floats(-300, 300),
    st.floats(0, 7),
    st.floats(0, 0.1),
)
def test_the_aim_can_be_reached_without_turning_back(turn, seconds, latency_s):
    """The real axis started up to 0.1 s later than the model: the aim is still ahead of where it can rest."""
    motion = start_motion(CARRYOUT_G2, Position(180.0, 45.0), turn, 45.0, now=0.0)
    aim = motion.azimuth.stop_at(seconds, 1.0)
    real, velocity = plan_slew(180, 180 + turn, 65, 400).at(seconds - latency_s)
    rest = real + velocity * abs(velocity) / 800
    sign = 1 if turn >= 0 else -1
    assert sign * (aim - rest) >= -1e-6
    assert sign * (180 + turn - aim) >= -1e-6


def test_a_slower_axis_than_the_model_is_stopped_from_its_readings():
    motion = start_motion(CARRYOUT_G2, Position(100.0, 45.0), 120.0, 45.0, now=0.0)
    for tenths in range(1, 11):
        motion = motion.with_reading(Position(100.0 + 0.2 * tenths, 45.0), tenths / 10, 1.0)
    aim = motion.azimuth.stop_at(1.05, 1.0)
    assert 102.0 < aim < 115.0


def test_stop_target_is_folded_into_the_circle():
    motion = start_motion(CARRYOUT_G2, Position(350.0, 45.0), 100.0, 45.0, now=0.0)
    az, el = motion.stopped(1.0, 1.0).rest
    assert 0 <= az < 360
    assert el == pytest.approx(45.0)


def test_a_second_stop_aims_where_the_first_one_did():
    motion = start_motion(CARRYOUT_G2, Position(100.0, 30.0), 120.0, 60.0, now=0.0)
    first = motion.stopped(0.5, 1.0)
    assert first.stopped(0.6, 1.0).rest == pytest.approx(first.rest)
    assert first.stopped(9.0, 1.0).rest == pytest.approx(first.rest)


def test_an_azimuth_that_turns_the_other_way_round_is_noticed():
    """The turn of the cable was not known: 170 deg ahead is 190 deg the other way for a cable at its stop."""
    motion = start_motion(CARRYOUT_G2, Position(0.0, 45.0), 170.0, 45.0, now=0.0)
    real = plan_slew(0, -190, 65, 400)
    for tenths in range(1, 11):
        motion = motion.with_reading(Position(real.at(tenths / 10)[0] % 360, 45.0), tenths / 10, 1.0)
    position, velocity = real.at(1.05)
    aim = motion.stopped(1.05, 1.0).rest[0] - 360
    rest = position + velocity * abs(velocity) / 800
    assert rest - 10 < aim <= rest


def test_a_way_that_may_go_round_the_other_way_is_given_the_time_of_the_longer_one():
    known, unknown = (
        start_motion(CARRYOUT_G2, Position(350.0, 45.0), 20.0, 45.0, 0.0, turn_known=each).azimuth
        for each in (True, False)
    )
    assert known.ends_by(1.0) == known.eta(1.0) == unknown.eta(1.0)
    axis = CARRYOUT_G2.azimuth
    assert unknown.ends_by(1.0) == pytest.approx(plan_axis(axis, 0.0, 340.0).duration_s)


def test_readings_in_too_short_an_order_do_not_tell_rest():
    watch, here = RestWatch(), Position(180.0, 45.0)
    watch.see(here, 1.0)
    watch.see(here, 1.05)
    assert not watch.rests
    watch.see(here, 1.15)
    assert watch.rests
    watch.see(Position(180.02, 45.0), 1.3)
    assert not watch.rests


def test_an_azimuth_that_is_seen_going_the_other_way_round_goes_on_that_way():
    motion = start_motion(CARRYOUT_G2, Position(0.0, 45.0), 170.0, 45.0, 0.0)
    for at in (0.4, 0.5):
        motion = motion.with_reading(Position((-20.0 - 60.0 * (at - 0.4)) % 360.0, 45.0), at, 1.0)
    assert motion.azimuth.slew.end_deg == -190.0
    assert motion.rest[0] == 170.0
    turned = [motion.azimuth.modelled(at / 10, 1.0)[0] for at in range(5, 40)]
    assert turned == sorted(turned, reverse=True)
    assert motion.eta(1.0) > 0.5 + 160.0 / 65.0


def test_an_axis_that_is_read_beyond_its_target_after_a_fast_way_has_overshot_and_turned_no_other_way_round():
    motion = start_motion(TRAVLER, Position(90.0, 40.0), 40.0, 40.0, 0.0)
    eta = motion.eta(1.0)
    seen = motion.with_reading(Position(121.0, 40.0), 9.0, 1.0).with_reading(Position(130.3, 40.0), 10.0, 1.0)
    assert seen.azimuth.slew.end_deg == 130.0
    seen = seen.with_reading(Position(130.6, 40.0), 10.1, 1.0)
    assert seen.azimuth.slew.end_deg == 130.0
    assert seen.eta(1.0) < eta + 5.0
