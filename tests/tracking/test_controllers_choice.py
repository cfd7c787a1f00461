"""Which controller suits which dish, and the old fixed overshoot."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from birdcage.base.errors import MotionRefused
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.facts import Readback
from birdcage.tracking.steering.choice import controller_for
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steering.leapfrogging import leapfrog
from birdcage.tracking.steps import ReadPosition

from .rig import Rig, straight

MUTE = replace(TRAVLER, readback=Readback.NEVER)


@pytest.mark.parametrize(("model", "name"), [(CARRYOUT_G2, "fast"), (TRAVLER, "queued"), (MUTE, "modelled")])
def test_dish_gets_what_suits_it(model, name):
    assert controller_for(model)[0] == name
    assert controller_for(model, velocity_allowed=True)[0] == name


@pytest.mark.parametrize(
    ("model", "name", "words"),
    [
        (TRAVLER, "fast", "moves one axis at a time"),
        (TRAVLER, "velocity", "moves one axis at a time"),
        (MUTE, "leapfrog", "does not tell its position"),
        (replace(CARRYOUT_G2, features={}), "velocity", "no command for its speeds"),
        (CARRYOUT_G2, "velocity", "velocity_allowed = true"),
    ],
)
def test_what_does_not_suit_is_refused_in_words(model, name, words):
    with pytest.raises(MotionRefused, match=words) as refused:
        controller_for(model, name)
    assert refused.value.reason == "controller"


def test_leapfrog_is_there_by_name():
    assert controller_for(CARRYOUT_G2, "leapfrog") == ("leapfrog", leapfrog)
    assert controller_for(TRAVLER, "leapfrog") == ("leapfrog", leapfrog)


def test_leapfrog_reads_once_a_second_and_aims_beyond_by_the_table():
    rig = Rig(straight(1.8, 0.0, seconds=20), latency=(0.05, 0.05)).run(leapfrog)
    assert sum(isinstance(step, ReadPosition) for _, step in rig.steps) == 20
    beyond = [step.deg - rig.course.at(at)[0] for at, step in rig.sends(0)]
    assert beyond[3:] == pytest.approx(np.full(len(beyond) - 3, 0.5), abs=0.02)  # 1.3 degrees behind: half a degree
    assert not rig.sends(1)


def test_leapfrog_stays_within_the_elevation_of_the_dish():
    rig = Rig(straight(0.0, 3.0, seconds=15, el_deg=20.0)).run(leapfrog)
    assert max(step.deg for _, step in rig.sends(1)) <= CARRYOUT_G2.elevation.max_deg


def test_leapfrog_is_worse_than_what_suits_the_dish():
    course = straight(0.8, 0.2, seconds=30)
    assert Rig(course).run(leapfrog).rms() > 5.0 * Rig(course).run(fast).rms()
