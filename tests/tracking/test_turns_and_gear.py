"""How far ahead an axis aims under jitter, and what it does about the play and the overshoot of its gear."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.tracking.curve import Curve
from birdcage.tracking.steering.fast import AxisTurn, Interval, ReadingTimes, fast, interval_of
from birdcage.tracking.steering.motor_course import course_of_motors

from .rig import Rig, straight

NEVER = ReadingTimes(math.inf, 1.0, 0.1)


def turn(rate, waited_s=0.1):
    return AxisTurn(rate, -waited_s, 0.1, 0.005)


def geared(**facts):
    """A G2 of whose axes both facts are known, unless one is left out."""
    return CARRYOUT_G2.with_axes(replace(CARRYOUT_G2.azimuth, **facts), replace(CARRYOUT_G2.elevation, **facts))


def least_error(rig, column):
    """What the best single lead leaves at the instants at which this axis was told, at 1 degree a second."""
    sent = [at for at, step in rig.sends(column)]
    acted = [begin for begin, _ in rig.ways[column][1:]]
    times = np.arange(rig.course.start_s + 3.0, rig.course.end_s - 1.0, 0.01)
    return float(np.std(times - np.array(sent)[np.searchsorted(acted, times) - 1]))


def shaft(rig, column, times, play_deg):
    """Where the loose end of a gear is."""
    out, found = rig.at(column, rig.course.start_s) - play_deg / 2.0, []
    for t in np.arange(rig.course.start_s, times[-1], 0.002):
        count = rig.at(column, t)
        out = min(max(out, count - play_deg / 2.0), count + play_deg / 2.0)
        found.append(out)
    return np.interp(times, np.arange(rig.course.start_s, times[-1], 0.002), found)


def test_faster_axis_knows_whether_its_interval_will_be_short_or_long():
    fast_one, slow_one = turn(1.0), turn(0.25, 0.0)
    just_after = interval_of(0, (fast_one, slow_one), 0.0, NEVER, 0.0)
    before_the_other = interval_of(0, (fast_one, replace(slow_one, sent_s=-0.6)), 0.0, NEVER, 0.0)
    assert just_after.mean_s == pytest.approx(0.1)
    assert before_the_other.mean_s == pytest.approx(0.2)


def test_reading_lengthens_the_interval_that_it_falls_into():
    turns = turn(1.0), turn(1.0)
    assert interval_of(0, turns, 0.0, NEVER, 0.0).mean_s == pytest.approx(0.2)
    assert interval_of(0, turns, 0.0, ReadingTimes(0.15, 1.0, 0.1), 0.0).mean_s == pytest.approx(0.3)


def test_middle_of_an_interval_of_uncertain_length_is_that_which_a_moment_meets():
    assert Interval(0.2, 0.0).middle_s(0.0) == pytest.approx(0.1)
    assert Interval(0.2, 0.01).middle_s(0.05) == pytest.approx((0.2 + 0.05 + 0.05) / 2.0)


def test_under_jitter_it_does_better_than_the_best_single_lead():
    ratios = []
    for seed in (1, 2, 3, 4):
        rig = Rig(straight(1.0, 0.35, seconds=60, el_deg=20.0), latency=(0.02, 0.3), seed=seed).run(fast)
        times = np.arange(rig.course.start_s + 3.0, rig.course.end_s - 1.0, 0.01)
        off = [rig.at(0, t) - rig.course.at(t)[0] for t in times]
        ratios.append(math.sqrt(np.mean(np.square(off))) / least_error(rig, 0))
    assert np.mean(ratios) < 0.985


@pytest.mark.parametrize("rate", [0.5, -0.5])
def test_half_the_play_is_taken_up_whichever_way_it_turns(rate):
    play = 0.06
    model = geared(play_deg=play, mean_overshoot_up_deg=0.0, mean_overshoot_down_deg=0.0)
    straight_on = straight(rate, 0.0, seconds=60)
    rig = Rig(straight_on, model)
    rig.course = course_of_motors(straight_on, model)
    rig.run(fast)
    times = np.arange(straight_on.start_s + 3.0, straight_on.end_s - 1.0, 0.05)
    off = shaft(rig, 0, times, play) - straight_on.sample(times)[0]
    assert abs(np.mean(off)) < 0.006


def test_course_of_the_motors_changes_sides_where_the_axis_turns_back():
    t = np.arange(0.0, 101.0)
    course = Curve(t, 100.0 + 0.5 * t, 50.0 - 0.01 * (t - 50.0) ** 2)
    motors = course_of_motors(
        course, geared(play_deg=0.06, mean_overshoot_up_deg=0.01, mean_overshoot_down_deg=0.02), (-423.0, 400.0),
        (18.0, 65.0),
    )  # fmt: skip
    assert motors.az_deg - course.az_deg == pytest.approx(0.02)
    lead = motors.el_deg - course.el_deg
    assert lead[:50] == pytest.approx(0.02)
    assert lead[51:] == pytest.approx(-0.01)
    assert lead[50] == 0.0


def test_course_of_the_motors_stays_within_what_may_be_commanded():
    t = np.arange(0.0, 101.0)
    course = Curve(t, 23.0 - 0.5 * t, 18.0 + 0.47 * t)
    model = geared(play_deg=0.06, mean_overshoot_up_deg=0.0, mean_overshoot_down_deg=0.0)
    inside = course_of_motors(course, model, (-27.0, 23.3), (18.0, 65.0))
    assert inside.el_deg.max() == 65.0
    assert inside.az_deg.min() == -27.0
    # Without known limits it goes no further than the target does.
    alone = course_of_motors(course, model)
    assert (alone.az_deg.min(), alone.el_deg.max()) == (course.az_deg.min(), course.el_deg.max())


@pytest.mark.parametrize(
    "facts",
    [
        {},
        {"play_deg": 0.06},
        {"mean_overshoot_up_deg": 0.03, "mean_overshoot_down_deg": 0.04},
        {"play_deg": 0.06, "mean_overshoot_down_deg": 0.04},
    ],
)
def test_one_without_the_other_changes_nothing(facts):
    course = straight(0.5, 0.2)
    assert np.array_equal(course_of_motors(course, geared(**facts)).az_deg, course.az_deg)
    assert geared(**facts).azimuth.least_way_deg(1.0) == 0.0


def test_way_so_short_that_the_motor_would_come_back_is_not_sent():
    model = geared(play_deg=0.0, mean_overshoot_up_deg=0.03, mean_overshoot_down_deg=0.04)
    rig = Rig(straight(0.1, -0.1, seconds=30), model).run(fast)
    steps = np.diff([step.deg for _, step in rig.sends(0)]), np.diff([step.deg for _, step in rig.sends(1)])
    assert steps[0].min() > 0.05 - 0.009
    assert steps[1].max() < -(0.06 - 0.0145)
    hidden = replace(model.azimuth, play_deg=0.06)
    assert hidden.least_way_deg(1.0) == 0.0


@pytest.mark.parametrize(
    ("play", "overshoot", "lead", "gliding"),
    [
        (0.06, 0.0, 0.03, 0.0),
        (0.06, 0.02, 0.01, 0.02),
        (0.06, 0.03, 0.0, 0.03),
        (0.06, 0.04, 0.0, 0.03),  # in short ways it is 0.027 to 0.04: nothing tells on which side of the half play
        (0.0, 0.03, -0.02, 0.02),
        (None, 0.03, 0.0, 0.03),
        (0.06, None, 0.0, 0.03),
        (None, None, 0.0, 0.0),
    ],
)
@pytest.mark.parametrize("way", [2.0, -2.0])
def test_what_cancels_is_left_alone_and_a_gliding_axis_takes_up_half_the_play(play, overshoot, lead, gliding, way):
    axis = geared(play_deg=play, mean_overshoot_up_deg=overshoot, mean_overshoot_down_deg=overshoot).azimuth
    assert axis.lead_deg(way) == pytest.approx(math.copysign(1.0, way) * lead)
    assert axis.gliding_lead_deg(way) == pytest.approx(math.copysign(1.0, way) * gliding)


@pytest.mark.parametrize(("rate", "behind"), [(0.3, 0.05), (-0.3, 0.05), (0.3, -0.05)])
def test_axis_that_ends_short_of_each_goal_is_sent_further_and_one_that_runs_past_is_not(rate, behind):
    axis = replace(CARRYOUT_G2.azimuth, overshoot_deg=0.05)

    class Short(Rig):
        """Its azimuth stands short of where it was sent, in the direction of travel."""

        def at(self, axis, when=None):
            return super().at(axis, when) - (math.copysign(1.0, rate) * behind if axis == 0 else 0.0)

    rig = Short(straight(rate, 0.0, seconds=50), CARRYOUT_G2.with_axes(axis)).run(fast)
    times = np.arange(rig.course.start_s + 30.0, rig.course.end_s - 1.0, 0.1)
    mean = np.mean([rig.at(0, t) - rig.course.at(t)[0] for t in times]) * math.copysign(1.0, rate)
    assert mean == pytest.approx(0.0 if behind > 0.0 else 0.05, abs=0.01)
