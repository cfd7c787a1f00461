"""How well it is heard now: the numbers that count with both hands on the dish, legible at two metres."""

from __future__ import annotations

from birdcage.signal.peak_hold import LevelNow, Trend

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, wrap
from birdcage_tui.drawing.digits import put_big, width_of
from birdcage_tui.panes.signal import why_no_signal
from birdcage_tui.shown.level_words import TRENDS, db_text, followed_name, is_late, peak_words, value_text
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

LARGE = (50, 9)
"""Columns and rows from which the digits are five rows tall."""
BESIDE = 26
"""Columns that the words beside the digits take at least."""


def is_large(cells: Cells) -> bool:
    """Return whether there is room for digits five rows tall."""
    return cells.width >= LARGE[0] and cells.height >= LARGE[1]


class LevelPane(Pane):
    """Percent of the peak in big digits, the level over its floor, the age of the reading, and a bar."""

    HELP = "How much of the strongest signal is heard now. Arrows step the dish, - and + change the step."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Level"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw numbers and bar, or why there are none."""
        level = view.level
        if level is None:
            put_big(cells, 1, 0, "---", "dim")
            for row, line in enumerate(wrap(why_no_signal(view), max(cells.width - 2, 10)), 4):
                cells.put(1, row, line, "warn" if view.signal_trouble else "dim")
            return
        late = is_late(view, level)
        big = value_text(level.level, view.heard) if level.share is None else f"{max(level.share, 0.0) * 100.0:.0f}"
        big = big.rjust(3)
        large = is_large(cells) and cells.width - width_of(big, large=True) >= BESIDE
        x = put_big(cells, 1, 0, big, "dim" if late else "strong", large=large) + 1
        tall = 5 if large else 3
        first = f"% of {peak_words(view)}  {TRENDS[level.trend]}" if level.share is not None else view.heard.unit
        ink = "dim" if late else "accent-strong" if level.trend is Trend.HOTTER else "text"
        cells.put(x, tall - 3, cut(first.rstrip(), cells.width - x - 1), ink)
        cells.put(x, tall - 2, cut(_with_floor(level, view, cells.width - x - 1), cells.width - x - 1), "text")
        cells.put(x, tall - 1, cut(_age(level, view), cells.width - x - 1),
                  "warn" if late else "dim")  # fmt: skip
        if cells.height > tall + 1:
            self._bar(cells, tall + 1, min(cells.height - tall - 1, 3), level, late=late)

    @staticmethod
    def _bar(cells: Cells, y: int, rows: int, level: LevelNow, *, late: bool) -> None:
        """Draw the share of the peak as a bar; hatched while it cannot be told."""
        width = cells.width - 4
        for row in range(y, y + rows):
            if level.share is None:
                cells.put(1, row, "▕" + "·" * width + "▏", "line")
                continue
            filled = max(0, min(width, round(level.share * width)))
            cells.put(1, row, "▕" + " " * width + "▏", "line")
            cells.put(2, row, "█" * filled, "dim" if late else "accent")


def _with_floor(level: LevelNow, view: View, room: int) -> str:
    """Return the level over the lowest that was heard, or that peak and floor are still to be told apart."""
    heard, lowest = view.heard, "lowest" if followed_name(view) else "floor"
    if level.floor is None or level.share is None:
        noise = "" if level.noise is None else f", noise ±{level.noise:.{max(heard.decimals, 1)}f}"
        return next(
            (words for words in (f"no peak yet{noise}", f"no peak{noise}") if len(words) <= room), "no peak yet"
        )
    return f"{value_text(level.level, heard)} {heard.unit}, {lowest} {value_text(level.floor, heard)}"


def _age(level: LevelNow, view: View) -> str:
    """Return the age of the reading, and what it is in dB."""
    in_db = db_text(level.level, view)
    return f"{age_text(view.now - level.at)} old" + (f"   {in_db}" if in_db else "")
