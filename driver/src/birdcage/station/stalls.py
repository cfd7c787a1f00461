"""What a firmware says of a motor that does not turn, or does not find its reference (reference section 4)."""

from __future__ import annotations

import re
from dataclasses import dataclass

from birdcage.protocol.model import DishModel

_STALLED = re.compile(r"\b(AZ|EL|SK)\w*\s+MOTOR\s+STALLED\b", re.IGNORECASE)
_NOT_HOMED = re.compile(r"\b(AZ|EL|SK)\w*\s+Motor\s+Home\s+Failure\b", re.IGNORECASE)
_NAMES = {"AZ": "azimuth", "EL": "elevation", "SK": "skew"}


@dataclass(frozen=True, slots=True)
class MotorFault:
    """An axis in trouble, in sentences for a person."""

    axis: str
    homing: bool
    """Whether it failed to find its reference: its angles mean nothing then."""
    what: str
    meaning: str
    remedy: str


def blocked(axis: str, sentence: str) -> MotorFault:
    """Return the fault of an axis that something keeps from turning."""
    return MotorFault(
        axis, homing=False, what=sentence,
        meaning="Something blocks it, or its motor lost steps.",
        remedy="Look at the dish first. Free it, acknowledge, and home it if its angles are wrong.",
    )  # fmt: skip


def motor_fault(text: str, dish: DishModel) -> MotorFault | None:
    """Return what a line of a dish says of a motor; None for any other line."""
    stalled, unhomed = _STALLED.search(text), _NOT_HOMED.search(text)
    found = stalled or unhomed
    if found is None:
        return None
    axis = _NAMES[found[1].upper()]
    if stalled is not None:
        return blocked(axis, f"The {axis} is stalled: the dish says {text.strip()!r}")
    again = "" if dish.homing_s is None else ", or acknowledge and home it"
    freed = f"Find what blocks it, and free it. Then switch it off and on{again}."
    return MotorFault(
        axis, homing=True, what=f"The {axis} did not home: the dish says {text.strip()!r}",
        meaning="It lost its reference, so its angles are meaningless.",
        remedy=dish.handling.home_remedies.get(axis, freed),
    )  # fmt: skip


def stalled_axis(text: str) -> str | None:
    """Return the name of the axis that a line says is stalled, or has failed to home; None for any other line."""
    found = _STALLED.search(text) or _NOT_HOMED.search(text)
    return None if found is None else _NAMES[found[1].upper()]
