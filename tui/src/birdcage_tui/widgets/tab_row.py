"""The tabs of a page: one row, each name with its key, and a target for the mouse."""

from __future__ import annotations

from collections.abc import Sequence

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane


class TabRow(Pane):
    """Names of the tabs; the one that is seen stands out, and says so with a sign."""

    INK = "bar-dim"

    def __init__(self, tabs: Sequence[str], prefix: str, *, id: str | None = None) -> None:  # noqa: A002
        """Each tab is shown by the command of its name behind `prefix`; the first is seen first."""
        super().__init__(id=id)
        self._tabs, self._prefix = tuple(tabs), prefix
        self.shown = self._tabs[0]

    def draw(self, cells: Cells, view: View) -> None:
        """Write them from the left, and at the right what is to be said there."""
        x = 1
        for name in self._tabs:
            command, here = BY_NAME[f"{self._prefix}{name}"], name == self.shown
            start = x
            if here:
                x = cells.put(x, 0, f" ▼ {command.title} ", "accent-row")
            else:
                x = cells.put(x, 0, f" {command.shown} ", "key")
                x = cells.put(x, 0, f"{command.title} ", "bar")
            self.heat(start, 0, x - start, command.name)
            x += 2
        fitting = (words for words in self.words(view) if len(words) < cells.width - x)
        cells.right(cells.width - 1, 0, next(fitting, ""), "bar-dim")

    def words(self, view: View) -> tuple[str, ...]:  # noqa: ARG002 - most rows say nothing
        """Return what stands at the right end, in one form or more, the longest first; none for nothing."""
        return ()
