"""HAL 2.05.003, put together."""

from __future__ import annotations

from birdcage.sim.axis import Axis
from birdcage.sim.firmware import Host
from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.boot import boot_log, restart_log
from birdcage.sim.hal.knobs import HalSettings
from birdcage.sim.hal.mechanics import HalDish
from birdcage.sim.hal.motor import Motor
from birdcage.sim.hal.ngsearch import Ngsearch
from birdcage.sim.hal.nvs import Nvs
from birdcage.sim.hal.root import Root
from birdcage.sim.hal.search import Search
from birdcage.sim.shell import Menu, Script


class Hal205Firmware:
    """The Trav'ler LG-2112 (`docs/reference/travler.md`)."""

    baud = 57600
    """`docs/reference/travler.md`, *Line*."""

    def __init__(self, settings: HalSettings, host: Host) -> None:
        self.dish = HalDish(settings, host.truth)
        self.board = HalBoard(settings, host, self.dish)
        self.search = Search(self.board)
        self.menus: dict[str, Menu] = {
            "root": Root(self.board),
            "motor": Motor(self.board),
            "ngsearch": Ngsearch(self.board, self.search),
            "nvs": Nvs(self.board),
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
        return boot_log(self.board, self.search) if home else restart_log()

    def stalled(self, axis: Axis) -> None:
        """Say so (setting `stall_text`), and begin the move that waits."""
        self.board.stalled(axis)
