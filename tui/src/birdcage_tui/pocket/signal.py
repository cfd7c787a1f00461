"""The signal in the pocket view: percent of the peak and the way to it, over the strip of the last minute."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.shown.level_words import is_late, short_words, value_text
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import SignalSample, View


class PocketSignal(SignalPane):
    """As the strip of the dashboard, for who has a hand on the dish."""

    @staticmethod
    def write_reading(cells: Cells, view: View, shown: list[SignalSample], source: str) -> None:  # noqa: ARG004
        """Write the level, then what counts; the words of the dashboard where there is no peak yet.

        For what it is read stands in the row of the target.
        """
        if view.level is None or not short_words(view, cells.width):
            SignalPane.write_reading(cells, view, shown, view.heard_by)
            return
        late = is_late(view, view.level)
        x = cells.put(1, 0, value_text(view.level.level, view.heard), "dim" if late else "strong")
        words = short_words(view, cells.width - x - 3)
        cells.put(x + 2, 0, cut(words, cells.width - x - 3), "dim" if late else "accent-strong")
        if late:
            cells.right(cells.width - 1, 0, f" {age_text(view.now - view.level.at)} old", "warn")
