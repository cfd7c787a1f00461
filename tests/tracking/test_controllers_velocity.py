"""The controller that matches the speed of the dish to that of the target."""

from __future__ import annotations

import pytest
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steering.velocity import velocity
from birdcage.tracking.steps import Limit, Send

from .rig import Rig, straight


@pytest.mark.parametrize(("az_rate", "el_rate"), [(1.0, 0.3), (-0.5, 0.5), (0.2, -0.1)])
def test_no_saw_tooth_is_left(az_rate, el_rate):
    course = straight(az_rate, el_rate, seconds=40, el_deg=40.0)
    glided = Rig(course).run(velocity)
    # Half a step of both axes, and what a speed in whole steps a second is off over a round.
    assert glided.rms(settle_s=8.0) < 0.012
    assert glided.rms(settle_s=8.0) < Rig(course).run(fast).rms()


def test_each_move_goes_at_the_speed_of_the_target():
    rig = Rig(straight(1.0, 0.0, seconds=30)).run(velocity)
    speeds = [step.speed_deg_s for at, step in rig.steps if isinstance(step, Limit) and 1005.0 < at < 1029.0]
    assert len(speeds) > 20
    assert speeds == pytest.approx([1.0] * len(speeds), rel=0.1)


def test_the_speed_is_set_before_the_move():
    rig = Rig(straight(1.0, 0.3, seconds=10)).run(velocity)
    kinds = "".join(type(step).__name__[0] for _, step in rig.steps if isinstance(step, Limit | Send))
    assert kinds.startswith("SSLLSSLLSS")  # a step to begin with


def test_speeds_are_as_before_when_the_leg_ends_and_the_dish_stands_on_the_course():
    rig = Rig(straight(1.0, 0.3, seconds=60)).run(velocity, until_s=1010.0)
    assert rig.speeds == {0: 65.0, 1: 45.0}
    assert rig.at(0, rig.now + 1.0) == pytest.approx(rig.course.at(1010.0)[0], abs=0.01)


def test_nothing_is_sent_to_a_target_that_stands_still_but_what_ends_the_leg():
    rig = Rig(straight(0.0, 0.0, seconds=10)).run(velocity)
    assert [step for at, step in rig.steps if isinstance(step, Limit | Send) and at < rig.course.end_s] == []


def test_a_late_round_does_not_stop_the_axis():
    rig = Rig(straight(1.0, 0.0, seconds=30), latency=(0.02, 0.3)).run(velocity)
    assert rig.errors(settle_s=8.0).max() < 0.1  # a stop of 0.1 s would cost as much
