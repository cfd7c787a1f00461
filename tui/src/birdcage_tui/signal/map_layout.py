"""Which part of a map's pane is what: head, picture, axes, cuts, colour bar, readout."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.skymap.plan import MapPlan

from birdcage_tui.signal.map_chart import MapChart

AXIS = 6
"""Columns for the angles left of the picture: `-12.5°`."""
BAR, BAR_TEXT = 2, 7
"""Columns of the colour bar, and of its numbers."""
CUT_ROWS, CUT_COLUMNS = 6, 18
CUTS_FROM = (104, 26)
"""Columns and rows from which there is room for cuts without being asked for."""
LEAST = (24, 5)
SMALL = (50, 9)
"""Columns and rows below which axis and bar give way to the picture."""


@dataclass(frozen=True, slots=True)
class MapLayout:
    """Where the parts begin, in cells; a part of no size is not there."""

    chart: MapChart
    left: int
    top: int
    axis: int
    cut_rows: int
    cut_columns: int
    bar: int
    """Column of the colour bar; 0: there is none."""

    @classmethod
    def of(cls, plan: MapPlan, width: int, height: int, aspect: float, *, cuts: bool | None) -> MapLayout | None:
        """Return the parts of a pane of that size; None where it is too small. `cuts`: None for where they fit."""
        if width < LEAST[0] or height < LEAST[1]:
            return None
        small = width < SMALL[0] or height < SMALL[1]
        fits = width >= CUTS_FROM[0] and height >= CUTS_FROM[1]
        with_cuts = (fits if cuts is None else cuts) and height >= 14 and width >= 60
        axis = 0 if small else AXIS
        bar = 0 if small else BAR + BAR_TEXT + 1
        cut_columns = (CUT_COLUMNS if fits else CUT_COLUMNS // 2 + 2) if with_cuts else 0
        cut_rows = (CUT_ROWS if fits else CUT_ROWS - 2) if with_cuts else 0
        room = width - axis - bar - (cut_columns + 1 if cut_columns else 0) - 1
        rows = height - 2 - (0 if small else 1) - cut_rows
        chart = MapChart.within(plan, room, rows, aspect)
        spare = room - chart.width
        left = axis + spare // 2
        at = left + chart.width + 1 + (cut_columns + 1 if cut_columns else 0)
        return cls(chart, left, 1 + (rows - chart.height) // 2, axis, cut_rows, cut_columns, at if bar else 0)

    @property
    def axis_row(self) -> int:
        """The row under the picture, for angles."""
        return self.top + self.chart.height
