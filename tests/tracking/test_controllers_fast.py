"""The controller of a dish whose moves can be replaced on their way."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steps import ReadPosition, Send, Wait

from .rig import Rig, straight

MEAN_S, SPREAD_S = 0.06, 0.023
"""Of a latency that lies between 20 and 100 ms everywhere alike."""


def expected_rms(az_rate, el_rate, interval_s):
    """The saw-tooth of a target that moves on between commands, the unforeseeable latency, and the steps."""
    axes = (az_rate, CARRYOUT_G2.azimuth.step_deg), (el_rate, CARRYOUT_G2.elevation.step_deg)
    return math.sqrt(
        sum((rate * interval_s) ** 2 / 12.0 + (rate * SPREAD_S) ** 2 + step**2 / 6.0 for rate, step in axes)
    )


@pytest.mark.parametrize(("az_rate", "el_rate"), [(1.0, 0.3), (-0.5, 0.5), (0.2, -0.1)])
def test_error_is_the_saw_tooth_of_the_prompt_and_no_more(az_rate, el_rate):
    rig = Rig(straight(az_rate, el_rate, seconds=40, el_deg=40.0)).run(fast)
    assert rig.rms() < 1.3 * expected_rms(az_rate * math.cos(math.radians(40)), el_rate, 2.1 * MEAN_S)


def test_it_neither_leads_nor_lags_on_the_mean():
    rig = Rig(straight(1.0, 0.0, seconds=60)).run(fast)
    times = np.arange(rig.course.start_s + 3.0, rig.course.end_s - 1.0, 0.01)
    bias = np.mean([rig.at(0, t) - rig.course.at(t)[0] for t in times])
    assert abs(bias) < 0.006  # 60 ms of latency and 30 of half an interval: 6 are left


def test_longer_latency_is_learnt_from_the_prompt():
    rig = Rig(straight(1.0, 0.0, seconds=40), latency=(0.3, 0.3)).run(fast, latency_s=0.06, look_every_s=1e9)
    # Without having learnt it, the dish would lag by 240 ms of a degree a second.
    assert abs(np.mean(rig.errors(settle_s=8.0))) < 1.2 * 0.3 * math.cos(math.radians(30)) / 4.0


def test_both_axes_get_their_turn_and_the_faster_one_more_often():
    rig = Rig(straight(1.0, 0.2, seconds=30)).run(fast)
    assert len(rig.sends(0)) > len(rig.sends(1)) > 0.3 * len(rig.sends(0))


def test_dish_that_answers_after_the_move_is_followed_as_well():
    concurrent = Rig(straight(0.5, 0.5, seconds=40)).run(fast)
    blocking = Rig(straight(0.5, 0.5, seconds=40), mode="blocking").run(fast)
    assert blocking.rms() < 1.6 * concurrent.rms()


def test_nothing_is_sent_within_the_dead_band():
    rig = Rig(straight(0.0, 0.0, seconds=10)).run(fast)
    assert not rig.sends()
    assert len(rig.steps) < 10 / 0.02 + 20  # nor does it spin
    assert all(step.until_s - at >= 0.0199 for at, step in rig.steps[:-2] if isinstance(step, Wait))


@pytest.mark.parametrize("option", [{"dead_band_deg": 0.2}, {"dead_band_steps": 20.0}])
def test_dead_band_is_kept(option):
    rig = Rig(straight(0.1, 0.0, seconds=30)).run(fast, **option)
    sends = [step.deg for _, step in rig.sends(0)]
    assert len(sends) > 3
    assert min(np.diff([100.0, *sends])) > 0.17


def test_commands_are_whole_steps():
    rig = Rig(straight(0.7, 0.4, seconds=10)).run(fast)
    for _, send in rig.sends():
        step = rig.model.numbered[send.axis].step_deg
        ends = 100.0, 107.0, 30.0, 34.0  # of the course, which are not exceeded
        assert send.deg in ends or send.deg / step == pytest.approx(round(send.deg / step), abs=1e-6)


def test_position_is_read_once_a_second():
    rig = Rig(straight(0.5, 0.5, seconds=30)).run(fast)
    looks = [at for at, step in rig.steps if isinstance(step, ReadPosition)]
    assert len(looks) == pytest.approx(30, abs=2)


def test_reading_that_contradicts_brings_a_lost_command_again():
    course = straight(0.0, 0.0, seconds=20)
    course.az_deg[2:] += 5.0  # it jumps, and every command for that gets lost
    rig = Rig(course, lost=1.0)

    def mend(rig, step):
        rig.lost = 0.0 if rig.now > course.start_s + 4.0 else 1.0

    rig.run(fast, each=mend)
    assert rig.at(0) == pytest.approx(105.0, abs=0.01)


def test_it_stops_when_the_leg_ends():
    rig = Rig(straight(1.0, 0.3, seconds=60))
    end = rig.now + 7.0
    rig.run(fast, until_s=end)
    assert end <= rig.now < end + 0.11
    assert max(step.deg for _, step in rig.sends(0)) <= rig.course.at(end)[0] + 0.005


def test_course_that_is_replaced_is_followed_from_then_on():
    rig = Rig(straight(0.5, 0.1, seconds=40))

    def replace_it(rig, step):
        if rig.now > rig.course.start_s + 20.0:
            rig.course = replace(rig.course, az_deg=straight(0.5, 0.1, seconds=40, az_deg=101.0).az_deg)

    rig.run(fast, each=replace_it)
    assert rig.at(0) == pytest.approx(121.0, abs=0.1)


def test_closing_it_in_mid_leg_sends_nothing_more():
    rig = Rig(straight(0.5, 0.1))
    activity = fast(rig.guide())
    step = next(activity)
    while not isinstance(step, Send):
        step = activity.send(rig.do(step))
    activity.close()
    with pytest.raises(StopIteration):
        next(activity)


def test_no_command_goes_beyond_what_the_course_asks_for():
    # The ceiling lies between two steps of the motor; the gate refuses what is above it.
    course = straight(0.2, 0.5, seconds=30, el_deg=50.0)
    course.el_deg[:] = np.minimum(course.el_deg, 58.0013)
    rig = Rig(course).run(fast)
    highest = max(step.deg for _, step in rig.sends(1))
    assert 58.0013 - rig.model.elevation.step_deg / 2.0 <= highest <= 58.0013
