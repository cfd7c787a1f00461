"""Stops, lost steps and wear of one axis."""

from __future__ import annotations

import random

import pytest
from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.motion import plan
from hypothesis import given
from hypothesis import strategies as st

LOW, HIGH = -423.33, 23.33


def azimuth(position=0.0, **changes):
    data = AxisData("AZ", 40000, 65.0, 400.0, LOW, HIGH, HIGH, 0.01, 65.0, 8.0, overshoot=0.0, **changes)
    return AxisMechanics(data, position, random.Random(1))


def test_a_motion_ends_at_the_stop_and_tells_when():
    axis, struck = azimuth(), []
    axis.on_strike = struck.append
    axis.retarget(0.0, 1e6)
    assert struck == [axis.end_s()]
    assert axis.shaft(struck[0] - 0.01) < HIGH
    assert axis.shaft(1000.0) == pytest.approx(HIGH)
    assert axis.count(1000.0)[0] == pytest.approx(HIGH, abs=0.009)
    assert not axis.moving(1000.0)
    axis.retarget(1000.0, 0.0)
    assert axis.shaft(2000.0) == pytest.approx(0.0, abs=1e-6)
    assert len(struck) == 1


def test_ordered_again_it_runs_into_the_stop_again():
    axis, struck = azimuth(), []
    axis.on_strike = struck.append
    axis.retarget(0.0, 30.0)
    axis.retarget(10.0, 0.0)
    axis.retarget(20.0, 30.0)
    axis.retarget(30.0, 30.0)
    assert len(struck) == 3
    assert struck[2] == pytest.approx(30.0, abs=0.01)


def test_an_axis_that_slips_at_its_stop_loses_the_steps_for_good():
    axis = azimuth()
    axis.slips_at_stop = True
    axis.retarget(0.0, 50.04)
    assert axis.count(5.0)[0] == pytest.approx(50.04)
    assert axis.shaft(5.0) == pytest.approx(HIGH)
    axis.retarget(5.0, 0.0)
    assert axis.shaft(10.0) == pytest.approx(HIGH - 50.04)


def test_to_believe_another_position_moves_nothing_but_the_way_to_the_stop():
    axis = azimuth(-90.0)
    axis.redefine(0.0, 0.0)
    assert (axis.count(0.0)[0], axis.shaft(0.0)) == (0.0, -90.0)
    axis.retarget(0.0, -360.0)  # 450 degrees the other way for the cable
    assert axis.shaft(60.0) == pytest.approx(LOW)
    assert axis.count(60.0)[0] == pytest.approx(LOW + 90.0, abs=0.009)


@given(st.floats(-300, 0), st.floats(-65, 65), st.floats(-600, 200), st.floats(-400, 20), st.sampled_from([1, -1]))
def test_passing_a_place_is_found_where_it_happens(start, rate, target, place, direction):
    motion = plan(0.0, start, rate, target, 65.0, 400.0)
    when = motion.passes(place, direction)
    sampled = [index * motion.end_s / 400 for index in range(401)]
    beyond = [t for t in sampled if (motion.at(t)[0] - place) * direction > 1e-6 and motion.at(t)[1] * direction > 1e-6]
    if when is None:
        assert not beyond
    else:
        assert (motion.at(when)[0] - place) * direction >= -1e-6
        assert not beyond or when <= beyond[0] + 1e-9


def test_wear_counts_every_way_once():
    axis = azimuth()
    axis.retarget(0.0, -90.0)
    axis.retarget(10.0, -45.0)
    assert axis.wear(5.0)[0] == pytest.approx(90.0, abs=0.01)
    assert axis.wear(20.0)[0] == pytest.approx(135.0, abs=0.01)
    assert axis.wear(100.0) == axis.wear(20.0)
    done = axis.home(100.0)
    axis.homing_done(done)
    assert axis.homings == 1
    assert axis.wear(200.0)[0] == pytest.approx(135.0 + 45 + HIGH + HIGH - 0.01, abs=0.1)
    axis.block(200.0, slips=True)
    axis.retarget(200.0, -90.0)
    assert axis.wear(300.0) == axis.wear(200.0)


def test_wear_counts_a_turn_back():
    axis = azimuth()
    axis.retarget(0.0, -90.0)
    axis.retarget(1.0, 0.0)  # it cannot stop at once
    far = -min(axis.shaft(1.0 + index / 1000) for index in range(500))
    assert axis.wear(10.0)[0] == pytest.approx(2 * far, abs=0.01)
