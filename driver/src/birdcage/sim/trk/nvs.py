"""The settings menu, `NVS>` (docs/reference/g2-settings.md, *A session*)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from birdcage.sim.settings import SimSettings
from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.menu import TrkMenu
from birdcage.sim.trk.nvram import Nvram

HEADER = (
    "Num  Name                         Current      Saved      Default\n"
    "---- --------------------------  ----------  ----------  ----------\n"
)
SAVING = "    Saving ... \n"
SAVED = "Flash file flashx:bank0 opened\nFlash sector cache enabled.\nFlash doneSuccess\n"
SAVE_S = 0.5
"""How long flash takes (assumed)."""


class NvsBoard(Protocol):
    """What this menu needs of the board."""

    nvram: Nvram
    at_power_on: list[Callable[[], None]]

    @property
    def settings(self) -> SimSettings:
        """The knobs."""


class TrkNvsMenu(TrkMenu[NvsBoard]):
    """Shows, edits and saves settings. Words it does not know read the next row: no error is ever printed (noted)."""

    prompt = "NVS>"
    help_lines = (
        "help [<command>]",
        "d [<idx>] - Dump all values, or one",
        "e <idx> [<value>] - Read or edit a value",
        "q",
        "s - Save to flash",
    )

    def __init__(self, board: NvsBoard) -> None:
        super().__init__(board)
        self.commands |= {"d": self._dump, "e": self._edit, "s": self._save}
        self._begin()
        board.at_power_on.append(self._begin)

    def _begin(self) -> None:
        """Let the next word that it does not know read the first row."""
        self._next = 0

    def unknown(self, words: list[str]) -> Script:  # noqa: ARG002
        """Read the next row."""
        indices = sorted(self.board.nvram.rows)
        index = indices[self._next % len(indices)]
        self._next += 1
        yield self._row(index)

    def _dump(self, args: list[str]) -> Script:
        index = self._index(args)
        if args and index is None:
            yield from self.bad_parameter()
            return
        nvram = self.board.nvram
        yield HEADER
        for row in [index] if index is not None else sorted({*nvram.rows, *nvram.odd_lines}):
            if row in nvram.odd_lines:
                yield f"{nvram.odd_lines[row]}\n"
                continue
            values = (nvram.ram[row], nvram.flash[row], nvram.rows[row].default)
            shown = "".join(f"  {nvram.render(row, value):>10}" for value in values)
            yield f"{row:3d}) {nvram.rows[row].name:<26}{shown}\n"

    def _edit(self, args: list[str]) -> Script:
        index = self._index(args[:1])
        if index is None or len(args) > 2:
            yield from self.bad_parameter()
        elif len(args) == 1:
            yield self._row(index)
        else:
            before = self._row(index).rstrip("\n")
            try:
                self.board.nvram.write(index, args[1])
            except ValueError:
                yield from self.bad_parameter()
                return
            yield f"{before} .{self.board.nvram.render(index, self.board.nvram.ram[index]):>11}\n"

    def _save(self, args: list[str]) -> Script:  # noqa: ARG002
        yield SAVING
        yield Pause(SAVE_S)
        self.board.nvram.save()
        yield SAVED

    def _row(self, index: int) -> str:
        nvram = self.board.nvram
        return f"{index:3d}) {nvram.rows[index].name:<26}{nvram.render(index, nvram.ram[index]):>11}\n"

    def _index(self, args: list[str]) -> int | None:
        index = int(args[0]) if len(args) == 1 and args[0].isdecimal() else None
        return index if index in self.board.nvram.rows else None
