"""What a machine says of a motor that does not turn, or does not find its reference."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class MotorTrouble:
    """An axis in trouble."""

    axis: str
    """Its name."""
    homing: bool
    """Whether it failed to find its reference: its angles mean nothing then."""
    said: str
    """As the machine put it."""
