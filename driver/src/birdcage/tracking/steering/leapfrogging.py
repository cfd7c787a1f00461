"""Steers as the earlier scripts do: once a second to where the target is now, and beyond by a fixed table.

Kept by name for those who want it (`docs/reference/published-interface.md`, *Leapfrog*). In simulation it makes a
well-posed pass worse (`scripts/bench/tracking.py`).
"""

from __future__ import annotations

from birdcage.base.geometry import shortest_turn
from birdcage.leapfrog import overshoot
from birdcage.rotator.axis import Axis
from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.steps import ReadPosition, Send, Steps, Wait

EVERY_S = 1.0


def leapfrog(guide: ControllerInput) -> Steps:
    """Read the position, then send both axes; the overshoot is reckoned from the reading, never from an assumption."""
    model = guide.model
    sent = {model.azimuth.index: guide.start_az_deg, model.elevation.index: guide.start_el_deg}
    now_s = guide.now_s
    while now_s < guide.until_s:
        tick_s = now_s
        seen = yield ReadPosition()
        now_s = seen.now_s
        target = guide.course().at(now_s)
        for axis, wanted_deg, read_deg in zip(
            (model.azimuth, model.elevation), target, (seen.az_deg, seen.el_deg), strict=True
        ):
            goal_deg = _beyond(axis, wanted_deg, read_deg, turns=axis is model.azimuth)
            if abs(goal_deg - sent[axis.index]) >= guide.least_way_deg(axis) and now_s < guide.until_s:
                now_s = (yield Send(axis.index, goal_deg)).now_s
                sent[axis.index] = goal_deg
        now_s = (yield Wait(min(max(tick_s + EVERY_S, now_s), guide.until_s))).now_s


def _beyond(axis: Axis, wanted_deg: float, read_deg: float | None, *, turns: bool) -> float:
    if read_deg is None:
        return wanted_deg
    beyond = wanted_deg + overshoot(shortest_turn(read_deg, wanted_deg) if turns else wanted_deg - read_deg)
    return beyond if turns else min(max(beyond, axis.min_deg), axis.max_deg)
