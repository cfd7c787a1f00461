"""The motor drivers' menu, `A3981>`: two Allegro A3981 (docs/reference/g2-commands.md, *A3981>*)."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.protocol.g2.reading import PerAxis, by_axis, only_whole, search
from birdcage.protocol.g2.room import Room

CURRENT_MODES = ("AUTO", "HiZ", "LoZ")
STEP_MODES = ("AUTO", "FULL", "HALF", "QTR", "EIGHTH", "SIXTEENTH")
TORQUES = ("HIGH", "LOW")
STEP_SIXTEENTHS = (16, 8, 4, 2, 1)
"""Step sizes as the dish prints them: 16 a full step, 1 a sixteenth."""

_TAGGED = re.compile(r"\bAZ\w*\b")


class Drivers(Room):
    """What the drivers of both motors do."""

    menu: ClassVar[str] = "a3981"

    def current_mode(self) -> PerAxis[str]:
        """Read `cm`: `AUTO`, `HiZ` or `LoZ`."""
        return by_axis(self._run("cm"), {mode: mode for mode in CURRENT_MODES})

    def faults(self) -> PerAxis[bool]:
        """Read the fault pins (`diag`): True is a fault."""
        return by_axis(self._run("diag"), {"OK": False, "FAULT": True})

    def step_mode(self) -> PerAxis[str]:
        """Read `sm`: `AUTO`, or a fixed size from `FULL` to `SIXTEENTH`."""
        return by_axis(self._run("sm"), {mode: mode for mode in STEP_MODES})

    def step_size_sixteenths(self) -> PerAxis[int]:
        """Read `ss`: a step in sixteenths of a full one, 16, 8, 4, 2 or 1; one number stands for both motors."""
        reply = self._run("ss")
        sizes = {str(size): size for size in STEP_SIXTEENTHS}
        if search(reply, _TAGGED):
            return by_axis(reply, sizes)
        size = only_whole(reply)
        return PerAxis(size, size)

    def torque(self) -> PerAxis[str]:
        """Read `st`: `HIGH` while moving, `LOW` while holding."""
        return by_axis(self._run("st"), {torque: torque for torque in TORQUES})

    def clear_faults(self) -> None:
        """Clear the fault flags (`reset`): a motor that had switched off may be driven again."""
        self._run("reset")
