"""Reads off a raw line where it sends the dish."""

from __future__ import annotations

import math
import re
from dataclasses import replace

from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION
from birdcage.rotator.verdict import RawAim, Verdict


def aimed(verdict: Verdict, match: re.Match[str] | None) -> Verdict:
    """Add to a verdict where its line sends the dish.

    `match` holds the groups `axis` and `angle`, or `az` or `el` or both, when the line is a motion.
    """
    groups = match.groupdict() if match is not None else {}
    for name in ("angle", "az", "el"):
        text = groups.get(name)
        if text is not None and not math.isfinite(_number(text)):
            return replace(verdict, limit=f"`{text}` is not an angle: where the dish goes then is not known.")
    if groups.get("angle") is not None:
        axis, angle = int(groups["axis"]), _number(groups["angle"])
        return replace(verdict, aim=RawAim({axis: angle}, relative=groups["angle"][0] in "+-"))
    named = {MOTOR_AZIMUTH: groups.get("az"), MOTOR_ELEVATION: groups.get("el")}
    angles = {motor: _number(text) for motor, text in named.items() if text is not None}
    return replace(verdict, aim=RawAim(angles)) if angles else verdict


def rises_above(match: re.Match[str], limit_deg: float) -> bool:
    """Return whether a line may send the elevation, its group `el`, higher: also where it can't be read as an angle.

    The group `motor`, where there is one, is the axis that it moves.
    """
    motor = match.groupdict().get("motor")
    if motor is not None and math.isfinite(_number(motor)) and _number(motor) != MOTOR_ELEVATION:
        return False
    angle = _number(match["el"])
    return not math.isfinite(angle) or angle > limit_deg


def _number(text: str) -> float:
    """Return the angle; NaN for what is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan
