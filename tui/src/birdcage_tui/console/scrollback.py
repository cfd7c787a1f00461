"""The lines that are kept, laid out in rows; a bounded number of them."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable
from dataclasses import replace

from birdcage_tui.console.lines import CellRow, LinePart, LogLine, Stamps, rows_of, stamp_of

KEPT = 5000
FOLD = "+"
"""Stands before a row that stands for many lines."""
SLACK = 500
"""So many more are let in before the oldest are cut off, so that cutting is rare."""


class Scrollback:
    """Lines and their rows for one width and one way of writing them."""

    def __init__(self, kept: int = KEPT) -> None:
        self.lines: list[LogLine] = []
        self.rows: list[CellRow] = []
        self.taken = 0
        """How many lines were ever taken in."""
        self.told = 0
        """How many of them were shown, not folded away."""
        self.folded = True
        """Whether the station's own polling, a pursuit's steps too, is one row, and echoes are not repeated."""
        self.width = 80
        self.stamps = Stamps.UTC
        self.as_hex = False
        self._kept = kept
        self._before: LogLine | None = None
        self._folding = 0
        """How many lines the last row stands for; 0 when it is one of a line."""
        self._steps = False
        """Whether steps of a pursuit are among them."""

    def add(self, lines: Iterable[LogLine]) -> int:
        """Take lines in; return how many rows were cut off at the top."""
        for line in lines:
            self.told += self._place(line, self.taken)
            self.lines.append(line)
            self.taken += 1
        if len(self.lines) <= self._kept + SLACK:
            return 0
        del self.lines[: len(self.lines) - self._kept]
        first = self.taken - len(self.lines)
        if self._folding and self.rows:
            self.rows[-1] = replace(self.rows[-1], number=max(self.rows[-1].number, first))
        cut = self.first_row(first)
        del self.rows[:cut]
        return cut

    def lay_out(
        self, *, width: int | None = None, stamps: Stamps | None = None, as_hex: bool | None = None,
        folded: bool | None = None,
    ) -> None:  # fmt: skip
        """Write all rows anew, for another width or in another way."""
        self.width = self.width if width is None else width
        self.stamps = self.stamps if stamps is None else stamps
        self.as_hex = self.as_hex if as_hex is None else as_hex
        self.folded = self.folded if folded is None else folded
        first = self.taken - len(self.lines)
        self.rows, self._before, self._folding = [], None, 0
        for number, line in enumerate(self.lines, first):
            self._place(line, number)

    def clear(self) -> None:
        """Forget what was seen."""
        self.lines.clear()
        self.rows.clear()
        self._before, self._folding = None, 0

    def _place(self, line: LogLine, number: int) -> bool:
        """Append the rows of a line; return whether it is seen as one of its own."""
        if self.folded and line.part in (LinePart.ECHO, LinePart.MARK):
            return False
        if self.folded and line.part in (LinePart.POLL, LinePart.STEP):
            number = self.rows.pop().number if self._folding else number
            self._steps = line.part is LinePart.STEP or (self._steps and self._folding > 0)
            self._folding += 1
            stamp = stamp_of(line, self._before, self.stamps)
            what = "tracking and polling" if self._steps else "polling"
            lines = "1 line" if self._folding == 1 else f"{self._folding} lines"
            self.rows.append(CellRow(number, stamp, FOLD, f"{lines} of {what}, p shows all"[: self.width], "dim"))
            return False
        self.rows += rows_of(line, number, self._before, self.width, self.stamps, as_hex=self.as_hex)
        self._before, self._folding = line, 0
        return True

    def first_row(self, number: int) -> int:
        """Return the index of the first row of a line, or of the first one after it."""
        return bisect_left(self.rows, number, key=lambda row: row.number)

    def found(self, needle: str) -> list[int]:
        """Return the indices of the rows that hold `needle`, large and small letters alike."""
        small = needle.lower()
        return [index for index, row in enumerate(self.rows) if small in row.text.lower()] if small else []
