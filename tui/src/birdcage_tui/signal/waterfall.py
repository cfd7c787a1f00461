"""The spectra of a source that tells some: frequency across, the newest on top, each cell as dense as it is loud."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

SHADES = " ·░▒▓█"
SPAN_DB = 30.0
"""From the faintest shade to the densest, at least: noise looks like noise."""
EMPTY = "{} tells no spectrum. An RTL-SDR behind rtl_tcp does: s chooses it."


class WaterfallPane(Pane):
    """Rows of spectra, with the frequencies beneath."""

    HELP = "Frequency goes from left to right, time downwards. The arrows of the lowest row mark the measured channel."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Waterfall"

    def draw(self, cells: Cells, view: View) -> None:
        """Draw as many spectra as there are rows."""
        spectra = view.spectra
        if not spectra:
            self._legend("")
            cells.put(1, 0, cut(EMPTY.format(view.heard_by), cells.width - 2), "dim")
            return
        width, rows = cells.width - 2, max(cells.height - 1, 1)
        shown = spectra[-rows:]
        everything = sorted(level for each in shown for level in each.levels)
        low = everything[len(everything) // 4]
        high = max(low + SPAN_DB, everything[-1])
        shade_db = (high - low) / len(SHADES)
        faint, dense = (f"{SHADES[each]} from {low + each * shade_db:.0f}" for each in (1, len(SHADES) - 1))
        self._legend(f"newest on top   {faint}  {dense} {view.heard.unit}")
        for y, spectrum in enumerate(reversed(shown)):
            for x, level in enumerate(_columns(spectrum.levels, width)):
                shade = SHADES[min(max(int((level - low) / (high - low) * len(SHADES)), 0), len(SHADES) - 1)]
                cells.put(1 + x, y, shade, "accent" if y == 0 else "text")
        newest = shown[-1]
        y = cells.height - 1
        cells.put(1, y, f"{newest.low_hz / 1e6:.3f} MHz", "dim")
        cells.right(cells.width - 1, y, f"{newest.high_hz / 1e6:.3f} MHz", "dim")
        hz = (newest.high_hz - newest.low_hz) / width
        left, right = ((each - newest.low_hz) / hz for each in newest.channel_hz)
        words = f"{sum(newest.channel_hz) / 2e6:.3f}"
        left_x, right_x, ends = round(left), round(right), 14
        if right_x - left_x < len(words) + 3:  # the arrows stand around the figure where it hides the channel
            middle = round((left + right) / 2.0)
            left_x, right_x = middle - len(words) // 2 - 2, middle + len(words) // 2 + 2
        if left_x > ends and right_x < width - ends:
            cells.put(1 + (left_x + right_x - len(words) + 1) // 2, y, words, "accent-strong")
        else:
            left_x, right_x = round(left), round(right)
        cells.put(1 + left_x, y, "▲", "accent-strong")
        cells.put(1 + right_x, y, "▲", "accent-strong")

    def _legend(self, words: str) -> None:
        """Tell in the frame what the shades mean."""
        if self.border_subtitle != words:  # setting it repaints the pane, equal or not
            self.border_subtitle = words


def _columns(levels: Sequence[float], width: int) -> list[float]:
    """Return the loudest level of each column."""
    count = len(levels)
    return [
        max(levels[x * count // width : max((x + 1) * count // width, x * count // width + 1)]) for x in range(width)
    ]
