"""The present step in words: what it does, what to look at, what is under way, what went wrong."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.setup.step import Mark, StepView

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import wrap
from birdcage_tui.shown.state_words import span_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

SAME = 20
"""Characters: what begins alike so far is the same."""


@dataclass(slots=True)
class StepText:
    """What there is to tell of one step."""

    step: StepView | None = None
    present: bool = True
    """Whether it is the present one."""
    busy_s: float | None = None
    """For how long something has been under way."""
    note: str = ""
    """What the last key did, or why it did nothing."""
    wrong: str = ""
    """Why the last answer was not taken."""
    whole: bool = False
    """Whether the evidence is to be told as well: its row in the list shows it cut."""
    news: tuple[str, ...] = ()
    """What is to be read first."""
    extra: tuple[str, ...] = ()
    """Sentences of the page itself."""

    def lines(self, width: int) -> list[tuple[str, str]]:
        """Return (ink, line), wrapped."""
        step = self.step
        if step is None:
            return []
        found: list[tuple[str, str]] = []

        def say(ink: str, words: str) -> None:
            found.extend((ink, line) for line in wrap(words, max(width, 10)))

        if self.whole and step.evidence and not self._repeated:
            say({Mark.FAILED: "fault", Mark.DONE: "good"}.get(step.mark, "dim"), step.evidence)
        if step.busy:
            time = "" if self.busy_s is None else f"  {span_text(self.busy_s)}"
            say("accent-strong", f"◌ {step.busy}{time}")
        for sentence in self.news:
            say("good-strong", sentence)
        for sentence in step.words:
            say("text" if self.present else "dim", sentence)
        for sentence in self.extra:
            say("dim", sentence)
        if self.note:
            say("accent", self.note)
        if self.wrong:
            say("warn-strong", f"▲ {self.wrong}")
        return found

    @property
    def _repeated(self) -> bool:
        """Whether the first sentence begins as the evidence does, and says more."""
        step = self.step
        return step is not None and step.evidence[:SAME].casefold() in "".join(step.words[:1]).casefold()


class StepWords(Pane):
    """Draws a `StepText`; `rows` says how many rows it needs."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.telling = StepText()

    def rows(self, width: int) -> int:
        """Return how many rows the words take at that width."""
        return len(self.telling.lines(width - 2))

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - the engine knows what this shows
        """Write the lines."""
        for y, (ink, line) in enumerate(self.telling.lines(cells.width - 2)):
            cells.put(1, y, line, ink)
