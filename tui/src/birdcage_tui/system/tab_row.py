"""The tabs of the System page: one row, each name with its key, and a target for the mouse."""

from __future__ import annotations

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.system_sheet import waits_for
from birdcage_tui.shown.view import YOU, View
from birdcage_tui.widgets.pane import Pane

TABS = ("health", "hardware", "motors", "settings", "receiver")


class SystemTabs(Pane):
    """Names of the tabs; the one that is seen stands out, and says so with a sign."""

    INK = "bar-dim"
    shown = TABS[0]

    def draw(self, cells: Cells, view: View) -> None:
        """Write them from the left, and at the right whether the page asks the dish now."""
        x = 1
        for name in TABS:
            command, here = BY_NAME[f"system-{name}"], name == self.shown
            start = x
            if here:
                x = cells.put(x, 0, f" ▼ {command.title} ", "accent-row")
            else:
                x = cells.put(x, 0, f" {command.shown} ", "key")
                x = cells.put(x, 0, f"{command.title} ", "bar")
            self.heat(start, 0, x - start, command.name)
            x += 2
        words = _asking(view)
        if len(words) < cells.width - x:
            cells.right(cells.width - 1, 0, words, "bar-dim")


def _asking(view: View) -> str:
    sheet = view.sheet
    task = next((each for each in view.state.tasks if each.done is not None and each.holder == YOU), None)
    if task is not None:
        return f"{task.kind}, {task.done} of {task.of}"
    if waits := waits_for(view.state):
        return waits
    if sheet.asked:
        return f"reading, {len(sheet.asked)} to go"
    return "hidden tabs ask nothing"
