"""The way of a dish whose moves queue, planned: nothing long that can't be called back."""

from __future__ import annotations

import pytest
from birdcage.antenna.legs import leg_motion, plan_legs, skew_leg
from birdcage.antenna.motion import start_motion
from birdcage.base.errors import MotionRefused
from birdcage.base.geometry import shortest_turn
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import MOVE_TIMES, TRAVLER
from birdcage.rotator.values import Position
from hypothesis import given
from hypothesis import strategies as st

AZ = st.floats(0, 359.99)
EL = st.floats(15, 90)


@given(AZ, EL, AZ, EL, st.sampled_from([0, 1]))
def test_the_legs_lead_there_and_none_is_long_and_cannot_be_called_back(az, el, to_az, to_el, first):
    legs = plan_legs(TRAVLER, Position(az, el, 90.0), to_az, to_el, None, first)
    here = (az, el)
    for leg in legs:
        moved = abs(shortest_turn(here[0], leg.az_deg)), abs(leg.el_deg - here[1])
        if leg.is_silent:
            assert len(legs) == 1
        else:
            assert max(moved) <= 5.0
            assert min(moved) == 0.0
            if leg.motor == 0:
                assert 0 <= here[0] + shortest_turn(here[0], leg.az_deg) < 360
        here = leg.az_deg, leg.el_deg
    assert abs(shortest_turn(here[0], to_az)) <= 0.005
    assert abs(here[1] - to_el) <= 0.005


def test_a_way_across_north_counts_as_a_turn_round_unless_the_turn_is_known():
    start = Position(358.0, 45.0)
    assert plan_legs(TRAVLER, start, 1.0, 45.0, None, 0)[0].is_silent
    assert not plan_legs(TRAVLER, start, 1.0, 45.0, 3.0, 0)[0].is_silent


def test_the_first_axis_alternates_as_asked():
    start = Position(100.0, 45.0)
    assert [leg.motor for leg in plan_legs(TRAVLER, start, 102.0, 46.0, None, 0)] == [0, 1]
    assert [leg.motor for leg in plan_legs(TRAVLER, start, 102.0, 46.0, None, 1)] == [1, 0]


def test_there_is_no_leg_to_where_the_dish_stands():
    assert plan_legs(TRAVLER, Position(100.0, 45.0), 100.0, 45.0, None, 0) == ()


def test_times_are_the_measured_ones():
    (leg,) = plan_legs(TRAVLER, Position(100.0, 45.0), 104.0, 45.0, None, 0)
    assert leg.seconds == pytest.approx(MOVE_TIMES.seconds(4.0))
    motion = leg_motion(TRAVLER, Position(100.0, 45.0), leg, None, 10.0)
    assert motion.eta(1.0) == pytest.approx(10.0 + leg.seconds)
    assert motion.elevation.slew.duration_s == 0.0
    assert motion.at(10.0 + leg.seconds / 2, 1.0).azimuth == pytest.approx(102.0)


def test_a_silent_slew_takes_as_long_as_its_longer_axis_and_may_go_the_other_way_round():
    (leg,) = plan_legs(TRAVLER, Position(100.0, 45.0), 190.0, 35.0, None, 0)
    assert leg.seconds == pytest.approx(MOVE_TIMES.seconds(90.0))
    assert leg.longest_s == pytest.approx(MOVE_TIMES.seconds(270.0) + MOVE_TIMES.seconds(10.0))
    assert leg_motion(TRAVLER, Position(100.0, 45.0), leg, None, 10.0).silent


def test_axes_in_turn_arrive_after_the_sum_of_both():
    both = start_motion(TRAVLER, Position(100.0, 45.0), 20.0, 55.0, 0.0, first=1)
    assert both.eta(1.0) == pytest.approx(MOVE_TIMES.seconds(20.0) + MOVE_TIMES.seconds(10.0))
    assert both.azimuth.started == pytest.approx(MOVE_TIMES.seconds(10.0))
    at_once = start_motion(CARRYOUT_G2, Position(100.0, 45.0), 20.0, 55.0, 0.0)
    assert at_once.azimuth.started == at_once.elevation.started


def test_the_skew_is_a_leg_where_there_is_one():
    leg = skew_leg(TRAVLER, Position(100.0, 45.0, 90.0), 60.0)
    motion = leg_motion(TRAVLER, Position(100.0, 45.0, 90.0), leg, None, 0.0)
    assert motion.at(99.0, 1.0) == Position(100.0, 45.0, 60.0)
    assert motion.eta(1.0) == pytest.approx(MOVE_TIMES.seconds(30.0))
    with pytest.raises(MotionRefused, match="no skew"):
        skew_leg(CARRYOUT_G2, Position(100.0, 45.0), 60.0)
