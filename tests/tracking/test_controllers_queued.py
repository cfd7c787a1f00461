"""The controller of a dish that moves one axis at a time and keeps every command."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.facts import Readback
from birdcage.tracking.move_times import durations, progress, ramps
from birdcage.tracking.steering.choice import CONTROLLERS
from birdcage.tracking.steering.lookahead import Lookahead
from birdcage.tracking.steering.queued import queued
from birdcage.tracking.steps import ReadPosition, Send

from .rig import Rig, straight

SLOW = TRAVLER.with_axes(
    replace(TRAVLER.azimuth, speed_deg_s=5.0, times=None),
    replace(TRAVLER.elevation, speed_deg_s=5.0, times=None),
)


def interval_s(az_rate, el_rate):
    """How long both axes need for a move each, one after the other, of what the target went meanwhile."""
    # t = 2 sqrt(rate t / a) of each axis, so that sqrt(t) = 2 (sqrt(r1) + sqrt(r2)) / sqrt(a).
    root = 2.0 * (math.sqrt(abs(az_rate)) + math.sqrt(abs(el_rate))) / math.sqrt(20.0)
    return root * root


@pytest.mark.parametrize(("az_rate", "el_rate"), [(1.0, 0.3), (-0.5, 0.5), (0.8, -0.1)])
def test_error_is_the_saw_tooth_of_axes_that_move_in_turn(az_rate, el_rate):
    rig = Rig(straight(az_rate, el_rate, seconds=40, el_deg=45.0), SLOW, "queue").run(queued)
    rates = az_rate * math.cos(math.radians(45.0)), el_rate
    limit = math.sqrt(sum((rate * interval_s(az_rate, el_rate)) ** 2 / 12.0 for rate in rates))
    assert rig.rms() < 1.3 * limit


@pytest.mark.parametrize("model", [SLOW, TRAVLER])
def test_never_more_than_one_command_waits(model):
    rig = Rig(straight(1.0, 0.4, seconds=60), model, "queue").run(queued)
    assert len(rig.sends()) > 60
    assert rig.largest_backlog <= 1


def test_next_command_arrives_as_the_move_ends():
    rig = Rig(straight(1.0, 0.3, seconds=40), SLOW, "queue", latency=(0.06, 0.06)).run(queued, look_every_s=1e9)
    begins = sorted(began for ways in rig.ways.values() for began, _ in ways[1:])
    lasts = {began: slew.duration_s for ways in rig.ways.values() for began, slew in ways[1:]}
    idle = [later - (earlier + lasts[earlier]) for earlier, later in pairwise(begins[5:])]
    assert max(idle) < 0.01


def test_nothing_is_sent_within_the_dead_band():
    rig = Rig(straight(0.0, 0.0, seconds=10), SLOW, "queue").run(queued)
    assert not rig.sends()
    assert len(rig.steps) < 10 / 0.05 + 40


def test_dead_band_is_kept():
    rig = Rig(straight(0.1, 0.0, seconds=30), SLOW, "queue").run(queued, dead_band_deg=0.2)
    sends = [step.deg for _, step in rig.sends(0)]
    assert len(sends) > 3
    assert min(np.diff([100.0, *sends])) >= 0.2 - 1e-9


def test_it_stops_when_the_leg_ends():
    rig = Rig(straight(1.0, 0.3, seconds=60), SLOW, "queue")
    end = rig.now + 7.0
    rig.run(queued, until_s=end)
    assert end <= rig.now < end + 0.11


def test_course_that_is_replaced_is_followed_from_then_on():
    rig = Rig(straight(0.5, 0.1, seconds=40), SLOW, "queue")

    def replace_it(rig, step):
        if rig.now > rig.course.start_s + 20.0:
            rig.course = straight(0.5, 0.1, seconds=40, az_deg=101.0)

    rig.run(queued, each=replace_it)
    assert rig.at(0) == pytest.approx(121.0, abs=0.3)


def test_position_is_read_about_once_a_second_between_commands():
    rig = Rig(straight(0.5, 0.2, seconds=30), SLOW, "queue").run(queued)
    assert sum(isinstance(step, ReadPosition) for _, step in rig.steps) == pytest.approx(28, abs=4)


@pytest.mark.parametrize(("model", "mode"), [(SLOW, "queue"), (None, "retarget")])
def test_dish_without_a_position_is_steered_by_its_model_and_never_asked(model, mode):
    options = {} if model is None else {"model": replace(model, readback=Readback.NEVER)}
    rig = Rig(straight(0.5, 0.2, seconds=30), mode=mode, tells=False, **options).run(CONTROLLERS["modelled"])
    assert {type(step) for _, step in rig.steps if not hasattr(step, "until_s")} == {Send}
    assert rig.rms() < 0.15


def test_moves_of_many_last_as_the_planner_of_one_has_it():
    from birdcage.antenna.motion import plan_axis

    ways = np.array([0.0, 0.02, 0.7, 1.25, 3.0, 80.0])
    for axis in (SLOW.azimuth, TRAVLER.azimuth):
        times = durations(axis, ways)
        assert times == pytest.approx([plan_axis(axis, 0.0, way).duration_s for way in ways])
        for way, time, ramp in zip(ways[1:], times[1:], ramps(axis, times)[1:], strict=True):
            slew = plan_axis(axis, 0.0, float(way))
            for share in (0.1, 0.4, 0.5, 0.8):
                gone = float(progress(np.array([share]), np.array([ramp]))[0])
                assert gone * way == pytest.approx(slew.at(share * time)[0], abs=1e-9)


def test_a_long_move_is_scored_until_its_end():
    """A Trav'ler takes 0.3 s for a step and 2.6 s for three degrees, and these begin so slowly that they look good."""
    rig = Rig(straight(-0.54, 0.02, seconds=40, el_deg=43.0), model=TRAVLER, mode="queue").run(queued)
    assert rig.errors().max() < 0.2
    ways = np.abs(np.diff([step.deg for _, step in rig.steps if isinstance(step, Send) and step.axis == 0]))
    assert ways.max() < 1.0


def test_far_axis_goes_first():
    ahead = Lookahead((SLOW.azimuth, SLOW.elevation), (0.005, 0.005))
    course = straight(0.0, 0.0)
    assert ahead.choose(course, (100.1, 35.0), course.start_s).column == 1
    assert ahead.choose(course, (105.0, 30.1), course.start_s).column == 0
    assert ahead.choose(course, (100.0, 30.0), course.start_s) is None


def test_no_command_goes_beyond_what_the_course_asks_for():
    # The ceiling lies between two steps of the motor; the gate refuses what is above it.
    course = straight(0.2, 0.5, seconds=30, el_deg=50.0)
    course.el_deg[:] = np.minimum(course.el_deg, 58.0013)
    rig = Rig(course, SLOW, "queue").run(queued)
    assert max(step.deg for _, step in rig.sends(1)) == 58.0013
