"""What a simulated dish needs of a firmware, and what a firmware finds around it: the seam between the two."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Generic, Protocol

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.dish import DishMechanics, DishTruth
from birdcage.sim.machine import Machine
from birdcage.sim.settings import AnySettings, SimSettings
from birdcage.sim.shell import ConsoleShell, Menu, Script

Send = Callable[[bytes], None]
"""Takes bytes that are to go over the wire."""


class Shell(Protocol):
    """What reads the wire and answers: a `ConsoleShell`, or whatever a machine without menus has."""

    menu: str
    """Where it is; `root` where there are no menus."""
    alive: bool
    """Whether it answers until the next power cycle."""
    hears: Callable[[bytes], bytes]
    """What gets through of what comes off the wire."""
    received: deque[tuple[float, str]]
    """Lines that were begun, with the monotonic time of each; bounded."""

    def feed(self, data: bytes) -> None:
        """Take bytes off the wire."""

    def say(self, text: str) -> None:
        """Print something unsolicited."""

    def play(self, script: Script) -> None:
        """Run a script as if a command had started it: the boot log."""

    def reset(self, *, alive: bool = True) -> None:
        """Lose everything, as in a reboot; `alive` False leaves it dead."""


class FirmwareHost(Protocol):
    """The device that a firmware runs in."""

    machine: Machine
    shell: Shell
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


MakeShell = Callable[[Machine, SimSettings, Firmware, Send, Send], Shell]
"""Machine, knobs, firmware, what sends an answer, and what sends an echo."""


def console_shell(machine: Machine, settings: SimSettings, firmware: Firmware, send: Send, echo: Send) -> Shell:
    """Return the shell of a firmware with menus."""
    return ConsoleShell(machine, settings, firmware.menus, send, echo)


@dataclass(frozen=True, slots=True)
class FirmwareKind(Generic[AnySettings]):
    """A simulated firmware: the knobs that it has, how it is built into a device, and what reads its wire.

    Each is an entry point of the group `birdcage.twins`: its name follows `sim:`, as in `sim:g2`.
    """

    settings: type[AnySettings]
    build: Callable[[AnySettings, FirmwareHost], Firmware]
    shell: MakeShell = console_shell
    scheme: str = ""
    """Under which scheme a program reaches it, where it is a server: it is then served over TCP and on no pty."""
