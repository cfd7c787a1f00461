"""The page's first row: which moment is shown, what is filtered, and what the elements are."""

from __future__ import annotations

from birdcage.base.config import feed_label

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.passes.passes_layout import BESIDE_MAP
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.shown.pass_words import clock_text, shift_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

WIDE = 100
"""Columns from which on a moment that is not now leaves room for the button of the map."""


class PassHeadRow(Pane):
    """One row; all of it in a colour of its own while it is not now that is shown."""

    def __init__(self, selection: PassSelection, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._selection = selection

    def draw(self, cells: Cells, view: View) -> None:
        """Write the moment at the left, then the choice; what is at the right is left out where it does not fit."""
        machine, sky = self._selection.machine, self._selection.sky(view)
        now_s, t_s = view.utc.timestamp(), self._selection.time(view)
        if machine.is_now:
            x = cells.put(1, 0, "now", "accent-strong")
            x = cells.put(x + 1, 0, f"{clock_text(now_s)}Z", "text") + 2
            x = self.button(cells, x, 0, "time-forward", view, "later") + 1
        else:
            cells.put(0, 0, " " * cells.width, "warn-row")
            pace = "paused" if machine.paused else f"{machine.speed}x"
            x = cells.put(1, 0, f"▲ NOT NOW  {clock_text(t_s)}Z, {shift_text(t_s - now_s)}, {pace}", "warn-row") + 2
            x = self.button(cells, x, 0, "time-now", view, "back to now") + 1
        if machine.is_now or cells.width >= WIDE or self._selection.world:
            x = self.button(cells, x, 0, "pass-world", view, "list" if self._selection.world else "world") + 1
        quiet = "dim" if machine.is_now else "warn-row"
        for words, command in self._told(view, cells.width - 1 - x):
            cells.put(x, 0, words, quiet)
            self.heat(x, 0, len(words), command)
            x += len(words) + 2
        words = f"▲ {sky.source}" if sky.note else sky.source
        if words and x + len(words) < cells.width:
            cells.right(cells.width - 1, 0, words, "warn" if sky.note and machine.is_now else quiet)

    @property
    def _alone(self) -> bool:
        """Whether the map has the page for itself: then there is no list to be in any order."""
        return self._selection.world and self.size.width < BESIDE_MAP

    def _told(self, view: View, room: int) -> list[tuple[str, str]]:
        """Return (words, command) of what is hidden, and the order; where that does not fit, how many filters hide.

        What hides passes is told first: without it a short list looks like a quiet sky.
        """
        choice, sky = self._selection.choice, self._selection.sky(view)
        filters = [(f'/ "{choice.filter}"', "pass-filter")] if choice.filter else []
        if choice.reachable_only:
            filters.append(("in reach only", "pass-reachable"))
        if self._selection.hearable(view):
            filters.append((f"heard by {feed_label(sky.feed)}", "pass-hearable"))
        if choice.favourites_only:
            filters.append(("favourites only", "pass-favourites"))
        order = [] if self._alone else [(f"sort: {choice.sort}", "pass-sort")]
        counted = [(f"{len(filters)} filter{'s' if len(filters) > 1 else ''}", "pass-filter")] if filters else []
        for parts in ([*filters, *order], filters, [*counted, *order], counted):
            if sum(len(words) + 2 for words, _ in parts) - 2 <= room:
                return parts
        return []
