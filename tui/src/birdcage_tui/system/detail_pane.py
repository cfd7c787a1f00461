"""What there is to say of the row under the cursor of the list beside it."""

from __future__ import annotations

from textual.markup import escape

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.view import View
from birdcage_tui.system.cursor_pane import CursorPane
from birdcage_tui.widgets.pane import Pane


class DetailPane(Pane):
    """Follows the cursor of a list."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._title = ""
        self.list: CursorPane | None = None
        """Whose cursor it follows."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write as much as there is room for."""
        detail = None if self.list is None else self.list.detail(view, cells.width - 2)
        title = "" if detail is None else detail.title
        if self._title != title:
            self._title, self.border_title = title, escape(title)
        if detail is None:
            return
        lines, room = detail.lines, cells.height
        if len(lines) > room:
            lines = [*lines[: room - 1], ("dim", f"… {len(lines) - room + 1} more: Enter shows all")]
        for y, (ink, line) in enumerate(lines):
            cells.put(1, y, line, ink or "text")
