"""Either firmware, put together with its motors and its lines."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.dish import DishMechanics
from birdcage.sim.easycomm.knobs import EasycommSettings
from birdcage.sim.easycomm.mechanics import ServoDish, StepperDish
from birdcage.sim.easycomm.rp2040 import Rp2040Board
from birdcage.sim.easycomm.shell import LineShell
from birdcage.sim.easycomm.stock import StockBoard
from birdcage.sim.firmware import Firmware, FirmwareHost, FirmwareKind, Send, Shell
from birdcage.sim.machine import Machine
from birdcage.sim.settings import SimSettings
from birdcage.sim.shell import Menu, Script


class EasycommFirmware:
    """Knob `kind` chooses which."""

    def __init__(self, settings: EasycommSettings, host: FirmwareHost) -> None:
        self.menus: Mapping[str, Menu] = {}
        self.dish: DishMechanics
        self.board: Rp2040Board | StockBoard
        if settings.kind == "stock":
            self.baud = 19200
            steppers = StepperDish(settings, host.truth)
            self.dish, self.board = steppers, StockBoard(settings, host, steppers)
        else:
            self.baud = 0
            servos = ServoDish(settings, host.truth)
            self.dish, self.board = servos, Rp2040Board(settings, host, servos)

    def resume(self) -> None:
        """Stand still."""

    def halt(self) -> None:
        """End what it prints by itself."""
        if isinstance(self.board, Rp2040Board):
            self.board.halt()

    def boot(self, *, home: bool = True) -> Script:
        """Return what it does and prints when it gets power."""
        return self.board.boot(home=home)

    def stalled(self, axis: AxisMechanics) -> None:
        """Say nothing: neither firmware notices."""


def line_shell(machine: Machine, settings: SimSettings, firmware: Firmware, send: Send, echo: Send) -> Shell:  # noqa: ARG001
    """Return what reads its lines; nothing echoes."""
    board: Any = firmware.board
    return LineShell(machine, settings, board, send)


KIND = FirmwareKind(EasycommSettings, EasycommFirmware, line_shell)
