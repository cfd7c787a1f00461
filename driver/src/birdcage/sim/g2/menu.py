"""A menu of the G2."""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.trk.menu import TrkMenu


class G2Menu(TrkMenu[G2Board]):
    """One submenu, on its board."""
