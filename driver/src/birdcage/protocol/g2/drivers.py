"""The motor drivers' menu, `A3981>`: two Allegro A3981 (docs/reference/g2-commands.md, *A3981>*)."""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.protocol.motors import AZIMUTH, ELEVATION
from birdcage.protocol.trk.reading import by_axis, only_whole, per_axis, search
from birdcage.protocol.trk.room import Room
from birdcage.rotator.feature import Value

OK, FAULT = "OK", "FAULT"
"""As the dish prints what the fault pins say."""
CURRENT_MODES = ("AUTO", "HiZ", "LoZ")
STEP_MODES = ("AUTO", "FULL", "HALF", "QTR", "EIGHTH", "SIXTEENTH")
TORQUES = ("HIGH", "LOW")
STEP_SIXTEENTHS = ("16", "8", "4", "2", "1")
"""Step sizes as the dish prints them: 16 a full step, 1 a sixteenth."""

_TAGGED = re.compile(r"\bAZ\w*\b")


class Drivers(Room):
    """What the drivers of both motors do, as features by axis."""

    menu: ClassVar[str] = "a3981"

    def current_mode(self) -> dict[str, Value]:
        """Read `current_mode` (`cm`): `AUTO`, `HiZ` or `LoZ`."""
        return per_axis("current_mode", by_axis(self._run("cm"), CURRENT_MODES))

    def faults(self) -> dict[str, Value]:
        """Read `driver`, the fault pins (`diag`): `OK` or `FAULT`."""
        return per_axis("driver", by_axis(self._run("diag"), (OK, FAULT)))

    def step_mode(self) -> dict[str, Value]:
        """Read `step_mode` (`sm`): `AUTO`, or a fixed size from `FULL` to `SIXTEENTH`."""
        return per_axis("step_mode", by_axis(self._run("sm"), STEP_MODES))

    def step_size(self) -> dict[str, Value]:
        """Read `step_size` (`ss`) in sixteenths of a full step: 16, 8, 4, 2 or 1. One number stands for both motors."""
        reply = self._run("ss")
        if search(reply, _TAGGED) is None:
            return per_axis("step_size", dict.fromkeys((AZIMUTH, ELEVATION), only_whole(reply)))
        return per_axis("step_size", {axis: int(size) for axis, size in by_axis(reply, STEP_SIXTEENTHS).items()})

    def torque(self) -> dict[str, Value]:
        """Read `torque` (`st`): `HIGH` while moving, `LOW` while holding."""
        return per_axis("torque", by_axis(self._run("st"), TORQUES))

    def clear_faults(self) -> None:
        """Clear the fault flags (`reset`): a motor that had switched off may be driven again."""
        self._run("reset")
