"""A rotctld and its rotator, put together."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.firmware import Firmware, FirmwareHost, FirmwareKind, Send
from birdcage.sim.machine import Machine
from birdcage.sim.rotctl.answers import Answerer
from birdcage.sim.rotctl.knobs import RotctlSettings
from birdcage.sim.rotctl.mechanics import RotatorMechanics
from birdcage.sim.rotctl.shell import RotctldShell
from birdcage.sim.settings import SimSettings
from birdcage.sim.shell import Menu, Script


class RotctlFirmware:
    """A server without menus: its whole answer is its table of commands."""

    baud = 0
    """TCP has none."""
    menus: Mapping[str, Menu] = {}

    def __init__(self, settings: RotctlSettings, host: FirmwareHost) -> None:
        self.dish = RotatorMechanics(settings, host.truth)
        self.board = Answerer(host.machine, settings, self.dish)

    def resume(self) -> None:
        """Stand still."""

    def halt(self) -> None:
        """It does nothing by itself."""

    def boot(self, *, home: bool = True) -> Script:  # noqa: ARG002 - it never homes
        """Say nothing."""
        yield from ()

    def stalled(self, axis: AxisMechanics) -> None:
        """It says nothing of that, either."""


def rotctld_shell(machine: Machine, settings: SimSettings, firmware: Firmware, send: Send, _echo: Send) -> RotctldShell:
    """Return what reads the wire of a server."""
    assert isinstance(settings, RotctlSettings)
    return RotctldShell(machine, settings, firmware.board, send)


KIND = FirmwareKind(RotctlSettings, RotctlFirmware, rotctld_shell, scheme="rotctl")
