"""Scales of the strips: which stretch of time, and which angles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.shown.view import View

if TYPE_CHECKING:
    from collections.abc import Sequence

    from birdcage.station.pursuit_state import PointingSample
    from birdcage.tracking.plan import Plan

STEPS_DEG = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0)
"""Upper ends of the scale of errors."""
USUAL = 0.85
"""The part of all errors that are no peak."""
PEAK, OVER_USUAL = 5.0, 2.0
"""So many times the usual error is a peak that gets no room of its own, and so much of it the scale shows then."""
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


def legible_deg(errors_deg: Sequence[float]) -> float:
    """Return the error up to which a scale is to go: the largest, or less where that is a short peak.

    A keyhole's few seconds are dozens of times as bad as the rest of a pass, which would be a flat line beside them.
    """
    ranked = sorted(errors_deg)
    worst, usual = ranked[-1], ranked[int(len(ranked) * USUAL)]
    return worst if worst <= PEAK * usual else OVER_USUAL * usual


def error_top(errors_deg: Sequence[float]) -> float:
    """Return the upper end of the scale of these errors; what is above it is cut off there."""
    if not errors_deg:
        return STEPS_DEG[0]
    wanted_deg = legible_deg(errors_deg) * 1.05
    return next((step for step in STEPS_DEG if step >= wanted_deg), STEPS_DEG[-1])


def shown_deg(look: PointingSample) -> float:
    """Return the error that is drawn: elements and all; where these are of unknown error, that of the dish."""
    return look.error_deg if look.expected_error_deg is None else look.expected_error_deg
