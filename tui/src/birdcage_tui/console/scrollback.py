"""The lines that are kept, laid out in rows; a bounded number of them."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable

from birdcage_tui.console.lines import Line, Row, Stamps, rows_of

KEPT = 5000
SLACK = 500
"""So many more are let in before the oldest are cut off, so that cutting is rare."""


class Scrollback:
    """Lines and their rows for one width and one way of writing them."""

    def __init__(self, kept: int = KEPT) -> None:
        self.lines: list[Line] = []
        self.rows: list[Row] = []
        self.taken = 0
        """How many lines were ever taken in."""
        self.width = 80
        self.stamps = Stamps.UTC
        self.as_hex = False
        self._kept = kept

    def add(self, lines: Iterable[Line]) -> int:
        """Take lines in; return how many rows were cut off at the top."""
        for line in lines:
            before = self.lines[-1] if self.lines else None
            self.rows += rows_of(line, self.taken, before, self.width, self.stamps, as_hex=self.as_hex)
            self.lines.append(line)
            self.taken += 1
        if len(self.lines) <= self._kept + SLACK:
            return 0
        del self.lines[: len(self.lines) - self._kept]
        cut = self.first_row(self.taken - len(self.lines))
        del self.rows[:cut]
        return cut

    def lay_out(self, *, width: int | None = None, stamps: Stamps | None = None, as_hex: bool | None = None) -> None:
        """Write all rows anew, for another width or in another way."""
        self.width = self.width if width is None else width
        self.stamps = self.stamps if stamps is None else stamps
        self.as_hex = self.as_hex if as_hex is None else as_hex
        first = self.taken - len(self.lines)
        self.rows = []
        before = None
        for number, line in enumerate(self.lines, first):
            self.rows += rows_of(line, number, before, self.width, self.stamps, as_hex=self.as_hex)
            before = line

    def clear(self) -> None:
        """Forget what was seen."""
        self.lines.clear()
        self.rows.clear()

    def first_row(self, number: int) -> int:
        """Return the index of the first row of a line, or of the first one after it."""
        return bisect_left(self.rows, number, key=lambda row: row.number)

    def found(self, needle: str) -> list[int]:
        """Return the indices of the rows that hold `needle`, large and small letters alike."""
        small = needle.lower()
        return [index for index, row in enumerate(self.rows) if small in row.text.lower()] if small else []
