"""A machine that may be asked where it is only now and then: a look that must wait keeps no command back."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import pytest
from birdcage.hamlib.model import FACTS
from birdcage.protocol.hal.model import TRAVLER
from birdcage.tracking.steering.fast import fast
from birdcage.tracking.steering.queued import queued
from birdcage.tracking.steps import ReadPosition

from .rig import Rig, straight

APART_S = 1.0
ASKED_AGAIN = 3
"""So often the machine is asked for one look, where the reading before could not be believed."""


@dataclass
class PacedRig(Rig):
    """Asks no oftener than the machine may be asked, as `AzEl.look` does; for its tenth look several times."""

    again: int = ASKED_AGAIN

    def __post_init__(self):
        super().__post_init__()
        self.asked = self.now - APART_S
        self.looks = 0

    def do(self, step):
        if not isinstance(step, ReadPosition):
            return super().do(step)
        self.looks += 1
        for _ in range(self.again if self.looks == 10 else 1):
            self.now = self.asked = max(self.now, self.asked + APART_S)
            answer = super().do(step)
        return answer

    def longest_silence_s(self):
        """Return for how long no command went out at most, once the look that takes long is over."""
        times = [at for at, _step in self.sends() if at > self.course.start_s + 20.0]
        return max(later - earlier for earlier, later in pairwise(times))


def followed(controller, model, mode="retarget", **options):
    paced = replace(model, least_look_interval_s=APART_S)
    return PacedRig(straight(0.5, 0.1, seconds=60), model=paced, mode=mode, latency=(0.005, 0.02), **options).run(
        controller
    )


@pytest.mark.parametrize(("controller", "model", "mode"), [(fast, FACTS, "retarget"), (queued, TRAVLER, "queue")])
def test_commands_go_on_after_a_look_that_took_long(controller, model, mode):
    rig = followed(controller, model, mode)
    assert rig.looks > 30
    assert rig.longest_silence_s() < APART_S


@pytest.mark.parametrize(("controller", "model", "mode"), [(fast, FACTS, "retarget"), (queued, TRAVLER, "queue")])
def test_a_look_that_took_long_costs_nothing_once_it_is_over(controller, model, mode):
    late, sound = followed(controller, model, mode), followed(controller, model, mode, again=1)
    assert late.rms(settle_s=20.0) < 1.1 * sound.rms(settle_s=20.0)
