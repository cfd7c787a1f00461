"""What is asked before it is done: home, engage, release, stow; and the greatest speeds."""

from __future__ import annotations

from birdcage.station.known import speed_of

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

BUTTONS = (("home", "home"), ("engage", "engage"), ("release-motors", "release"), ("stow", "stow"))


def speeds_text(view: View) -> str:
    """Return the greatest speeds in force, dashes for what was not read; or that there is no such setting."""
    dish = view.state.dish
    if dish is not None and not dish.has_speeds:
        return "this dish has no speed setting"
    words = []
    for axis in () if dish is None else (dish.azimuth, dish.elevation):
        reading = view.state.readings.get(speed_of(axis.name))
        value = reading.value if reading is not None else None
        words.append(f"{value:.1f}" if isinstance(value, int | float) else "--.-")
    return f"speed {'/'.join(words) or '--.-/--.-'} °/s"


class ActionsPane(Pane):
    """Two rows of buttons, or one where it is wide; the speeds; why stow is locked, where there is room."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write them."""
        wide = cells.width >= 42
        left = 1 if wide else 0
        if wide:
            x = left
            for command, word in BUTTONS:
                x = self.button(cells, x, 0, command, view, word)
        else:
            for index, (command, word) in enumerate(BUTTONS):
                self.button(cells, left + index % 2 * 12, index // 2, command, view, word)
        y = 1 if wide else 2
        words = speeds_text(view)
        dish = view.state.dish
        if dish is not None and not dish.has_speeds:
            cells.put(left, y, words if len(words) < cells.width else words.removeprefix("this "), "dim")
        else:
            self.button(cells, left, y, "speeds", view, words)
        reason = BY_NAME["stow"].refused(view)
        if reason is not None and cells.height > y + 1:
            cells.put(left, y + 1, cut(reason, cells.width - 2), "dim")
