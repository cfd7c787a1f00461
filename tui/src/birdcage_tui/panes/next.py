"""What it is doing, what stops it, what comes next, and which key makes it so; then the next passes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.panes.next_steps import next_steps
from birdcage_tui.panes.sky_next import HEADING, WITH_AZIMUTHS, draw_next, troubled
from birdcage_tui.shown.next_passes import is_followed, next_rows
from birdcage_tui.shown.unready import worst
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage_tui.widgets.spark import Sparks

WITH_HEADING = 4
"""Passes from which on their list has a heading, where it is wide."""
FOR_WORDS = 9
"""Rows of a tall pane that the sentences keep at most; the others are for passes."""


def _wrapped(words: str, width: int) -> list[str]:
    """Return rows no wider than `width`; a number keeps its unit."""
    rows = wrap(words.replace("12 V", "12\N{NO-BREAK SPACE}V"), width)
    return [row.replace("\N{NO-BREAK SPACE}", " ") for row in rows]


class NextPane(Pane):
    """Plain sentences, most important first."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "What next"
        self._sparks: Sparks | None = None

    def draw(self, cells: Cells, view: View) -> None:
        """Wrap the sentences; in a tall pane a blank row parts them. Passes stand below, where nothing is wrong."""
        width = max(cells.width - 2, 10)
        steps = [(ink, words, _wrapped(words, width)) for ink, words in next_steps(view)]
        rows = sum(len(lines) for *_, lines in steps)
        passes, finding = [row for row in next_rows(view) if not is_followed(row, view.state)], worst(view)
        first = steps[: 2 if finding is not None and finding.words in [words for _, words, _ in steps[:2]] else 1]
        spare = cells.height - (rows if troubled(view) else sum(len(lines) for *_, lines in first))
        heading = cells.width >= WITH_AZIMUTHS and len(passes) >= WITH_HEADING
        kept = max(
            min(
                len(passes) + heading,
                spare,
                max(cells.height // 2, cells.height - min(FOR_WORDS, rows + len(steps)), 2),
            ),
            0,
        )
        height = cells.height - kept
        air = 1 if height >= rows + len(steps) - 1 + bool(kept) else 0
        y = 0
        for ink, words, lines in steps:
            if y and y + len(lines) > height:
                break  # half a sentence is worse than none
            mends = finding is not None and words == finding.words
            for line in lines:
                cells.put(1, y, line, ink)
                if finding is not None and finding.command and mends:
                    self.heat(0, y, cells.width, finding.command)
                y += 1
            y += air
        if heading and kept > WITH_HEADING:
            cells.put(1, y, HEADING, "dim")
            y, kept = y + 1, kept - 1
        if kept and self._sparks is None and cells.width >= WITH_AZIMUTHS:
            from birdcage_tui.widgets.spark import Sparks  # rows are there, so what it needs is loaded

            self._sparks = Sparks()
        for below, row in enumerate(passes[:kept], max(y, 0)):
            draw_next(cells, below, row, view.utc.timestamp(), sparks=self._sparks)
            self.heat(0, below, cells.width, "pocket-passes" if "pocket" in view.scopes else "page-passes")
