"""How fast the dish has answered lately: a heading in figures, and a braille strip, newest at the right."""

from __future__ import annotations

from itertools import pairwise

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import Trip, View

COLUMN_S = 5.0
"""Seconds that a column of cells stands for."""
GAP_S = 15.0
"""A longer silence is a gap, not a slope."""
LEAST_TOP_MS = 20.0
AXIS = 7
ROWS = 6
"""Rows that heading and strip take: a page gives them, or none."""


def strip_words(view: View, shown: list[Trip]) -> str:
    """Return since when the link is up, how slow the slowest answer was, and the noise since then."""
    link = view.state.link
    noise = f"{link.stray_bytes} stray bytes" if link.stray_bytes else "no stray bytes"
    up = f"Link up for {age_text(view.now - link.since)}, {noise}"
    if not shown:
        return up
    slowest = max(trip.seconds for trip in shown) * 1000
    return f"{up}. Slowest reply {slowest:.0f} ms in the last {age_text(view.now - shown[0].at)}"


def draw_link_strip(cells: Cells, y: int, view: View) -> None:
    """Draw heading and strip from row `y` to the bottom; nothing while the link is down: there is nothing to time."""
    width, height = cells.width - 2 - AXIS, cells.height - y - 1
    if not view.link_up or width < 20 or height < 2:
        return
    shown = [trip for trip in view.trips if view.now - trip.at <= width * COLUMN_S]
    cells.put(1, y, cut(strip_words(view, shown), cells.width - 2), "dim")
    if not shown:
        return
    top_ms = max(LEAST_TOP_MS, max(trip.seconds for trip in shown) * 1200)
    canvas, dots = Braille(width, height), height * 4 - 1
    slowest: dict[int, float] = {}  # of each column of dots
    for trip in shown:
        column = width * 2 - 1 - int(view.now / COLUMN_S * 2) + int(trip.at / COLUMN_S * 2)
        slowest[column] = max(slowest.get(column, 0.0), trip.seconds)
    points = [(column, dots * (1 - seconds * 1000 / top_ms)) for column, seconds in sorted(slowest.items())]
    canvas.line(0, dots, width * 2 - 1, dots, "line", every=4)
    for one, other in pairwise(points):
        if other[0] - one[0] <= GAP_S / COLUMN_S * 2:
            canvas.line(*one, *other, "accent")
    canvas.dot(*points[-1], "accent")
    cells.right(AXIS, y + 1, f"{top_ms:.0f} ms", "dim")
    cells.right(AXIS, y + height, "0 ms", "dim")
    canvas.onto(cells, 1 + AXIS, y + 1)
