"""What a simulated dish needs of a firmware, and what a firmware finds around it: the seam between the two."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.dish import DishMechanics, DishTruth
from birdcage.sim.machine import Machine
from birdcage.sim.shell import ConsoleShell, Menu, Script


class FirmwareHost(Protocol):
    """The device that a firmware runs in."""

    machine: Machine
    shell: ConsoleShell
    """There once the firmware is built."""

    def truth(self) -> DishTruth:
        """Return what the dish really does at this moment."""

    def restart(self) -> None:
        """Start over, as the command `reboot` does; a script under way is gone."""

    def say(self, text: str) -> None:
        """Print something unsolicited, while the shell lives."""


class Firmware(Protocol):
    """A board, its menus, its boot log and the mechanics that it drives."""

    @property
    def baud(self) -> int:
        """The rate at which it speaks."""

    @property
    def dish(self) -> DishMechanics:
        """The mechanics that it drives."""

    @property
    def menus(self) -> Mapping[str, Menu]:
        """Every menu by the word that enters it, and `root`."""

    board: Any
    """What its menus share, for tests that look inside."""

    def resume(self) -> None:
        """Begin as a dish that has been up for an hour."""

    def halt(self) -> None:
        """Give up what it does by itself, as when its power goes."""

    def boot(self, *, home: bool = True) -> Script:
        """Read its settings memory at once, and return the boot log; without `home` nothing moves by itself."""

    def stalled(self, axis: AxisMechanics) -> None:
        """Take note that a moving axis was blocked, and that the motor has stopped."""
