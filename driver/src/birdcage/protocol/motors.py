"""The axes of the family by name, and by the numbers of their motors (on the wire, and in the published interface)."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION, MOTOR_SKEW, Look, Position

AZIMUTH, ELEVATION, SKEW = "azimuth", "elevation", "skew"
MOTORS = {AZIMUTH: MOTOR_AZIMUTH, ELEVATION: MOTOR_ELEVATION, SKEW: MOTOR_SKEW}
_NAMES = {motor: name for name, motor in MOTORS.items()}


def by_name(values: Mapping[int, float]) -> dict[str, float]:
    """Return what is told by motor number, by the name of the axis."""
    return {_NAMES[motor]: value for motor, value in values.items()}


def told(position: Position) -> Look:
    """Return a position as the seam has it."""
    angles = {AZIMUTH: position.azimuth, ELEVATION: position.elevation}
    return Look(angles if position.skew is None else {**angles, SKEW: position.skew})
