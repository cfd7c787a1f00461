"""The strip of the signal page: the last minute with its statistics beneath, and the markers beside it."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.panes.signal import SPAN_S, SignalPane
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.markers import Marker
from birdcage_tui.shown.strip_words import marker_text, statistics_text
from birdcage_tui.shown.view import SignalSample, View

WIDE, LIST_WIDE, LIST = 100, 43, 32
"""Columns from which the list of markers is wide, and what it takes then; else what it takes."""
ROOMY = 8
"""Rows from which statistics and the axis of time have one each. Below, the statistics take that of the reading."""


class StripPane(SignalPane):
    """As the strip of the dashboard; Enter marks the newest reading."""

    HELP = "The last minute of the signal. Enter sets a marker at the newest reading, X clears all of them."

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the strip, then what belongs to it."""
        super().draw(cells, view)
        shown = [sample for sample in view.signal if view.now - sample.at <= SPAN_S]
        if shown and self._below(cells):
            cells.put(1, cells.height - 1, statistics_text(shown, view.heard, cells.width - 2), "dim")
        if view.signal and self._below(cells):
            self._write_time(cells, view)
        self._write_markers(cells, view)

    def spared(self, cells: Cells, view: View) -> tuple[int, int]:
        """Leave columns for markers, rows for time and statistics."""
        return self._list(cells, view), self._below(cells)

    def span_words(self, view: View) -> str:
        """Return what is shown, and what Enter does here: it releases first what is held."""
        mark = "   Enter: mark" if can_release(view) is not None and not view.typing else ""
        return f"last {SPAN_S:.0f} s{mark}"

    def marked(self, view: View) -> Sequence[Marker]:
        """Those that are set."""
        return view.markers

    @staticmethod
    def write_reading(cells: Cells, view: View, shown: list[SignalSample], source: str) -> None:
        """Write the reading; where there are few rows, the statistics: the panes above tell reading and peak."""
        if cells.height >= ROOMY or not shown:
            SignalPane.write_reading(cells, view, shown, source)
            return
        room = cells.width - len(source) - 4
        cells.put(1, 0, statistics_text(shown, view.heard, room), "text")
        cells.right(cells.width - 1, 0, source, "dim")

    @staticmethod
    def _below(cells: Cells) -> int:
        return 2 if cells.height >= ROOMY else 0

    @staticmethod
    def _list(cells: Cells, view: View) -> int:
        if not view.markers or cells.width < 2 * LIST or cells.height < 3:
            return 0
        return LIST_WIDE if cells.width >= WIDE else LIST

    def _write_time(self, cells: Cells, view: View) -> None:
        left, y = 1 + self.axis(cells), cells.height - 2
        right = cells.width - 1 - self._list(cells, view)
        cells.put(left, y, f"-{SPAN_S:.0f} s", "dim")
        cells.put((left + right) // 2 - 3, y, f"-{SPAN_S / 2.0:.0f} s", "dim")
        cells.right(right, y, "now", "dim")

    def _write_markers(self, cells: Cells, view: View) -> None:
        columns = self._list(cells, view)
        if not columns:
            return
        wide, x = columns == LIST_WIDE, cells.width - columns
        rows = cells.height - 2 - self._below(cells)
        newest = list(reversed(view.markers))
        what = "marker" if len(newest) <= rows else f"newest {rows}"
        head = f"{what:<12}{'level':>5}    now    way back" if wide else f"{what:<11}{'level':>5} now by away"
        cells.put(x + 1, 1, cut(head, columns - 2), "dim")
        for y, marker in enumerate(newest[:rows], 2):
            cells.put(x + 1, y, cut(marker_text(marker, view, wide=wide), columns - 2), "text")
