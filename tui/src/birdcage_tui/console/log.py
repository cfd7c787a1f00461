"""The log: the newest lines at the bottom, until somebody scrolls up to read."""

from __future__ import annotations

from collections.abc import Sequence

from textual import events

from birdcage_tui.console.lines import CellRow, LogLine, Stamps
from birdcage_tui.console.scrollback import KEPT, Scrollback
from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

WHEEL_ROWS = 3
EMPTY = ("No traffic yet.", "Every line on the wire shows here with its time.")


class LogView(Pane, can_focus=True):
    """Draws only the rows that are seen, and sends only those that changed."""

    HELP = (
        "The log shows all traffic on the wire. > is sent to the dish, < comes from it, # is a remark. Polling and the "
        "steps of the tracker fold into one row, and echoes are hidden; p shows every byte. Scrolling up stops "
        "following; End follows again. Space stops the dish here. In the line below it types a space."
    )

    def __init__(self, kept: int = KEPT, *, back: Scrollback | None = None) -> None:
        """Show these lines, which are taken in further; without, begin with none."""
        super().__init__()
        self.back = back or Scrollback(kept)
        self.following = True
        self.top = 0
        """Index of the first row that is seen, while not following."""
        self.needle = ""
        """What is searched for."""
        self._found: list[int] | None = None
        self._found_line = -1
        self._read_to = 0

    @property
    def fresh(self) -> int:
        """How many lines have come since the reader scrolled up."""
        return 0 if self.following else self.back.told - self._read_to

    def add(self, lines: Sequence[LogLine]) -> None:
        """Take lines in; what is being read stays where it is."""
        if not lines:
            return
        self.top = max(self.top - self.back.add(lines), 0)
        self._found = None

    def write_as(self, *, stamps: Stamps | None = None, as_hex: bool | None = None, folded: bool | None = None) -> None:
        """Write the lines in another way; the line at the top stays there."""
        self._lay_out(stamps=stamps, as_hex=as_hex, folded=folded)
        self.repaint()

    def clear(self) -> None:
        """Empty the view; the transcript files keep everything."""
        self.back.clear()
        self._found, self.top, self.following = None, 0, True
        self.repaint()

    def move(self, rows: int) -> None:
        """Scroll down by so many rows (up when negative); at the very end it follows again."""
        self._go(self._first() + rows)

    def turn(self, pages: int) -> None:
        """Scroll by whole pages, one row kept in sight."""
        self.move(pages * max(self.size.height - 1, 1))

    def go_home(self) -> None:
        """Show the oldest line."""
        self._go(0)

    def go_end(self) -> None:
        """Follow the newest line."""
        self.following = True
        self.repaint()

    # Search.

    def search(self, needle: str) -> None:
        """Look for text, and show the newest match."""
        self.needle, self._found, self._found_line = needle, None, -1
        if self.matches:
            self._show_match(self.matches[-1])
        self.repaint()

    def step_match(self, by: int) -> None:
        """Show the match before (-1) or after (1) the one shown."""
        matches = self.matches
        if not matches:
            return
        index = self.match_number
        self._show_match(matches[(index - 1 + by) % len(matches) if index else -1])
        self.repaint()

    @property
    def matches(self) -> list[int]:
        """Indices of the rows with a match, oldest first."""
        if self._found is None:
            self._found = self.back.found(self.needle)
        return self._found

    @property
    def match_number(self) -> int:
        """Which match is shown, from 1; 0 when none is."""
        numbers = [self.back.rows[index].number for index in self.matches]
        return numbers.index(self._found_line) + 1 if self._found_line in numbers else 0

    def _show_match(self, index: int) -> None:
        self._found_line = self.back.rows[index].number
        self._go(index - self.size.height // 2)

    # Where it is.

    def _last_top(self) -> int:
        return max(len(self.back.rows) - self.size.height, 0)

    def _first(self) -> int:
        return self._last_top() if self.following else min(self.top, self._last_top())

    def _go(self, top: int) -> None:
        was_following, last = self.following, self._last_top()
        self.top = min(max(top, 0), last)
        self.following = self.top >= last
        if was_following and not self.following:
            self._read_to = self.back.told
        self.repaint()

    def _lay_out(
        self, width: int | None = None, stamps: Stamps | None = None, as_hex: bool | None = None,
        folded: bool | None = None,
    ) -> None:  # fmt: skip
        first = self._first()
        number = self.back.rows[first].number if first < len(self.back.rows) else 0
        self.back.lay_out(width=width, stamps=stamps, as_hex=as_hex, folded=folded)
        self.top, self._found = self.back.first_row(number), None

    # Drawing.

    def repaint(self) -> None:
        """Draw what is there now."""
        if self.view is not None:
            self.show(self.view)

    def draw(self, cells: Cells, view: View) -> None:  # noqa: ARG002 - the log is not part of the state
        """Draw the rows that are seen, the newest at the bottom."""
        if cells.width != self.back.width:
            self._lay_out(width=cells.width)
        rows = self.back.rows
        if not rows:
            for y, words in enumerate(EMPTY):
                cells.put(1, y, words, "dim")
            return
        first = self._first()
        seen = rows[first : first + cells.height]
        for y, row in enumerate(seen, cells.height - len(seen) if self.following else 0):
            self._draw_row(cells, y, row)

    def _draw_row(self, cells: Cells, y: int, row: CellRow) -> None:
        x = cells.put(0, y, row.stamp, "dim")
        x = cells.put(x, y, f"{row.glyph} ", row.ink)
        cells.put(x, y, row.text, row.ink)
        if not self.needle:
            return
        ink = "accent-row" if row.number == self._found_line else "target-row"
        text, needle = row.text.lower(), self.needle.lower()
        start = text.find(needle)
        while start >= 0:
            cells.put(x + start, y, row.text[start : start + len(needle)], ink)
            start = text.find(needle, start + len(needle))

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Read what came before."""
        event.stop()
        self.move(-WHEEL_ROWS)

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Read on."""
        event.stop()
        self.move(WHEEL_ROWS)
