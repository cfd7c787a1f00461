"""The processor's own memory, `EE>` (docs/reference/g2-commands.md, *EE>*).

Both answers of reading are quoted (noted); that of writing is made like them (assumed).
"""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Script

ENTRIES = 256
"""How many there are to write (assumed)."""
INVALID = 65793
"""0x10101, the mark of an entry that holds nothing."""


class EepromMenu(G2Menu):
    """Outlasts reboot and power-off."""

    prompt = "EE>"
    help_lines = ("help [<command>]", "def - restore defaults", "ee <index> [<value>]", "inv <index> - invalidate", "q")

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {"def": self._defaults, "ee": self._entry, "inv": self._invalidate}
        self._entries = self._factory()

    def _factory(self) -> dict[int, int]:
        return dict.fromkeys(range(min(self.board.settings.eeprom_written, ENTRIES)), 0)

    def _entry(self, args: list[str]) -> Script:
        index = whole(args[0]) if 1 <= len(args) <= 2 else None
        value = whole(args[1]) if len(args) == 2 else None
        if index is None or index < 0 or (len(args) == 2 and (value is None or index >= ENTRIES)):
            yield from self.bad_parameter()
        elif value is not None:
            self._entries[index] = value
            yield f"Index:{index} Write value = {value}\n"
        elif index in self._entries:
            yield f"Index:{index} Read value = {self._entries[index]}\n"
        else:
            yield f"Failed to read eeprom index:{index} val:{INVALID}\n"

    def _invalidate(self, args: list[str]) -> Script:
        index = whole(args[0]) if len(args) == 1 else None
        if index is None or not 0 <= index < ENTRIES:
            yield from self.bad_parameter()
            return
        self._entries.pop(index, None)

    def _defaults(self, args: list[str]) -> Script:  # noqa: ARG002
        self._entries = self._factory()
        yield ""


def whole(text: str) -> int | None:
    """Read a signed whole number of 32 bits; None when it is none."""
    digits = text[1:] if text[:1] in "+-" else text
    value = int(text) if digits.isascii() and digits.isdecimal() else None
    return value if value is not None and -(2**31) <= value < 2**31 else None
