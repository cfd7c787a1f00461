"""The list of the eleven steps: mark, number, title, evidence."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage.setup.step import Mark, StepView
from textual import events
from textual.message import Message

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, wrap
from birdcage_tui.setup.fold import PRESENT, StepRow, folded_text, glyph_of
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

TITLE_WIDTH = 15
LABEL_WIDTH = 8 + TITLE_WIDTH
"""Of a row, before its evidence."""
ROOMY = 50
"""Rows from which an open step says what it asks for, and up to `MOST_AIR` blank ones stand between the steps."""
MOST_AIR = 2


class StepsPane(Pane):
    """A row for each step, or several under the title when there is room; a click looks at the step."""

    class Chosen(Message):
        """A person wants to look at that step (counted from 0)."""

        def __init__(self, index: int) -> None:
            super().__init__()
            self.index = index

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._steps: Sequence[StepView] = ()
        self._rows: Sequence[StepRow] = ()
        self._looked = 0
        self._present = ""
        self.tall = False
        """Whether evidence may have rows of its own."""
        self._at: list[int] = []
        """Which step stands in each row of the screen."""

    def tell(self, steps: Sequence[StepView], rows: Sequence[StepRow], looked: int, present: str) -> None:
        """Take what the next frame shows."""
        self._steps, self._rows, self._looked, self._present = steps, rows, looked, present

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - the engine knows what this shows
        """Draw one row a step; where there is room, the evidence in rows of its own under the title."""
        self._at = []
        blocks = self._blocks(cells.width, cells.height)
        if blocks is None:
            for row in self._rows:
                self._row(cells, len(self._at), row)
                self._at.append(row.first)
            return
        rows = sum(1 + len(block) for block in blocks)
        between = len(blocks) - 1
        gap = MOST_AIR if cells.height >= ROOMY else 1
        while gap and rows + gap * between > cells.height:
            gap -= 1
        for row, block in zip(self._rows, blocks, strict=True):
            y = len(self._at)
            self._head(cells, y, row.first)
            ink = self._ink(self._steps[row.first])
            for line, text in enumerate(block, 1):
                cells.put(7, y + line, text, ink)
            self._at += [row.first] * (1 + len(block) + gap)

    def _blocks(self, width: int, height: int) -> list[list[str]] | None:
        """Return the evidence of each step, wrapped as far as there is room; None if a row a step must do."""
        if not self.tall or not all(row.single for row in self._rows):
            return None
        for most in (3, 2, 1):
            blocks = [
                wrap(self._told(self._steps[row.first], height), max(width - 9, 10), most=most) for row in self._rows
            ]  # fmt: skip
            if sum(1 + len(block) for block in blocks) <= height:
                return blocks
        return None

    @staticmethod
    def _words(step: StepView) -> str:
        if step.busy:
            return f"{step.busy} …"
        return step.evidence or (step.mark.value if step.mark in (Mark.SKIPPED, Mark.LATER) else "")

    def _told(self, step: StepView, height: int) -> str:
        """Return what is known of a step; of an open one, where there is room, what it is about."""
        about = " ".join(step.words) if height >= ROOMY else ""
        return self._words(step) or about

    @staticmethod
    def _ink(step: StepView) -> str:
        if step.mark is Mark.FAILED or step.busy:
            return "warn"
        return "text" if step.mark is Mark.DONE else "dim"

    def cuts(self, step: StepView) -> bool:
        """Return whether the evidence of a step is too long for its row."""
        words = self._words(step)
        if not self.tall:
            return len(words) > self.size.width - LABEL_WIDTH - 1
        blocks = self._blocks(self.size.width, self.size.height)
        return blocks is None or any(block[-1].endswith("…") for block in blocks if block)

    def _row(self, cells: Cells, y: int, row: StepRow) -> None:
        step = self._steps[row.first]
        if not row.single:
            folded = self._steps[row.first : row.last + 1]
            marks = {each.mark for each in folded}
            glyph, ink = glyph_of(step) if len(marks) == 1 else ("·", "dim")
            cells.put(2, y, glyph, ink)
            cells.put(4, y, cut(folded_text(folded), cells.width - 5), "dim")
            return
        self._head(cells, y, row.first)
        cells.put(LABEL_WIDTH, y, cut(self._words(step), cells.width - LABEL_WIDTH - 1), self._ink(step))

    def _head(self, cells: Cells, y: int, index: int) -> None:
        step = self._steps[index]
        present = step.name == self._present
        glyph, ink = glyph_of(step)
        looked = index == self._looked
        if looked:
            cells.put(0, y, " " * min(LABEL_WIDTH - 1, cells.width), "bar")
            ink = "key"
        if present:
            cells.put(0, y, PRESENT[0], "key" if looked else PRESENT[1])
        cells.put(2, y, glyph, ink)
        cells.put(4, y, f"{step.number:<2} {step.title}"[: TITLE_WIDTH + 3],
                  "key" if looked else "strong" if present else "text")  # fmt: skip

    def on_click(self, event: events.Click) -> None:
        """Look at the step under the mouse."""
        offset = event.get_content_offset(self)
        if offset is not None and offset.y < len(self._at):
            event.stop()
            self.post_message(self.Chosen(self._at[offset.y]))
