"""What is given to an antenna as its machine: one that is a `Rotator`, or something that a language makes one of."""

from __future__ import annotations

from functools import singledispatch
from typing import Any

from birdcage.rotator.rotator import Rotator


@singledispatch
def as_rotator(machine: Any) -> Rotator:  # noqa: ANN401 - what a language registers
    """Return the machine behind the interface. A language registers what it can make one of."""
    rotator: Rotator = machine
    return rotator
