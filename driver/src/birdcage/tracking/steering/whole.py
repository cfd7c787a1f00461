"""Steers a dish that is always sent both axes at once, and takes its next command only when it rests.

Each step names where the target will be in the middle of the time for which the dish is nearest to it: it leaves when
the command arrives, and stays until the next one does. Nothing is read.
"""

from __future__ import annotations

from birdcage.antenna.motion import plan_axis
from birdcage.rotator.facts import Facts
from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.steps import SlewTo, Steps, Wait

RESTS_S = 0.75
"""From the end of a move until the next command leaves: the proof that it is over, and the line. At first a guess."""
LEARNS = 0.3
"""Part that the last step has in what is expected of the next one."""
WAIT_S = 0.1
"""How long it waits where nothing has to move."""
ROUNDS = 3
"""Of the fixed point between where a move ends and how long it takes."""


def steer(guide: ControllerInput) -> Steps:
    """Follow step by step."""
    az_deg, el_deg, now_s = guide.start_az_deg, guide.start_el_deg, guide.now_s
    bands = guide.least_way_deg(guide.model.azimuth), guide.least_way_deg(guide.model.elevation)
    lasts_s: float | None = None
    while now_s < guide.until_s:
        course = guide.course()
        to = course.at(now_s)
        for _ in range(ROUNDS):
            moves_s = move_s(guide.model, to[0] - az_deg, to[1] - el_deg)
            step_s = moves_s + RESTS_S if lasts_s is None else lasts_s
            # What a step takes is measured; of a dish that is faster than its facts it tells how fast at the least.
            moves_s = min(moves_s, max(step_s - RESTS_S, 0.0))
            to = course.at(max(now_s + guide.latency_s + (step_s + moves_s) / 2.0, guide.from_s))
        if abs(to[0] - az_deg) < bands[0] and abs(to[1] - el_deg) < bands[1]:
            now_s = (yield Wait(min(now_s + WAIT_S, guide.until_s))).now_s
            continue
        began_s, (az_deg, el_deg) = now_s, to
        now_s = (yield SlewTo((to,))).now_s
        took_s = now_s - began_s
        lasts_s = took_s if lasts_s is None else lasts_s + LEARNS * (took_s - lasts_s)


def move_s(model: Facts, az_way_deg: float, el_way_deg: float) -> float:
    """Return how long a move takes by the facts, where it is not known that the axes go at once: in turn."""
    return sum(
        plan_axis(axis, 0.0, abs(way_deg)).duration_s
        for axis, way_deg in ((model.azimuth, az_way_deg), (model.elevation, el_way_deg))
    )
