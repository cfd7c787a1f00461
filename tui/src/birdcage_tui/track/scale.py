"""Scales of the strips: which stretch of time, and which angles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.track.pursuing import pursuit_of
from birdcage_tui.view import View

if TYPE_CHECKING:
    from birdcage.station.pursuit import Sample
    from birdcage.tracking.plan import Plan

STEPS_DEG = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0)
"""Upper ends of the scale of errors."""
AROUND_S = 600.0
"""What is shown before and after now of a target that does not pass."""


def window(plan: Plan, view: View) -> tuple[float, float]:
    """Return from when until when a plan is shown: the pass, or some time around now."""
    start_s, end_s = plan.sky.start_s, plan.sky.end_s
    if plan.passing is not None:
        return start_s, end_s
    now_s = view.utc.timestamp()
    first = max(min(now_s - AROUND_S / 2, end_s - 2 * AROUND_S), start_s)
    return first, min(first + 2 * AROUND_S, end_s)


def error_top(view: View, plan: Plan) -> float:
    """Return the upper end of the scale of errors: what was and what is expected fit."""
    worst = 0.0
    if plan.pointing is not None:
        worst = plan.pointing.dish.max_deg if plan.pointing.median is None else plan.pointing.median.max_deg
    pursuit = pursuit_of(view)
    if pursuit is not None and pursuit.plan is plan:
        worst = max([worst, *(shown_deg(look) for look in view.followed)])
    return next((step for step in STEPS_DEG if step >= worst * 1.05), STEPS_DEG[-1])


def shown_deg(look: Sample) -> float:
    """Return the error that is drawn: elements and all; where these are of unknown error, that of the dish."""
    return look.error_deg if look.expected_error_deg is None else look.expected_error_deg
