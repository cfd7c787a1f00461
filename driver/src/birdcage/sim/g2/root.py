"""The root menu, `TRK>` (reference sections 7.3 and 7.8)."""

from __future__ import annotations

from birdcage.sim.g2.board import Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Die, Enter, Script

SUBMENUS = {
    "dvb": "DVB Tuner",
    "mot": "Motor Control",
    "nvs": "Non-Volatile Storage",
    "os": "OS",
}
"""The line of `dvb` is verbatim [B]; the others are made like it [I]."""


class Root(G2Menu):
    """Enters submenus. What `q` does here is a setting, as the sources disagree."""

    prompt = "TRK>"
    help_lines = (
        "help [<command>]",
        *(f"Enter <{name}> - {what}" for name, what in SUBMENUS.items()),
        "reboot",
        "q",
    )

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self.commands |= {"q": self._quit, "reboot": self._reboot}

    def run(self, words: list[str]) -> Script:
        """Carry out one line; the name of a submenu enters it."""
        if words[0] in SUBMENUS:
            yield Enter(words[0])
        else:
            yield from super().run(words)

    def _quit(self, args: list[str]) -> Script:  # noqa: ARG002
        what = self.board.settings.root_q
        if what == "kill":
            yield Die()
        elif what == "error":
            yield from self.unknown(["q"])

    def _reboot(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.reboot()
        yield ""
