"""Which steps have a row of their own in a list that is too short for all, and what stands for the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from birdcage.setup.step import Mark, StepView

GLYPHS = {
    Mark.TODO: ("○", "dim"),
    Mark.DONE: ("✓", "good"),
    Mark.SKIPPED: ("–", "dim"),
    Mark.FAILED: ("✕", "fault"),
    Mark.LATER: ("…", "dim"),
}
PRESENT = ("▶", "accent-strong")
"""Stands before the mark of the step that is answered."""


@dataclass(frozen=True, slots=True)
class StepRow:
    """Steps `first` to `last`, counted from 0: one of them, or several folded into one row."""

    first: int
    last: int

    @property
    def single(self) -> bool:
        """Whether it is one step."""
        return self.first == self.last


def fold(count: int, looked: int, room: int) -> tuple[StepRow, ...]:
    """Return the rows for `count` steps when there is room for `room`; the one looked at is always its own."""
    first = last = looked
    fits: tuple[int, int] | None = (looked, looked)
    while fits is not None:
        first, last = fits
        # Below comes first: what is to come matters more than what is done.
        wider = ((first, last + 1), (first - 1, last))
        fits = next((pair for pair in wider if pair[0] >= 0 and pair[1] < count and _rows(count, *pair) <= room), None)
    rows = [StepRow(index, index) for index in range(first, last + 1)]
    above = [StepRow(0, first - 1)] if first else []
    below = [StepRow(last + 1, count - 1)] if last < count - 1 else []
    return (*above, *rows, *below)


def _rows(count: int, first: int, last: int) -> int:
    return (first > 0) + (last - first + 1) + (last < count - 1)


def folded_text(steps: Sequence[StepView]) -> str:
    """Return the words for several steps in one row."""
    titles = ", ".join(step.title for step in steps)
    return f"{steps[0].number}–{steps[-1].number}  {titles}"


def glyph_of(step: StepView) -> tuple[str, str]:
    """Return the mark of a step and its ink."""
    return GLYPHS[step.mark]
