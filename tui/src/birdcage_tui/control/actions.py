"""What is asked before it is done: home, engage, release, stow; and the greatest speeds."""

from __future__ import annotations

from birdcage_tui.canvas import Cells
from birdcage_tui.commands import BY_NAME
from birdcage_tui.pane import Pane
from birdcage_tui.view import View

BUTTONS = (("home", "home"), ("engage", "engage"), ("release-motors", "release"), ("stow", "stow"))


def cut(words: str, width: int) -> str:
    """Return the words, with an ellipsis where they are longer than `width`."""
    return words if len(words) <= width else words[: max(width - 1, 0)] + "…"


def speeds_text(view: View) -> str:
    """Return the greatest speeds in force, dashes for what was not read; or that there is no such setting."""
    dish = view.state.dish
    if dish is not None and not dish.has_speeds:
        return "this dish has no speed setting"
    words = []
    for axis in () if dish is None else (dish.azimuth, dish.elevation):
        reading = view.state.readings.get(f"speed.{axis.index}")
        value = reading.value if reading is not None else None
        words.append(f"{value:.1f}" if isinstance(value, int | float) else "--.-")
    return f"speed {'/'.join(words) or '--.-/--.-'} °/s"


class ActionsPane(Pane):
    """Two rows of buttons, or one where it is wide; the speeds; why stow is locked, where there is room."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write them."""
        across = 4 if cells.width >= 42 else 2
        if across == 4:
            taken = sum(len(word) + 3 for _, word in BUTTONS)
            gap, x = min((cells.width - 2 - taken) // 3, 4), 1
            for command, word in BUTTONS:
                self.button(cells, x, 0, command, view, word)
                x += len(word) + 3 + gap
        else:
            for index, (command, word) in enumerate(BUTTONS):
                self.button(cells, 1 + index % 2 * (cells.width - 2) // 2, index // 2, command, view, word)
        y = 4 // across
        words = speeds_text(view)
        dish = view.state.dish
        if dish is not None and not dish.has_speeds:
            cells.put(1, y, words if len(words) < cells.width else words.removeprefix("this "), "dim")
        else:
            self.button(cells, 1, y, "speeds", view, words)
        reason = BY_NAME["stow"].refused(view)
        if reason is not None and cells.height > y + 1:
            cells.put(1, y + 1, cut(reason, cells.width - 2), "dim")
