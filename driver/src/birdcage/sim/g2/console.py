"""The G2's menus put together."""

from __future__ import annotations

from birdcage.sim.g2.a3981 import A3981
from birdcage.sim.g2.adc import Adc
from birdcage.sim.g2.board import Board
from birdcage.sim.g2.dipswitch import Dipswitch
from birdcage.sim.g2.dvb import Dvb
from birdcage.sim.g2.eeprom import Eeprom
from birdcage.sim.g2.gpio import Gpio
from birdcage.sim.g2.latlon import LatLon
from birdcage.sim.g2.mot import Mot
from birdcage.sim.g2.nvs import Nvs
from birdcage.sim.g2.peak import Peak
from birdcage.sim.g2.root import Root
from birdcage.sim.g2.step import Step
from birdcage.sim.g2.system import System
from birdcage.sim.shell import Menu


def menus(board: Board) -> dict[str, Menu]:
    """Return every menu by the word that enters it."""
    return {
        "root": Root(board),
        "a3981": A3981(board),
        "adc": Adc(board),
        "dipswitch": Dipswitch(board),
        "dvb": Dvb(board),
        "eeprom": Eeprom(board),
        "gpio": Gpio(board),
        "latlon": LatLon(board),
        "mot": Mot(board),
        "nvs": Nvs(board),
        "os": System(board),
        "peak": Peak(board),
        "step": Step(board),
    }
