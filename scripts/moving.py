"""Draw several screens of cells as one SVG that moves: what stays the same is drawn once, the rest comes and goes.

The cells that are alike over a run of frames are one group, shown for that run by CSS. Without CSS animation, or where
a person wants less motion, the first frame stands.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

from picture import Cell, cells_of, draw_row, frame

if TYPE_CHECKING:
    from rich.style import Style

Screen = Sequence[Iterable[tuple[str, "Style | None"]]]
Run = tuple[int, int]
"""The first frame that shows something, and the first one that does not any more."""
Layer = list[list[Cell]]


def moving(screens: Sequence[Screen], ground: str, shown_s: float) -> str:
    """Return one picture that shows each screen for `shown_s`, and then begins again."""
    layers = _layers(screens, ground)
    count = len(screens)
    width, height = len(next(iter(layers.values()))[0]), len(next(iter(layers.values())))
    style = [
        f"g{{animation:{count * shown_s:g}s step-end infinite}}",
        *(_keyframes(run, count) for run in layers if run != (0, count)),
        "@media (prefers-reduced-motion:reduce){g{animation:none!important}}",
    ]
    inside = ["<style>", *style, "</style>", *(_group(run, count, layers[run], ground) for run in layers)]
    return frame(width, height, ground, inside)


def still(screens: Sequence[Screen], ground: str, at: int) -> str:
    """Return one frame of the moving picture as a picture that stands, from the same groups."""
    layers = _layers(screens, ground)
    height, width = len(screens[0]), len(next(iter(layers.values()))[0])
    inside = [part for (first, past), layer in layers.items() if first <= at < past for part in _drawn(layer, ground)]
    return frame(width, height, ground, inside)


def _layers(screens: Sequence[Screen], ground: str) -> dict[Run, Layer]:
    """Return what is shown over each run of frames, those that begin first in front of others."""
    grids = [[cells_of(row, ground) for row in screen] for screen in screens]
    height, width = len(grids[0]), max(len(row) for grid in grids for row in grid)
    nothing: Cell = (" ", ground, ground, False)
    found: dict[Run, Layer] = defaultdict(lambda: [[nothing] * width for _ in range(height)])
    for y in range(height):
        for x in range(width):
            cells = [grid[y][x] if x < len(grid[y]) else nothing for grid in grids]
            first = 0
            for cell, group in groupby(cells):
                past = first + len(list(group))
                if cell[0] != " " or cell[2] != ground:
                    found[first, past][y][x] = cell
                first = past
    return dict(sorted(found.items()))


def _name(run: Run) -> str:
    return f"f{run[0]}-{run[1]}"


def _keyframes(run: Run, count: int) -> str:
    first, past = run
    steps = [] if first == 0 else ["0%{visibility:hidden}"]
    steps.append(f"{100 * first / count:.4g}%{{visibility:visible}}")
    if past < count:
        steps.append(f"{100 * past / count:.4g}%{{visibility:hidden}}")
    return f"@keyframes {_name(run)}{{{''.join(steps)}}}.{_name(run)}{{animation-name:{_name(run)}}}"


def _drawn(layer: Layer, ground: str) -> list[str]:
    drawn = [draw_row(row, cells, ground) for row, cells in enumerate(layer)]
    return [part for parts in zip(*drawn, strict=True) for row in parts for part in row]


def _group(run: Run, count: int, layer: Layer, ground: str) -> str:
    """Return the group of a run; without animation only what the first frame shows is seen."""
    head = "<g>"
    if run != (0, count):
        hidden = ' visibility="hidden"' if run[0] else ""
        head = f'<g class="{_name(run)}"{hidden}>'
    return "\n".join((head, *_drawn(layer, ground), "</g>"))
