"""HandEra HAL 1.00.065, put together."""

from __future__ import annotations

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.carryout.board import CarryoutBoard
from birdcage.sim.carryout.boot import boot_log
from birdcage.sim.carryout.knobs import CarryoutSettings
from birdcage.sim.carryout.mechanics import CarryoutDish
from birdcage.sim.carryout.menus import CarryoutMenu, CarryoutNvsMenu, CarryoutRootMenu, OsMenu
from birdcage.sim.carryout.search import CarryoutSearch
from birdcage.sim.carryout.target import TargetMenu
from birdcage.sim.firmware import FirmwareHost, FirmwareKind
from birdcage.sim.shell import Menu, Script


class CarryoutFirmware:
    """The Winegard Carryout of 2003."""

    baud = 57600
    """`docs/reference/carryout-2003.md`, *Line*."""

    def __init__(self, settings: CarryoutSettings, host: FirmwareHost) -> None:
        self.dish = CarryoutDish(settings, host.truth)
        self.board = CarryoutBoard(settings, host, self.dish)
        self.search = CarryoutSearch(self.board)
        own = (word for word in settings.motor_help.split(",") if word)
        self.menus: dict[str, Menu] = {
            "root": CarryoutRootMenu(self.board),
            "target": TargetMenu(self.board, self.search),
            "motor": CarryoutMenu(self.board, "motor", *own),
            "dvb": CarryoutMenu(self.board, "dvb"),
            "os": OsMenu(self.board, self.search),
            "nvs": CarryoutNvsMenu(self.board),
        }

    def resume(self) -> None:
        """Stand still, or search (setting `searching`)."""
        if self.board.settings.searching:
            self.search.start()

    def halt(self) -> None:
        """Give up the search, every move that waits, and the records."""
        self.search.halt()
        self.board.drive.drop()
        self.board.records.end()

    def boot(self, *, home: bool = True) -> Script:
        """Read the settings memory, and return the boot log."""
        self.board.memory.power_on()
        return boot_log(self.board, self.search, home=home)

    def stalled(self, axis: AxisMechanics) -> None:  # noqa: ARG002
        """Say so (setting `stall_text`)."""
        self.board.stalled()


KIND = FirmwareKind(CarryoutSettings, CarryoutFirmware)
