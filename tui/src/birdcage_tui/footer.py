"""The last row: the keys that hold here, each of them clickable."""

from __future__ import annotations

from birdcage_tui.canvas import Cells
from birdcage_tui.commands import in_force
from birdcage_tui.pane import Pane
from birdcage_tui.view import View


class KeyBar(Pane):
    """Keys and words from the table of commands; while one types, only those that still hold.

    What cannot be done now is dim, and says why when pressed.
    """

    INK = "bar-dim"

    def draw(self, cells: Cells, view: View) -> None:
        """Write STOP, then the keys from the nearest scope outward; at the right, the pages."""
        pages = " F1-F10 pages " if view.typing else " 1-0 pages "
        x = 1
        for command in in_force(view.scopes):
            shown = command.shown
            if view.typing and len(shown) == 1:
                continue  # the field takes it
            if view.typing and command.name == "stop":
                shown = "Ctrl+C"
            if not command.footer or x + len(shown) + len(command.footer) + 3 > cells.width - len(pages):
                continue
            start = x
            dim = command.refused(view) is not None
            x = cells.put(x, 0, f" {shown} ", "bar-dim" if dim else "key")
            x = cells.put(x, 0, command.footer, "bar-dim" if dim else "bar")
            self.heat(start, 0, x - start, command.name)
            x += 2
        start = cells.width - len(pages)
        cells.put(start, 0, pages, "bar")
        self.heat(start, 0, len(pages), "help")
