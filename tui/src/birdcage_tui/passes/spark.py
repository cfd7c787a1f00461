"""A small curve of a pass's elevation, one row tall: the height of a row is 90 degrees."""

from __future__ import annotations

from birdcage_tui.canvas import Braille, Cells
from birdcage_tui.passes.model import Row


def draw_spark(cells: Cells, x: int, y: int, width: int, row: Row, quiet: str, loud: str) -> None:
    """Draw the elevation from AOS to LOS; `loud` is the ink where the dish can follow."""
    path = row.path
    if path is None or width <= 0 or row.los_s <= row.aos_s:
        return
    canvas = Braille(width, 1)
    columns, before = width * 2, None
    for column in range(columns):
        t_s = row.aos_s + (column + 0.5) / columns * (row.los_s - row.aos_s)
        place = path.at(t_s)
        if place is None:
            continue
        dot = 3 - min(int(max(place[1], 0.0) / 90.0 * 4.0), 3)
        ink = loud if row.reach is not None and row.reach.holds(t_s) else quiet
        canvas.line(column, dot if before is None else (dot + before + (dot > before)) // 2, column, dot, ink)
        before = dot
    canvas.onto(cells, x, y)
