"""A scale of a few degrees around the needle's tip, with tenths: it slides under a fixed pointer, dot by dot."""

from __future__ import annotations

import math
from collections.abc import Callable

from birdcage.base.geometry import shortest_turn

from birdcage_tui.drawing.canvas import Braille, Cells

SPANS_DEG = (5.0, 4.0, 3.0, 2.0, 1.0)
"""How far the scale reaches to either side; the widest on which tenths can still be told."""
ROWS = 3
"""Numbers, ticks, marks."""


def span_for(width: int, digits: int) -> float:
    """Return how many degrees fit to either side of the pointer, each with a number of so many digits."""
    return next((span for span in SPANS_DEG if width / (2 * span) >= digits + 1.5), SPANS_DEG[-1])


def _plain(value_deg: float) -> float:
    return value_deg


def draw_tape(
    cells: Cells,
    y: int,
    angle_deg: float | None,
    *,
    ink: str,
    target_deg: float | None = None,
    fold: Callable[[float], float] = _plain,
) -> None:
    """Draw the scale in the rows from `y` on. `fold` brings an angle into the range in which it is written."""
    width = cells.width
    middle = width // 2
    if angle_deg is None:
        cells.put(1, y + 1, "╌" * max(width - 2, 0), "line")
        cells.put(middle - 3, y, " --.-- ", "dim")
        cells.put(middle, y + 2, "▲", "dim")
        return
    span = span_for(width, 2 if fold is _plain else 3)
    a_degree = (width * 2 - 2) / (2 * span)
    canvas = Braille(width, 1)
    centre = middle * 2 + 0.5
    for tenth in range(math.ceil((angle_deg - span) * 10), math.floor((angle_deg + span) * 10) + 1):
        x = centre + (tenth / 10 - angle_deg) * a_degree
        if cells.glyphs != "braille" and tenth % 5 == 0:  # coarse cells would blur tenths into each other
            cells.put(math.floor(x / 2), y + 1, "|" if tenth % 10 == 0 else ".", "text")
        tall = 4 if tenth % 10 == 0 else 3 if tenth % 5 == 0 else 1
        for row in range(tall):
            canvas.dot(x, row, "text")
        if tenth % 10 == 0:
            number = f"{fold(tenth / 10):.0f}"
            at = math.floor(x / 2) - (len(number) - 1) // 2
            if at >= 0 and at + len(number) <= width:
                cells.put(at, y, number, "text" if abs(tenth / 10 - angle_deg) < 1.0 else "dim")
    if cells.glyphs == "braille":
        canvas.onto(cells, 0, y + 1)
    ways = ("up", "down") if fold is _plain else ("CW", "CCW")
    _marks(cells, y + 2, centre, a_degree, _off(angle_deg, target_deg, fold), ways)
    cells.put(middle, y + 2, "▲", ink)


def _off(angle_deg: float, target_deg: float | None, fold: Callable[[float], float]) -> float | None:
    if target_deg is None:
        return None
    return target_deg - angle_deg if fold is _plain else shortest_turn(angle_deg, target_deg)


def _marks(cells: Cells, y: int, centre: float, a_degree: float, off_deg: float | None, ways: tuple[str, str]) -> None:
    """Write where the target is: on the scale, or beyond which end of it; with a word for either way where it fits."""
    width = cells.width
    if off_deg is None:
        return
    column = math.floor((centre + off_deg * a_degree) / 2)
    figure = f"{abs(off_deg):.2f}°"
    said = [f"target {figure} {ways[off_deg < 0]}", f"target {figure}", f"✕ {figure}", figure]
    if abs(off_deg) < 0.005:
        said = ["on target", "✕"]
    # What is longer would run into the pointer.
    words = next((each for each in said if len(each) + 3 < width - width // 2), said[-1])
    if 0 <= column < width:
        cells.put(column, y, "✕", "target-strong")
        if width >= 28:
            cells.right(width - 1, y, words, "target")
    elif off_deg > 0:
        cells.right(width, y, f"{words} ▶", "target")
    else:
        cells.put(0, y, f"◀ {words}", "target")
