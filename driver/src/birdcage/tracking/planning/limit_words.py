"""The limits that end a stretch in reach, in words."""

from __future__ import annotations

from birdcage.sky.reach_limits import ReachLimits


def where_words(reason: str, limits: ReachLimits) -> str:
    """Return where the target is that is lost for a reason of `Reach`: `below the 18° floor`."""
    if reason == "floor":
        return f"below the {limits.el_floor_deg:g}° floor"
    if reason == "ceiling":
        return f"above the {limits.el_ceiling_deg:g}° ceiling"
    if reason == "horizon":
        return "behind the horizon mask"
    return "beyond the cable stop" if reason == "cable" else f"in {reason}" if ":" in reason else reason
