"""Compares a motion that a person typed with the limits that the gate would have set it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from birdcage.antenna.gate import MotionGate
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import MOTOR_AZIMUTH
from birdcage.rotator.verdict import Verdict


def limited(verdict: Verdict, gate: MotionGate) -> Verdict:
    """Add to a verdict which limit its motion breaks, as far as that can be said. Any thread."""
    aim = verdict.aim
    if aim is None:
        return verdict
    if aim.relative:
        (axis, step_deg), *_ = aim.angles_deg.items()
        return replace(verdict, limit=_relative(axis, step_deg, gate))
    angles_deg = pointed(aim.angles_deg, gate.model)
    az_deg = angles_deg.get(MOTOR_AZIMUTH)
    el_deg = next((deg for axis, deg in angles_deg.items() if axis != MOTOR_AZIMUTH), None)
    return replace(verdict, limit=_sentence(gate, az_deg, el_deg))


def pointed(angles_deg: Mapping[int, float], model: Facts) -> Mapping[int, float]:
    """Return where angles point that a raw line names: its machine counts from zeros that a person has told."""
    if not model.zero_deg:
        return angles_deg
    there = {motor: deg + model.zero_deg.get(model.numbered[motor].name, 0.0) for motor, deg in angles_deg.items()}
    return {motor: deg % 360.0 if motor == MOTOR_AZIMUTH else deg for motor, deg in there.items()}


def _relative(axis: int, step_deg: float, gate: MotionGate) -> str:
    position, cable_deg, cable = gate.position, gate.cable_deg, gate.cable_limits
    if position is None:
        return ""
    if axis != MOTOR_AZIMUTH:
        return _sentence(gate, None, position.elevation + step_deg)
    if cable is not None and cable_deg is not None:
        goal = cable_deg + step_deg
        beyond = max(cable[0] - goal, goal - cable[1])
        if beyond > 0:
            stop = cable[0] if goal < cable[0] else cable[1]
            return f"It would turn the cable {beyond:.2f}° beyond its stop at {stop:+.2f}°."
    elif cable is not None and abs(step_deg) > (widest := cable[1] - cable[0]):
        return f"A turn of {step_deg:+.2f}° is {abs(step_deg) - widest:.2f}° more than the cable has, {widest:.2f}°."
    return _sentence(gate, (position.azimuth + step_deg) % 360.0, None)


def _sentence(gate: MotionGate, az_deg: float | None, el_deg: float | None) -> str:
    refused = gate.judge(az_deg, el_deg)
    return "" if refused is None else str(refused).removesuffix(" Nothing was sent.")
