"""The tabs of the control page: one row, each name with its key, and a target for the mouse."""

from __future__ import annotations

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

TABS = ("manual", "presets", "craft", "network")


class TabRow(Pane):
    """Names of the tabs; the one that is seen stands out, and says so with a sign."""

    INK = "bar-dim"
    shown = TABS[0]

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it looks the same whatever happens
        """Write them from the left."""
        x = 1
        for name in TABS:
            command, here = BY_NAME[f"tab-{name}"], name == self.shown
            start = x
            if here:
                x = cells.put(x, 0, f" ▼ {command.title} ", "accent-row")
            else:
                x = cells.put(x, 0, f" {command.shown} ", "key")
                x = cells.put(x, 0, f"{command.title} ", "bar")
            self.heat(start, 0, x - start, command.name)
            x += 2
