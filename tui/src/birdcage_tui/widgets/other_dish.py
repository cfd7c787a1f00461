"""The row of a dish whose pages are not seen: the same as row 1, and what shows it."""

from __future__ import annotations

from typing import Protocol, cast

from textual import events

from birdcage_tui.commands import BY_NAME
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.state_words import bad_day
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.messages import CommandChosen
from birdcage_tui.widgets.status import ACTIVITY_FIELD, StatusLine

SHOW = "other-dish"


class DishChanger(Protocol):
    """The app, seen from this row."""

    def show_other_dish(self) -> None:
        """Show the next dish on the pages."""


class OtherDishRow(StatusLine):
    """Link, name, position and activity of the other dish, HELD and faults in colour. A press shows its pages."""

    scope = "dishes"

    def show(self, view: View) -> None:
        """Take the other dish's view out of that of the frame."""
        if view.others:
            super().show(view.others[0])

    @staticmethod
    def fields(view: View, *, wide: bool) -> list[tuple[str, str]]:
        """Return those of row 1; what row 2 would say of this dish stands in the colour of its activity."""
        fields = StatusLine.fields(view, wide=wide)
        wrong = bad_day(view)
        if wrong is not None:
            fields[ACTIVITY_FIELD] = (fields[ACTIVITY_FIELD][0], wrong[0])
        return fields

    def right(self, cells: Cells, view: View) -> int:
        """Write the key that shows it; return the column before that."""
        key = BY_NAME[SHOW].shown
        end = super().right(cells, view) - len(key) - 2
        cells.put(end, 0, f" {key} ", "key")
        return end - 1

    def on_mouse_down(self, event: events.MouseDown) -> None:
        """Show it."""
        event.stop()
        self.post_message(CommandChosen(SHOW))

    def do(self, command: str) -> bool:
        """Show it on the pages."""
        if command != SHOW:
            return False
        cast(DishChanger, self.app).show_other_dish()
        return True
