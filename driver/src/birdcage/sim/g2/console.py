"""The G2's menus put together."""

from __future__ import annotations

from birdcage.sim.g2.adc import Adc
from birdcage.sim.g2.board import Board
from birdcage.sim.g2.dvb import Dvb
from birdcage.sim.g2.mot import Mot
from birdcage.sim.g2.nvs import Nvs
from birdcage.sim.g2.root import Root
from birdcage.sim.g2.step import Step
from birdcage.sim.g2.system import System
from birdcage.sim.shell import Menu


def menus(board: Board) -> dict[str, Menu]:
    """Return every menu by the word that enters it."""
    return {
        "root": Root(board),
        "adc": Adc(board),
        "dvb": Dvb(board),
        "mot": Mot(board),
        "nvs": Nvs(board),
        "os": System(board),
        "step": Step(board),
    }
