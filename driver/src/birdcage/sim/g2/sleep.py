"""The sleep timer, NVS 38: that there is one is known, what it does to the console is not.

Source: docs/reference/g2.md, *Hazards*.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.sim.g2.board import G2Board

TIMER = 38
"""The row of the settings memory: seconds without input; 0 for never (assumed)."""


class Sleep:
    """Decides which bytes the shell hears (setting `sleep`). Nothing ticks: it looks when a byte comes."""

    def __init__(self, board: G2Board) -> None:
        self._board = board
        self.power_on()

    def power_on(self) -> None:
        """Be awake, and begin to count."""
        self._heard_s = self._board.now_s
        self._gone = False

    def hears(self, data: bytes) -> bytes:
        """Return what gets through to the shell."""
        mode = self._board.settings.sleep
        now_s, after_s = self._board.now_s, self._board.nvram.active[TIMER]
        asleep = self._gone or (after_s > 0 and now_s - self._heard_s >= after_s)
        if mode == "none" or not asleep:
            self._heard_s = now_s
            return data
        if mode == "silent":
            self._gone = True
            return b""
        self._heard_s = now_s
        return data[1:]
