"""The controller that matches the speed of the dish to that of the target."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.tracking.curve import Curve
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steering.velocity import velocity
from birdcage.tracking.steps import LimitSpeeds, Send

from .rig import DELAY_S, Rig, straight

EARLY_S = 2 * DELAY_S + 2.0
"""How long before the target the dish is in place: time enough for a lost answer and its mending."""


def waiting(course, **options):
    """A dish in place that waits for its target."""
    return Rig(course, early_s=EARLY_S, **options)


def arched(start_s=1000.0, seconds=150.0, peak_deg_s=1.3):
    """A pass that turns the faster the higher it is, and comes down again."""
    t = start_s + np.arange(0.0, seconds + 1.0, 1.0)
    u = (t - start_s) / seconds
    rate = 0.15 + (peak_deg_s - 0.15) * np.sin(np.pi * u) ** 4
    az = 100.0 + np.concatenate(([0.0], np.cumsum((rate[1:] + rate[:-1]) / 2.0)))
    return Curve(t, az, 20.0 + 20.0 * np.sin(np.pi * u))


def losing(at_s, kind):
    """Lose one answer: the first to a step of a kind from a time on."""
    spent = []

    def each(rig, step):
        rig.unanswered = 0.0
        if not spent and rig.now >= at_s and isinstance(step, kind):
            spent.append(rig.now)
            rig.unanswered = 1.0

    return each


@pytest.mark.parametrize(("az_rate", "el_rate"), [(1.0, 0.3), (-0.5, 0.5), (0.2, -0.1)])
def test_no_saw_tooth_is_left(az_rate, el_rate):
    course = straight(az_rate, el_rate, seconds=40, el_deg=40.0)
    glided = waiting(course).run(velocity)
    # Half a step of both axes, and what a speed in whole steps a second is off over a round.
    assert glided.rms(settle_s=8.0) < 0.012
    assert glided.rms(settle_s=8.0) < waiting(course).run(fast).rms()


def test_it_is_on_the_course_from_the_first_moment():
    """The speeds are set before the target comes: no step to begin with, and no round that begins behind it."""
    rig = waiting(straight(1.0, 0.3, seconds=30)).run(velocity)
    assert rig.errors(settle_s=0.0, until_s=1003.0).max() < 0.12
    kinds = "".join(type(step).__name__[0] for _, step in rig.steps if isinstance(step, LimitSpeeds | Send))
    assert kinds.startswith("LSSLSSLSS")


def test_each_move_goes_at_the_speed_of_the_target():
    """Until the dish gets its own speeds back, five seconds before the end."""
    rig = waiting(straight(1.0, 0.0, seconds=35)).run(velocity)
    speeds = [step.speeds_deg_s[0] for at, step in rig.steps if isinstance(step, LimitSpeeds) and 1005.0 < at < 1029.0]
    assert len(speeds) > 20
    assert speeds == pytest.approx([1.0] * len(speeds), rel=0.1)


def test_speeds_are_as_before_when_the_leg_ends_and_the_dish_stands_on_the_course():
    rig = waiting(straight(1.0, 0.3, seconds=60)).run(velocity, until_s=1010.0)
    assert rig.speeds == {0: 65.0, 1: 45.0}
    assert rig.at(0, rig.now + 1.0) == pytest.approx(rig.course.at(1010.0)[0], abs=0.01)


def test_a_target_that_stands_still_is_left_alone():
    rig = waiting(straight(0.0, 0.0, seconds=10)).run(velocity)
    assert [step for _, step in rig.steps if isinstance(step, Send)] == []


def test_it_steps_where_the_line_has_just_lost_an_answer():
    rig = waiting(straight(1.0, 0.3, seconds=20)).run(velocity, answered=20)
    assert [step for _, step in rig.steps if isinstance(step, LimitSpeeds)] == []


def test_a_late_round_does_not_stop_the_axis():
    rig = waiting(straight(1.0, 0.0, seconds=35), latency=(0.02, 0.3)).run(velocity)
    assert rig.errors(settle_s=8.0, until_s=1029.0).max() < 0.1  # a stop of 0.1 s would cost as much


def test_it_does_not_glide_where_it_joins_in_mid_pass():
    """To match the speeds then, it would have to stand for a round, or for as long as a lost answer takes."""
    rig = Rig(straight(1.0, 0.3, seconds=30)).run(velocity)
    assert [step for _, step in rig.steps if isinstance(step, LimitSpeeds)] == []
    assert rig.rms() == pytest.approx(Rig(straight(1.0, 0.3, seconds=30)).run(fast).rms())


@pytest.mark.parametrize("kind", [LimitSpeeds, Send])
@pytest.mark.parametrize("at_s", [1015.0, 1040.0])
def test_the_dish_goes_on_while_the_line_is_silent_after_a_lost_answer(kind, at_s):
    rig = waiting(straight(1.0, 0.2, seconds=60)).run(velocity, each=losing(at_s, kind))
    gaps = [(b - a, a) for (a, _), (b, _) in pairwise(rig.sends()) if a > 1002.0]
    assert kind is Send or max(gaps)[0] > 2 * DELAY_S, "the line was not silent"
    assert rig.errors(settle_s=8.0).max() < 0.16


@pytest.mark.parametrize("kind", [LimitSpeeds, Send])
def test_from_the_first_lost_answer_on_it_steps_at_the_speeds_of_the_dish(kind):
    rig = waiting(straight(1.0, 0.2, seconds=60)).run(velocity, each=losing(1020.0, kind))
    lost_s = next(at for at, step in rig.steps if at >= 1020.0 and isinstance(step, kind))
    limits = [step.speeds_deg_s for at, step in rig.steps if at > lost_s and isinstance(step, LimitSpeeds)]
    assert limits == [{0: 65.0, 1: 45.0}]
    assert rig.speeds == {0: 65.0, 1: 45.0}
    assert len([at for at, _ in rig.sends(0) if at > 1030.0]) > 100, "it does not step"


def test_it_has_its_own_speeds_when_the_leg_ends():
    """A rewind may begin then, and go at them at once, whatever answer is lost before."""
    for faults in (None, losing(1026.0, LimitSpeeds)):
        rig = waiting(straight(1.0, 0.2, seconds=35)).run(velocity, each=faults)
        restored = [at for at, step in rig.steps if isinstance(step, LimitSpeeds)][-1]
        assert restored < 1035.0 - 3.0
        assert rig.now < 1035.3


def test_an_axis_that_never_rests_is_sent_as_far_as_its_overshoot_would_carry_it():
    """The course of the motor counts on the overshoot of steps (decision 0035)."""
    axes = (
        replace(axis, mean_overshoot_up_deg=0.03, mean_overshoot_down_deg=0.04)
        for axis in (CARRYOUT_G2.azimuth, CARRYOUT_G2.elevation)
    )
    model = CARRYOUT_G2.with_axes(*axes)
    rig = waiting(straight(1.0, -0.3, seconds=40, el_deg=40.0), model=model).run(velocity)
    times = np.arange(1010.0, 1034.0, 0.1)
    ahead = [np.mean([rig.at(axis, t) - rig.course.at(t)[axis] for t in times]) for axis in (0, 1)]
    assert ahead == pytest.approx([0.03, -0.04], abs=0.006)


def test_an_answer_lost_while_it_waits_costs_nothing():
    stepped = waiting(straight(1.0, 0.2, seconds=30)).run(fast)
    rig = waiting(straight(1.0, 0.2, seconds=30)).run(velocity, each=losing(0.0, LimitSpeeds))
    assert rig.speeds == {0: 65.0, 1: 45.0}
    assert rig.errors(settle_s=0.0).max() < 1.3 * stepped.errors(settle_s=0.0).max()


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("faults", [
    {"unanswered": 0.08}, {"unanswered": 0.02}, {"unanswered": 0.02, "answered": 1000}, {"latency": (0.02, 0.3)},
    {"unanswered": 0.005, "latency": (0.05, 0.2), "answered": 1000},
], ids=lambda faults: ", ".join(f"{name} {value}" for name, value in faults.items()))  # fmt: skip
def test_it_is_never_worse_than_stepping(faults, seed):
    """Also where the line becomes bad only as the pass begins, after many answers in time (`answered`)."""
    course, faults = arched(peak_deg_s=0.6 + 0.35 * seed), dict(faults)
    before = {"answered": faults.pop("answered")} if "answered" in faults else {}
    glided = waiting(course, seed=seed, **faults).run(velocity, **before)
    stepped = waiting(course, seed=seed, **faults).run(fast)
    assert glided.rms(settle_s=0.0) < 1.15 * stepped.rms(settle_s=0.0)
