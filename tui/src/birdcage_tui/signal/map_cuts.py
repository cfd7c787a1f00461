"""Two cuts through a map: the row and the column of its cursor, drawn along the edges of the picture."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.shown.map_book import MapShown
from birdcage_tui.shown.map_words import value_words
from birdcage_tui.signal.map_chart import MapChart

Points = Sequence[tuple[float, float] | None]


def draw_row_cut(cells: Cells, shown: MapShown, chart: MapChart, cell: int, at: tuple[int, int], height: int) -> None:
    """Draw the values of the cursor's row under the picture, over the same columns, the higher the louder."""
    if shown.span is not None:
        _row_lines(shown, chart, cell // shown.plan.columns, height).onto(cells, *at)
        _mark(cells, shown, shown.span, cell, (at[0] + int(chart.spot_of(cell)[0]), at[1] + height - 1), at)


def draw_column_cut(cells: Cells, shown: MapShown, chart: MapChart, cell: int, at: tuple[int, int], width: int) -> None:
    """Draw the values of the cursor's column beside the picture, over the same rows, further right the louder."""
    if shown.span is not None:
        _column_lines(shown, chart, cell % shown.plan.columns, width).onto(cells, *at)


@lru_cache(maxsize=2)  # frames are many, and each draws the same until another direction is heard
def _row_lines(shown: MapShown, chart: MapChart, row: int, height: int) -> Braille:
    values = shown.grid[row].tolist()
    canvas, dots, high = Braille(chart.width, height), chart.width * 2.0 / len(values), height * 4 - 1
    parts = enumerate(_parts(shown.span or (0.0, 1.0), values))
    _draw(canvas, [_point((index + 0.5) * dots, (1.0 - part) * high, part) for index, part in parts])
    return canvas


@lru_cache(maxsize=2)
def _column_lines(shown: MapShown, chart: MapChart, column: int, width: int) -> Braille:
    values = shown.grid[::-1, column].tolist()
    canvas, dots, wide = Braille(width, chart.height), chart.height * 4.0 / len(values), width * 2 - 1
    parts = enumerate(_parts(shown.span or (0.0, 1.0), values))
    _draw(canvas, [_point(part * wide, (index + 0.5) * dots, part) for index, part in parts])
    return canvas


def _parts(span: tuple[float, float], values: Sequence[float]) -> list[float]:
    """Return values as parts of the span; NaN stays."""
    wide = max(span[1] - span[0], 1e-12)
    return [(value - span[0]) / wide for value in values]


def _point(x: float, y: float, part: float) -> tuple[float, float] | None:
    return None if math.isnan(part) else (x, y)


def _draw(canvas: Braille, points: Points) -> None:
    """Join what was heard: by a line between neighbours, by a fainter one over directions that were not heard."""
    before: tuple[int, tuple[float, float]] | None = None
    for index, point in enumerate(points):
        if point is None:
            continue
        if before is not None:
            canvas.line(*before[1], *point, "text" if before[0] == index - 1 else "line")
        canvas.dot(*point, "text")
        before = index, point


def _mark(
    cells: Cells, shown: MapShown, span: tuple[float, float], cell: int, spot: tuple[int, int], at: tuple[int, int]
) -> None:  # fmt: skip
    """Write the ends of the scale, and mark the cursor's value."""
    cells.right(at[0] - 1, at[1], value_words(shown, span[1]), "dim")
    cells.right(at[0] - 1, spot[1], value_words(shown, span[0]), "dim")
    value = shown.value(cell)
    if value is not None:
        (part,) = _parts(span, [value])
        cells.put(spot[0], at[1] + int((1.0 - part) * (spot[1] - at[1] + 0.99)), "●", "target-strong")
