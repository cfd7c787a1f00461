"""The firmware of a Carryout G2, put together."""

from __future__ import annotations

from birdcage.sim.firmware import FirmwareHost, FirmwareKind
from birdcage.sim.g2.a3981 import A3981Menu
from birdcage.sim.g2.adc import AdcMenu
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.boot import BEFORE_HOMING, boot_log
from birdcage.sim.g2.dipswitch import DipswitchMenu
from birdcage.sim.g2.dvb import DvbMenu
from birdcage.sim.g2.eeprom import EepromMenu
from birdcage.sim.g2.gpio import GpioMenu
from birdcage.sim.g2.knobs import G2Settings
from birdcage.sim.g2.latlon import LatLonMenu
from birdcage.sim.g2.mechanics import G2Dish
from birdcage.sim.g2.mot import MotMenu
from birdcage.sim.g2.peak import PeakMenu
from birdcage.sim.g2.root import G2RootMenu
from birdcage.sim.g2.step import StepMenu
from birdcage.sim.g2.system import SystemMenu
from birdcage.sim.g2.tracker import Tracker
from birdcage.sim.shell import Menu, Pause, Script
from birdcage.sim.trk.firmware import TrkFirmware
from birdcage.sim.trk.nvs import TrkNvsMenu


class G2Firmware(TrkFirmware):
    """Version 02.02.48 (docs/reference/g2.md)."""

    dish: G2Dish

    def __init__(self, settings: G2Settings, host: FirmwareHost) -> None:
        self.dish = G2Dish(settings, host.truth)
        self.board = G2Board(settings, host.machine, self.dish, host.restart)
        self.tracker = Tracker(self.board)
        self.menus = menus(self.board)
        super().__init__(settings, host)

    def resume(self) -> None:
        """Stand still: one whose search is on has found its satellite."""
        self._host.shell.hears = self.board.sleep.hears

    def halt(self) -> None:
        """Give up the TV search."""
        self.tracker.stop()

    def boot(self, *, home: bool = True) -> Script:
        """Read the settings memory, and return the boot log."""
        self._host.shell.hears = self.board.sleep.hears
        self.board.power_on()
        return boot_log(self.board, self.tracker) if home else _restart_log()


def _restart_log() -> Script:
    for seconds, line in BEFORE_HOMING:
        yield Pause(seconds)
        yield f"{line}\n"
    yield "Boot Complete\n"


def menus(board: G2Board) -> dict[str, Menu]:
    """Return every menu by the word that enters it."""
    return {
        "root": G2RootMenu(board),
        "a3981": A3981Menu(board),
        "adc": AdcMenu(board),
        "dipswitch": DipswitchMenu(board),
        "dvb": DvbMenu(board),
        "eeprom": EepromMenu(board),
        "gpio": GpioMenu(board),
        "latlon": LatLonMenu(board),
        "mot": MotMenu(board),
        "nvs": TrkNvsMenu(board),
        "os": SystemMenu(board),
        "peak": PeakMenu(board),
        "step": StepMenu(board),
    }


KIND = FirmwareKind(G2Settings, G2Firmware)
