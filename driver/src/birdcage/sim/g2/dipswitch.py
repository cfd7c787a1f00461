"""The DIP switches, `DIPSWITCH>` (docs/reference/g2-commands.md, *DIPSWITCH>*): both lines are quoted (noted)."""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Script


class DipswitchMenu(G2Menu):
    """The switches under the cover, and what the firmware makes of them."""

    prompt = "DIPSWITCH>"
    help_lines = ("help [<command>]", "dipswitch - read dipswitch", "q")

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {"dipswitch": self._read}

    def _read(self, args: list[str]) -> Script:  # noqa: ARG002
        settings, row = self.board.settings, self.board.nvram.active
        code = int(row[113]) if row[112] else settings.dip_code
        yield f"val:{settings.dip_raw}\napp_dipswitch:{code}\n"
