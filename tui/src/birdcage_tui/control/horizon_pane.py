"""The keys of the horizon, and what it is at this azimuth."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.horizon_state import count_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

KEYS = (
    ("horizon-mark", "mark"),
    ("horizon-record", "rec"),
    ("horizon-undo", "undo"),
    ("horizon-draw", "draw"),
    ("horizon-type", "type"),
)
CLEAR = "horizon-clear", "clear"
"""It stands apart, in the row of words."""
LEAST_WIDE = 42


def horizon_text(view: View) -> tuple[str, str]:
    """Return the ink and the words: how many points, and how high it is where the dish looks."""
    mask, position = view.horizon.mask, view.state.position
    if view.horizon.recording:
        return "warn-strong", f"● RECORDING  {count_text(mask)}"
    words = f"horizon {count_text(mask)}"
    if mask and not mask.is_line:
        words += ", no line yet"
    elif mask and position is not None and view.link_up:
        words += f", {mask.at(position.az_deg):.1f}° here"
    return "dim", words


class HorizonPane(Pane):
    """One row of keys, as many as there is room for; with a second row: what the horizon is."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write them."""
        wide = cells.width >= LEAST_WIDE
        left = 1 if wide else 0
        y = 0
        if cells.height > 1:
            ink, told = horizon_text(view)
            start = self.button(cells, cells.width - len(CLEAR[1]) - 5, 0, CLEAR[0], view, CLEAR[1])
            cells.put(left, 0, told[: start - len(CLEAR[1]) - 6 - left], ink)
            y = 1
        recording = view.horizon.recording
        words = {command: "end" if command == "horizon-record" and recording else name for command, name in KEYS}
        # Without gaps, if only so all of them find room.
        gap = 1 if left + sum(len(word) + 5 for word in words.values()) - 1 <= cells.width else 0
        x = left
        for command, word in words.items():
            length = len(word) + 4
            if x + length <= cells.width:
                x = self.button(cells, x, y, command, view, word) - 1 + gap
