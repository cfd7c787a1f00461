"""Whether two plans are for the same pass of the same target: then one may replace the other under way."""

from __future__ import annotations

from birdcage.tracking.plan import Plan

SAME_S = 300.0
"""Two passes of one satellite are further apart than this; the elements, or where a search began, shift one by less."""


def same_pass(one: Plan, other: Plan) -> bool:
    """Return whether they are. A target that does not pass has one pass only."""
    if (one.aim.kind, one.aim.name, one.aim.norad_id) != (other.aim.kind, other.aim.name, other.aim.norad_id):
        return False
    if one.passing is None or other.passing is None:
        return one.passing is other.passing
    moved_s = abs(one.aim.time_offset_s - other.aim.time_offset_s)
    return abs((one.passing.tca - other.passing.tca).total_seconds()) <= SAME_S + moved_s
