"""The last row: what the last command did."""

from __future__ import annotations

from birdcage_tui.canvas import Cells
from birdcage_tui.commands.table import can_move
from birdcage_tui.pane import Pane
from birdcage_tui.view import View


class LastLine(Pane):
    """One sentence with the time of the command, or what to do first."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._note = self._at = ""

    def draw(self, cells: Cells, view: View) -> None:
        """Write it."""
        if view.note != self._note:
            self._note, self._at = view.note, f"{view.utc:%H:%M:%S}Z"
        if view.note:
            x = cells.put(1, 0, f"{self._at}  ", "dim")
            cells.put(x, 0, view.note[: max(cells.width - x - 1, 0)], "text")
        else:
            hint = f"Arrows or hjkl step {view.step_deg:g}°, g goes to a direction, Tab goes on to the digits."
            cells.put(1, 0, (can_move(view) or hint)[: max(cells.width - 2, 0)], "dim")
