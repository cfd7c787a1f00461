"""The firmware of a relative of the G2, put together (docs/reference/g2-kin.md). Its TV search is not simulated."""

from __future__ import annotations

from birdcage.sim.firmware import FirmwareHost
from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.firmware import TrkFirmware
from birdcage.sim.trk.homing import home
from birdcage.sim.trk.kin_board import KinBoard
from birdcage.sim.trk.kin_knobs import KinSettings
from birdcage.sim.trk.kin_menus import kin_menus
from birdcage.sim.trk.mechanics import TrkDish


class KinFirmware(TrkFirmware):
    """Which relative it is, its settings tell."""

    def __init__(self, settings: KinSettings, host: FirmwareHost) -> None:
        self.dish = TrkDish(settings, host.truth)
        self.board = KinBoard(settings, host.machine, self.dish, host.restart)
        self.menus = kin_menus(self.board)
        super().__init__(settings, host)

    def resume(self) -> None:
        """Stand still."""

    def halt(self) -> None:
        """Give up nothing: it moves only when it is told to."""

    def boot(self, *, home: bool = True) -> Script:
        """Read the settings memory at once, and return what it then does: no source has its boot log."""
        self.board.power_on()
        return self._start(home=home and self.board.homes_by_itself)

    def _start(self, *, home: bool) -> Script:
        settings = self.board.settings
        yield Pause(settings.boot_s)
        if settings.boot_text:
            yield f"{settings.boot_text}\n"
        if home:
            yield from self._find_references()

    def _find_references(self) -> Script:
        for index in (1, 0):
            if self.board.settings.home_fails:
                yield Pause(self.dish.axes[index].data.homing_timeout_s)
            else:
                yield from home(self.board, index)
