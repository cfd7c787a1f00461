"""Reads a motion off a raw line, and compares it with the limits that the gate would have set it."""

from __future__ import annotations

import math
import re
from dataclasses import replace

from birdcage.protocol.gate import MotionGate
from birdcage.protocol.types import MOTOR_AZIMUTH
from birdcage.rotator.verdict import Verdict


def with_motion(verdict: Verdict, match: re.Match[str] | None, gate: MotionGate) -> Verdict:
    """Add to a verdict where its line sends the dish, and which limit that breaks.

    `match` holds the groups `axis` and `angle`, or `az` and `el`, when the line is a motion. A signed angle counts from
    where the dish stands (source document 001: undocumented, this firmware only): its target is judged and not told,
    as another firmware may take it as it is written.
    """
    groups = match.groupdict() if match is not None else {}
    for name in ("angle", "az", "el"):
        text = groups.get(name)
        if text is not None and not math.isfinite(_number(text)):
            return replace(verdict, limit=f"`{text}` is not an angle: where the dish goes then is not known.")
    if groups.get("angle") is not None:
        axis, angle = int(groups["axis"]), _number(groups["angle"])
        if groups["angle"][0] in "+-":
            return replace(verdict, limit=_relative(axis, angle, gate))
        return replace(verdict, limit=_limit(axis, angle, gate), motion=(axis, angle))
    if groups.get("az") is not None:
        return replace(verdict, limit=_sentence(gate, _number(groups["az"]), _number(groups["el"])))
    return verdict


def _number(text: str) -> float:
    """Return the angle; NaN for what is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def _limit(axis: int, angle_deg: float, gate: MotionGate) -> str:
    return _sentence(gate, *((angle_deg, None) if axis == MOTOR_AZIMUTH else (None, angle_deg)))


def _relative(axis: int, step_deg: float, gate: MotionGate) -> str:
    position, cable_deg, cable = gate.position, gate.cable_deg, gate.cable_limits
    if position is None:
        return ""
    if axis != MOTOR_AZIMUTH:
        return _limit(axis, position.elevation + step_deg, gate)
    if cable is not None and cable_deg is not None:
        goal = cable_deg + step_deg
        beyond = max(cable[0] - goal, goal - cable[1])
        if beyond > 0:
            stop = cable[0] if goal < cable[0] else cable[1]
            return f"It would turn the cable {beyond:.2f}° beyond its stop at {stop:+.2f}°."
    elif cable is not None and abs(step_deg) > (widest := cable[1] - cable[0]):
        return f"A turn of {step_deg:+.2f}° is {abs(step_deg) - widest:.2f}° more than the cable has, {widest:.2f}°."
    return _limit(axis, (position.azimuth + step_deg) % 360.0, gate)


def _sentence(gate: MotionGate, az_deg: float | None, el_deg: float | None) -> str:
    refused = gate.judge(az_deg, el_deg)
    return "" if refused is None else str(refused).removesuffix(" Nothing was sent.")
