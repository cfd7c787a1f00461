"""The last row: what the last command did. Where there is room: what those before it did, too."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cut, wrap
from birdcage_tui.panes.sky_next import HEADING, draw_next
from birdcage_tui.shown.allowed import can_move
from birdcage_tui.shown.next_passes import next_rows
from birdcage_tui.shown.pursuit import pursuit_of, told_before_following
from birdcage_tui.shown.stop_words import esc_text
from birdcage_tui.shown.view import CommandNote, View
from birdcage_tui.widgets.pane import Pane

TIME = 11
"""Columns that the time of a command takes, with the gap after it."""

EMPTY = "No earlier commands."


class LastLine(Pane):
    """One sentence with the time of the command, or what to do first."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write it; the time gives way to a long sentence."""
        if view.note and view.told and not told_before_following(view):
            last, x = view.told[-1], 1
            if len(last.words) + TIME + 2 <= cells.width:
                x = cells.put(1, 0, f"{last.utc:%H:%M:%S}Z", "dim") + 2
            cells.put(x, 0, cut(last.words, cells.width - x - 1), "text")
        else:
            cells.put(1, 0, cut(can_move(view) or _hint(view), cells.width - 2), "dim")


def _hint(view: View) -> str:
    """Return what the arrows do where the focus is."""
    if "digits" in view.scopes:
        return f"← → select a digit of the target, ↑ ↓ step it, {esc_text(view, closes='goes back to the rose')}."
    if "presets" in view.scopes:
        return f"↑ ↓ select, Enter turns the dish there, {esc_text(view, closes='goes back to the rose')}."
    if view.horizon.recording:
        return "Recording the horizon: jog along the tree line. Each rest of 1 s adds a point. M ends it."
    pursuit = pursuit_of(view.state)
    if pursuit is not None:
        return f"Tracking {pursuit.plan.aim.name}. An arrow takes over, or g and a direction."
    if view.state.awaits_first_move:
        return "g: send it to a direction first. Arrows then step from there."
    return f"Arrows or hjkl step {view.step_deg:g}°, g goes to a direction, Tab moves to the digits."


TALL = 14
"""Rows from which the next passes stand under what was done."""


def _rows_of(told: CommandNote, cells: Cells) -> list[str]:
    return wrap(told.words, max(cells.width - TIME - 2, 10))


class LogPane(Pane):
    """What the commands before that one did, the latest first."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Earlier"

    def draw(self, cells: Cells, view: View) -> None:
        """Write as many as there is room for."""
        earlier = view.told[:-1] if view.note else view.told
        empty = [] if earlier else wrap(EMPTY, max(cells.width - 2, 10))
        for y, row in enumerate(empty):
            cells.put(1, y, row, "dim")
        bottom = self._passes(cells, view, len(empty) + sum(len(_rows_of(told, cells)) for told in earlier))
        y = 0
        for told in reversed(earlier):
            if y >= bottom:
                return
            cells.put(1, y, f"{told.utc:%H:%M:%S}Z", "dim")
            for row in _rows_of(told, cells):
                if y < bottom:
                    cells.put(1 + TIME, y, row, "text")
                y += 1
            if y >= bottom:
                return

    def _passes(self, cells: Cells, view: View, told: int) -> int:
        """Write in a tall pane what comes into reach next, in what `told` rows leave; return the row where it begins.

        What was told never has less than half of the pane.
        """
        room = cells.height - 2 - min(told, cells.height - cells.height // 2)
        passes = next_rows(view)[:room] if cells.height >= TALL else []
        if not passes:
            return cells.height
        top = cells.height - len(passes) - 1
        cells.put(1, top, HEADING, "dim")
        for y, row in enumerate(passes, top + 1):
            draw_next(cells, y, row, view.utc.timestamp())
            self.heat(0, y, cells.width, "page-passes")
        return top - 1
