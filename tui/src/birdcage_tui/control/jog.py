"""The jog step, and the arrows for the mouse."""

from __future__ import annotations

from birdcage_tui.commands import BY_NAME
from birdcage_tui.commands.jog import STEPS_DEG
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

ARROWS = (("left", "◀"), ("up", "▲"), ("down", "▼"), ("right", "▶"))


class JogPane(Pane):
    """One row: four arrows, the step between its two keys. With a second row: every step there is."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write them."""
        narrow = cells.width < 28
        x = 0 if narrow else 1
        for command, glyph in ARROWS:
            x = self._key(cells, x, command, glyph, view) + (0 if narrow else 1)
        x += 1 if narrow else 2
        shown = f"{view.step_deg:g}" if narrow else f"step {view.step_deg:g}°"
        middle = 5 if narrow else 12
        x = self._key(cells, x, "step-down", "-", view)
        x = cells.put(x, 0, f"{shown:^{middle}}", "accent-strong")
        self._key(cells, x, "step-up", "+", view)
        if cells.height > 1:
            x = 1
            for step in STEPS_DEG:
                text = f"{step:g}".replace("0.", ".")
                x = cells.put(x, 1, f"{text:>3} ", "accent-row" if step == view.step_deg else "dim")

    def _key(self, cells: Cells, x: int, command: str, glyph: str, view: View) -> int:
        dim = BY_NAME[command].refused(view) is not None
        self.heat(x, 0, 3, command)
        return cells.put(x, 0, f" {glyph} ", "bar-dim" if dim else "key")
