"""The faults of motors that do not turn, or do not find their reference, in sentences for a person."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.trouble import MotorTrouble
from birdcage.rotator.facts import Facts


@dataclass(frozen=True, slots=True)
class MotorFault:
    """An axis in trouble, in sentences for a person."""

    axis: str
    homing: bool
    """Whether it failed to find its reference: its angles mean nothing then."""
    what: str
    meaning: str
    remedy: str


def blocked(axis: str, sentence: str, dish: Facts) -> MotorFault:
    """Return the fault of an axis that something keeps from turning."""
    if dish.must_be_synced:
        then = "acknowledge, and sync it if its angles are wrong"
    elif dish.never_homes:
        then = "acknowledge, and check where it points"
    elif dish.homing_s is None:
        then = "acknowledge, and switch it off and on if its angles are wrong"
    else:
        then = "acknowledge, and home it if its angles are wrong"
    return MotorFault(
        axis, homing=False, what=sentence,
        meaning="Something blocks it, or its motor lost steps.",
        remedy=f"Look at the dish first. Free it, {then}.",
    )  # fmt: skip


def motor_fault(trouble: MotorTrouble, dish: Facts) -> MotorFault:
    """Return the fault that a dish tells of."""
    axis = trouble.axis
    if not trouble.homing:
        return blocked(axis, f"The {axis} is stalled: the dish says {trouble.said!r}", dish)
    again = "" if dish.homing_s is None else ", or acknowledge and home it"
    freed = f"Find what blocks it, and free it. Then switch it off and on{again}."
    return MotorFault(
        axis, homing=True, what=f"The {axis} did not home: the dish says {trouble.said!r}",
        meaning="It lost its reference, so its angles are meaningless.",
        remedy=dish.handling.home_remedies.get(axis, freed),
    )  # fmt: skip
