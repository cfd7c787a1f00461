"""The last rows: where one can go, and the keys that hold here; each of them clickable."""

from __future__ import annotations

from textual.widgets import ContentSwitcher

from birdcage_tui.commands import PAGES, in_force
from birdcage_tui.commands.mending import held_up, offered
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.allowed import can_move
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.scope import Scope

LACKED = frozenset({"motor"})
"""Pages for hardware that none of the dishes has whose both axes this program moves."""
PARTS = {"calibrate": "setup"}
"""Pages that stand behind a tab of another."""


class PageBar(Pane):
    """The pages by number and name, the one that is seen lit; the console too while it lies over it.

    Only where there is room for a row of its own: 100 columns and 30 rows.
    """

    INK = "bar-dim"

    def draw(self, cells: Cells, view: View) -> None:
        """Write them from the left, and leave out what this dish has no use for, unless it is seen."""
        here, x = self._here(), 1
        for number, (name, title, _) in enumerate(PAGES, 1):
            lit, start = name in here, x
            if name in LACKED and not lit and view.state.dish is not None:
                continue
            key = f"F{number}" if view.typing else str(number % 10)
            x = cells.put(x, 0, f" {key} ", "accent-row" if lit else "key")
            x = cells.put(x, 0, f"{title} " if lit else title, "accent-row" if lit else "bar")
            self.heat(start, 0, x - start, f"page-{name}")
            x += 0 if lit else 1

    def _here(self) -> set[str]:
        """Return the page that is seen, and the console while that is open."""
        screen = self.app.screen_stack[0]
        shown = (screen.query_one("#pages", ContentSwitcher).current or "").removeprefix("page-")
        beside = screen.query_one("#stage").children
        console = any(each.display for each in beside if isinstance(each, Scope) and each.scope == "console")
        return {PARTS.get(shown, shown), *({"console"} if console else ())}


class KeyBar(Pane):
    """Keys and words from the table of commands; while one types, only those that still hold.

    What cannot be done now is dim, and says why when pressed; of a motion, what mends it stands in its place.
    """

    INK = "bar-dim"

    def draw(self, cells: Cells, view: View) -> None:
        """Write STOP, then the keys from the nearest scope outward; at the right, the pages where no row names them."""
        pages = " F1-F10 pages " if view.typing else "" if self._pages_are_named() else " 1-0 pages "
        still = can_move(view) is not None
        room, x = cells.width - len(pages), 1
        told: set[str] = set()
        for command in in_force(view.scopes):
            if not command.footer or (view.typing and len(command.shown) == 1):
                continue  # a field takes it
            name, shown, word = command.name, command.shown, command.footer
            if still and command.footer_still:
                word = command.footer_still
            if view.typing and name == "stop":
                shown = "Ctrl+C"
            dim = held_up(command, view) is not None
            mend = offered(command, view)
            if mend is not None and mend.words not in told:
                name, shown, word, dim = mend.command, mend.shown or shown, mend.words, not mend.command
                told.add(word)
            elif mend is not None or name in told:
                continue  # what comes first stands there already
            if x + len(shown) + len(word) + 3 > room:
                continue
            told.add(name)
            start = x
            x = cells.put(x, 0, f" {shown} ", "bar-dim" if dim else "key")
            x = cells.put(x, 0, word, "bar-dim" if dim else "bar")
            self.heat(start, 0, x - start, name or command.name)
            x += 2
        if pages:
            start = cells.width - len(pages)
            keys, _, word = pages.strip().partition(" ")
            cells.put(cells.put(start, 0, f" {keys} ", "key"), 0, f"{word} ", "bar")
            self.heat(start, 0, len(pages), "help")

    def _pages_are_named(self) -> bool:
        bar = self.app.screen_stack[0].query_one_optional(PageBar)
        return bar is not None and bar.display
