"""The limits that end a stretch in reach, in words."""

from __future__ import annotations

from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.reach_model import LossCause, LossReason


def where_words(cause: LossCause, limits: ReachLimits) -> str:
    """Return where the target is that a limit keeps out of reach: `below the 18° floor`."""
    if cause.reason is LossReason.FLOOR:
        return f"below the {limits.el_floor_deg:g}° floor"
    if cause.reason is LossReason.CEILING:
        return f"above the {limits.el_ceiling_deg:g}° ceiling"
    if cause.reason is LossReason.HORIZON:
        return "behind the horizon mask"
    if cause.reason is LossReason.CABLE:
        return "beyond the cable stop"
    return f"in {cause.words}" if cause.sector else cause.words
