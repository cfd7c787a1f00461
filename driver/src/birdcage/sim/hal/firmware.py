"""HAL 2.05.003 and HAL 0.0.00, put together."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.firmware import FirmwareHost, FirmwareKind
from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.boot import boot_log, restart_log
from birdcage.sim.hal.knobs import Hal000Settings, HalSettings
from birdcage.sim.hal.mechanics import HalDish
from birdcage.sim.hal.menu import HalMenu
from birdcage.sim.hal.motor import MotorMenu
from birdcage.sim.hal.ngsearch import NgsearchMenu
from birdcage.sim.hal.nvs import HalNvsMenu
from birdcage.sim.hal.root import HalRootMenu
from birdcage.sim.hal.search import HalSearch
from birdcage.sim.hal.tasks import TaskMenu
from birdcage.sim.shell import Menu, Script


class HalFirmware:
    """The Trav'ler LG-2112 (`docs/reference/travler.md`)."""

    baud = 57600
    """`docs/reference/travler.md`, *Line*."""

    def __init__(self, settings: HalSettings, host: FirmwareHost) -> None:
        self.dish = HalDish(settings, host.truth)
        self.board = self._board(settings, host)
        self.search = HalSearch(self.board)
        submenus = self._submenus()
        self.menus: dict[str, Menu] = {"root": HalRootMenu(self.board, tuple(submenus)), **submenus}

    def _board(self, settings: HalSettings, host: FirmwareHost) -> HalBoard:
        return HalBoard(settings, host, self.dish)

    def _submenus(self) -> Mapping[str, HalMenu]:
        """Return the menus of HAL 2.05 that the root leads to, by name."""
        return {
            "motor": MotorMenu(self.board),
            "ngsearch": NgsearchMenu(self.board, self.search),
            "nvs": HalNvsMenu(self.board),
        }

    def resume(self) -> None:
        """Stand still, or search (setting `searching`)."""
        if self.board.settings.searching:
            self.search.start()

    def halt(self) -> None:
        """Give up the search and every move that waits."""
        self.search.halt()
        self.board.drop()
        self.board.turn.held = False

    def boot(self, *, home: bool = True) -> Script:
        """Read the settings memory, and return the boot log."""
        self.board.memory.power_on()
        return boot_log(self.board, self.search) if home else restart_log(self.board)

    def stalled(self, axis: AxisMechanics) -> None:
        """Say so (setting `stall_text`), and begin the move that waits."""
        self.board.stalled(axis)


class Hal000Firmware(HalFirmware):
    """The older one: `mot`, and a menu of tasks in which the search is killed."""

    def __init__(self, settings: Hal000Settings, host: FirmwareHost) -> None:
        self._settings = settings
        super().__init__(settings, host)

    def _submenus(self) -> Mapping[str, HalMenu]:
        return {
            "mot": MotorMenu(self.board),
            "os": TaskMenu(self.board, self.search, self._settings),
            "nvs": HalNvsMenu(self.board),
        }


KIND_205 = FirmwareKind(HalSettings, HalFirmware)
KIND_000 = FirmwareKind(Hal000Settings, Hal000Firmware)
