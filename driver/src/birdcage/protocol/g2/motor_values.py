"""What the motor menus tell, as values."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class StepCounts:
    """Where the axes stand, in microsteps; None for one that is not homed."""

    az_steps: int | None
    el_steps: int | None


@dataclass(frozen=True, slots=True)
class MotorSpeeds:
    """Speeds, or the greatest ones; None for one whose unit is not certain."""

    az_deg_s: float | None
    el_deg_s: float | None


@dataclass(frozen=True, slots=True)
class Accelerations:
    """The greatest accelerations; None for one whose unit is not certain."""

    az_deg_s2: float | None
    el_deg_s2: float | None


@dataclass(frozen=True, slots=True)
class ElevationLimits:
    """NVS 101, 102 and 103: the firmware's floor, ceiling and home."""

    min_deg: float
    max_deg: float
    home_deg: float


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains of a control loop, in the firmware's own units."""

    motor: int | None
    """None if the dish prints one set for all."""
    kp: float
    kv: float
    ki: float | None
    """None at the stepper menu, which has none."""


@dataclass(frozen=True, slots=True)
class MotorEntry:
    """One motor of the list."""

    index: int
    name: str
    state: str | None
    """As printed."""


@dataclass(frozen=True, slots=True)
class HomingReport:
    """What homing printed. What it did not print is None."""

    wrap_min_deg: float | None
    """How far the cable lets the azimuth turn back from its reference: -423.33 on one unit."""
    wrap_max_deg: float | None
    az_printed: int | None
    """Where the azimuth stands at the end, as a G2+ prints it: 1 has been seen, and its unit is not documented."""
    turn: int | None
    """On which turn of the cable."""
