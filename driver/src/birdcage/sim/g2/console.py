"""The G2's menus put together."""

from __future__ import annotations

from birdcage.sim.g2.a3981 import A3981Menu
from birdcage.sim.g2.adc import AdcMenu
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.dipswitch import DipswitchMenu
from birdcage.sim.g2.dvb import DvbMenu
from birdcage.sim.g2.eeprom import EepromMenu
from birdcage.sim.g2.gpio import GpioMenu
from birdcage.sim.g2.latlon import LatLonMenu
from birdcage.sim.g2.mot import MotMenu
from birdcage.sim.g2.nvs import G2NvsMenu
from birdcage.sim.g2.peak import PeakMenu
from birdcage.sim.g2.root import G2RootMenu
from birdcage.sim.g2.step import StepMenu
from birdcage.sim.g2.system import SystemMenu
from birdcage.sim.shell import Menu


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
        "nvs": G2NvsMenu(board),
        "os": SystemMenu(board),
        "peak": PeakMenu(board),
        "step": StepMenu(board),
    }
