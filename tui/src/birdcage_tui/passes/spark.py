"""A small picture of a pass's elevation, one row tall: eighths of a cell, each of which stands for 11 degrees."""

from __future__ import annotations

from birdcage_tui.canvas import Cells
from birdcage_tui.passes.model import Row

BARS = "▁▂▃▄▅▆▇█"


def draw_spark(cells: Cells, x: int, y: int, width: int, row: Row, quiet: str, loud: str) -> None:
    """Draw the elevation from AOS to LOS, 0 to 90 degrees; `loud` is the ink where the dish can follow."""
    path = row.path
    if path is None or row.los_s <= row.aos_s:
        return
    for column in range(width):
        t_s = row.aos_s + (column + 0.5) / width * (row.los_s - row.aos_s)
        place = path.at(t_s)
        if place is not None:
            level = min(int(max(place[1], 0.0) / 90.0 * len(BARS)), len(BARS) - 1)
            held = row.reach is not None and row.reach.holds(t_s)
            cells.put(x + column, y, BARS[level], loud if held else quiet)
