"""A small curve of a pass's elevation, one row tall: the height of a row is 90 degrees."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.shown.sky_picture import ShownPass

MOST = 500
"""Curves that are kept: more than any screen shows."""


class Sparks:
    """Draws curves, and keeps what it worked out: a pass does not change while it is listed."""

    def __init__(self) -> None:
        self._kept: dict[tuple[int, int], tuple[ShownPass, list[tuple[int, bool]]]] = {}

    def draw(self, cells: Cells, x: int, y: int, width: int, row: ShownPass, quiet: str, loud: str) -> None:
        """Draw the elevation from AOS to LOS; `loud` is the ink where the dish can follow."""
        canvas, before = Braille(width, 1), None
        for column, (dot, held) in enumerate(self._dots(row, width * 2)):
            start = dot if before is None else (dot + before + (dot > before)) // 2
            canvas.line(column, start, column, dot, loud if held else quiet)
            before = dot
        canvas.onto(cells, x, y)

    def _dots(self, row: ShownPass, columns: int) -> list[tuple[int, bool]]:
        """Return the height of each column of dots, 3 for the lowest, and whether it is in reach there."""
        known = self._kept.get((id(row), columns))
        if known is not None and known[0] is row:
            return known[1]
        dots, path = [], row.path
        for column in range(columns):
            t_s = row.aos_s + (column + 0.5) / columns * (row.los_s - row.aos_s)
            place = path.at(t_s)
            if place is not None:
                level = min(int(max(place[1], 0.0) / 90.0 * 4.0), 3)
                dots.append((3 - level, row.reach.holds(t_s)))
        if len(self._kept) >= MOST:
            self._kept.clear()
        self._kept[id(row), columns] = (row, dots)
        return dots
