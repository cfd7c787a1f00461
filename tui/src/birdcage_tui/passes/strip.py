"""Elevation of the chosen pass over time, with floor, ceiling, and what of it is in reach."""

from __future__ import annotations

from collections.abc import Callable

from birdcage_tui.drawing.canvas import Braille, Cells
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.sky_picture import ShownPass
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

AXIS = 4
"""Columns of the scale at the left."""
DECIMALS = 3
"""Columns more where it shows hundredths."""
LEAST_DRIFT_DEG = 0.1
"""The least that the scale of a drift spans."""


class PassStrip(Pane):
    """A curve from AOS to LOS; under it a bar where the dish can follow, and the times."""

    def __init__(self, selection: PassSelection, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Elevation"
        self._selection = selection

    def draw(self, cells: Cells, view: View) -> None:
        """Draw limits, curve and the line of the moment shown."""
        row = self._selection.chosen(view)
        if row is None:
            cells.put(1, 0, "No pass selected.", "dim")
            return
        width, height = cells.width - AXIS - 1, cells.height - 2
        if width < 12 or height < 2:
            return
        if row.stays:
            self._drift(cells, row, width - DECIMALS, height)
            return
        t_s, low, high = self._selection.time(view), view.state.el_min_deg, view.state.el_max_deg
        top = self._top(row, high)
        canvas = Braille(width, height)
        dots = height * 4 - 1

        def y_of(el_deg: float) -> float:
            return dots * (1.0 - min(max(el_deg, 0.0), top) / top)

        for limit in (low, high):
            if limit is not None and limit < top:
                canvas.line(0, y_of(limit), width * 2 - 1, y_of(limit), "line", every=2)
        self._curve(canvas, row, t_s, y_of)
        canvas.onto(cells, AXIS, 0)
        self._scale(cells, height, top, (low, high))
        self._bar(cells, row, width, height)
        self._times(cells, row, width, height + 1)
        if row.aos_s <= t_s <= row.los_s:
            x = AXIS + min(int((t_s - row.aos_s) / (row.los_s - row.aos_s) * width), width - 1)
            for y in range(height):
                if cells.free(x, y, 1, "line", "dim", "faint"):
                    cells.put(x, y, "│", "dim")
            place = row.path.at(t_s)
            if place is not None:
                cells.put(x, int(y_of(place[1])) // 4, "✕", "target-strong")

    @staticmethod
    def _drift(cells: Cells, row: ShownPass, width: int, height: int) -> None:
        """Draw the elevation of what is always up on a scale of its own: how far it drifts while the search lasts."""
        low, high = min(row.path.el_deg), max(row.path.el_deg)
        spare = max(LEAST_DRIFT_DEG - (high - low), (high - low) * 0.1) / 2.0
        canvas, columns = Braille(width, height), width * 2
        for column in range(columns):
            at_s = row.aos_s + (column + 0.5) / columns * (row.los_s - row.aos_s)
            place = row.path.at(at_s)
            if place is not None:
                loud = row.reach.holds(at_s)
                y = (height * 4 - 1) * (1.0 - (place[1] - low + spare) / (high - low + 2.0 * spare))
                canvas.dot(column, y, "target" if loud else "dim")
        canvas.onto(cells, AXIS + DECIMALS, 0)
        for y, el_deg in ((0, high + spare), (height - 1, low - spare)):
            cells.right(AXIS + DECIMALS, y, f"{el_deg:.2f}°", "dim")
        words = f"always up, drifts {high - low:.2f}°"
        cells.put(AXIS + DECIMALS, height, words, "text")
        cells.put(AXIS, height + 1, clock_text(row.aos_s, seconds=False), "dim")
        after = f"{(row.los_s - row.aos_s) / 3600.0:.0f} h later"
        cells.right(AXIS + DECIMALS + width, height + 1, after, "dim")

    @staticmethod
    def _top(row: ShownPass, high: float | None) -> float:
        """Return the upper end of the scale: the pass fits, and the ceiling too where it is near."""
        need = row.max_el_deg + 4.0
        if high is not None and high > row.max_el_deg > high - 12.0:
            need = max(need, high + 4.0)
        return min(max(need, 24.0), 90.0)

    @staticmethod
    def _curve(canvas: Braille, row: ShownPass, t_s: float, y_of: Callable[[float], float]) -> None:
        columns = canvas.width * 2
        for column in range(columns):
            at_s = row.aos_s + (column + 0.5) / columns * (row.los_s - row.aos_s)
            place = row.path.at(at_s)
            if place is None or (at_s < t_s and column % 3):
                continue  # past is dotted
            loud = row.reach.holds(at_s)
            after = row.path.at(min(at_s + (row.los_s - row.aos_s) / columns, row.los_s))
            y0, y1 = y_of(place[1]), y_of((after or place)[1])
            canvas.line(column, y0, column, y1 if at_s >= t_s else y0, "target" if loud else "dim")

    @staticmethod
    def _scale(cells: Cells, height: int, top: float, limits: tuple[float | None, float | None]) -> None:
        taken = set()
        for el_deg in (*(limit for limit in limits if limit is not None), top, 0.0):
            y = min(int((height * 4 - 1) * (1.0 - min(el_deg, top) / top)) // 4, height - 1)
            if el_deg <= top and y not in taken:
                taken.add(y)
                cells.right(AXIS, y, f"{el_deg:.0f}°", "dim")

    @staticmethod
    def _bar(cells: Cells, row: ShownPass, width: int, y: int) -> None:
        """Draw in which cells the dish can follow; a cell counts by its middle."""
        for column in range(width):
            at_s = row.aos_s + (column + 0.5) / width * (row.los_s - row.aos_s)
            held = row.reach.holds(at_s)
            cells.put(AXIS + column, y, "━" if held else "╌", "target" if held else "line")

    @staticmethod
    def _times(cells: Cells, row: ShownPass, width: int, y: int) -> None:
        """Write AOS and LOS at the ends, then the edges of reach where they fit."""
        cells.put(AXIS, y, clock_text(row.aos_s), "dim")
        cells.right(AXIS + width, y, clock_text(row.los_s), "dim")
        edges = [edge for one in row.reach.intervals for edge in (one.start_s, one.end_s)]
        for at_s in edges:
            words = clock_text(at_s)
            x = AXIS + int((at_s - row.aos_s) / (row.los_s - row.aos_s) * width) - len(words) // 2
            if cells.free(x - 1, y, len(words) + 2):
                cells.put(x, y, words, "target")
