"""The settings menu: `d`, `d <i>`, `e <i>`, `e <i> <v>`, `s` (`docs/reference/travler.md`, *Settings*).

Its texts are open.
"""

from __future__ import annotations

from birdcage.sim.hal.board import HalBoard, number
from birdcage.sim.hal.menu import HalMenu
from birdcage.sim.shell import Pause, Script

SAVE_S = 0.5
"""How long flash takes (assumed)."""


class HalNvsMenu(HalMenu):
    """Shows, edits and saves settings; they take effect with the next start of the processor (written)."""

    help_lines = ("d [<index>]", "e <index> [<value>]", "s", "q")

    def __init__(self, board: HalBoard) -> None:
        super().__init__(board, board.settings.prompt_nvs)
        self.commands |= {"d": self._show, "e": self._edit, "s": self._save}
        self._next = 0

    def _show(self, args: list[str]) -> Script:
        index = self._index(args)
        if args and index is None:
            yield from self.bad_parameter()
            return
        for row in self._page() if index is None else [index]:
            yield self._row(row)

    def _page(self) -> list[int]:
        """Return the rows that `d` shows now: all, or so many, and the next ones the next time, from the first again.

        The last page may be short (assumed).
        """
        rows, many = sorted(self.board.memory.rows), self.board.settings.page_rows
        if not many:
            return rows
        page = rows[self._next : self._next + many]
        self._next = self._next + many if self._next + many < len(rows) else 0
        return page

    def _edit(self, args: list[str]) -> Script:
        index = self._index(args[:1])
        value = number(args[1]) if len(args) == 2 else None
        if index is None or (len(args) > 1 and value is None):
            yield from self.bad_parameter()
            return
        if value is not None:
            self.board.memory.ram[index] = value
        yield self._row(index)

    def _save(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Pause(SAVE_S)
        self.board.memory.save()
        yield "Saved.\n"

    def _row(self, index: int) -> str:
        return f"{index:3d}) {self.board.memory.rows[index].name:<26}{self.board.memory.ram[index]:>11.2f}\n"

    def _index(self, args: list[str]) -> int | None:
        index = int(args[0]) if len(args) == 1 and args[0].isdecimal() else None
        return index if index in self.board.memory.rows else None
