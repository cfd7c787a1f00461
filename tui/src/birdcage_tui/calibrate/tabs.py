"""The tabs of F8: one row, each name with its key, and a target for the mouse."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

TITLE = "from wires to the first satellite"
TABS = (("setup", "page-setup", "8", "Setup"), ("calibrate", "tab-calibrate", "C", "Calibrate"))


class SetupTabs(Pane):
    """Names of the tabs; the one that is seen stands out, and says so with a sign."""

    INK = "bar-dim"

    def __init__(self, shown: str) -> None:
        super().__init__(classes="setup-tabs")
        self._shown = shown

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - it looks the same whatever happens
        """Write them from the left; where a frame lies below, as its upper line."""
        framed = self._shown == "setup" and not self.screen.has_class("-wide")
        if framed:
            cells.put(0, 0, f"╭{'─' * (cells.width - 2)}╮", "line")
        x = 2 if framed else 1
        for name, command, key, title in TABS:
            start = x
            if name == self._shown:
                x = cells.put(x, 0, f" ▼ {title} ", "accent-row")
            else:
                x = cells.put(x, 0, f" {key} ", "key")
                x = cells.put(x, 0, f"{title} ", "bar")
                self.heat(start, 0, x - start, command)
            x += 2
        if framed:
            cells.put(x, 0, f" {TITLE} ", "dim")
