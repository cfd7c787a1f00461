"""The plain values of the public API."""

from __future__ import annotations

from dataclasses import dataclass

MOTOR_AZIMUTH = 0
MOTOR_ELEVATION = 1


@dataclass
class Position:
    """Where the dish points, in degrees, in the dish's own frame."""

    azimuth: float
    elevation: float
    skew: float | None = None


@dataclass
class RssiReading:
    """Signal strength as the DVB tuner counts it: `reads` samples, their `average`, and the `current` one."""

    reads: int
    average: int
    current: int
