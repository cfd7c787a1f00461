"""The list of passes: what comes next, how long it is in reach, how high it goes."""

from __future__ import annotations

from typing import cast

from textual import events

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import fit, wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.passes.empty import GET_ELEMENTS, empty_words
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.shown.pass_words import clock_text, count_text, reach_sign, reach_text, reasons_text, standing_text
from birdcage_tui.shown.sky_picture import ShownPass
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.spark import Sparks

LEAST_NAME, MOST_NAME = 10, 24
FIXED = 31
"""Columns of everything but name, curve and reason, with the gaps."""
CURVES = ((78, 12), (56, 8), (52, 5))
"""From which width on the curve has how many columns."""
WHY = 12
TIMES = 23
"""Columns of when and where it rises and sets."""
TITLE = "Passes  ● all, ◍ part, ○ none in reach"


class PassList(Pane, can_focus=True):
    """Rows to choose from. Only rows whose text has changed are drawn again."""

    HELP = (
        "Each pass with its next event: AOS and LOS at the horizon, reach and out at the limits of this dish. Then "
        "time in reach, maximum elevation, and the elevation curve, bright where the dish can follow. "
        "● all of it is in reach, ◍ a part, ○ none; and why."
    )

    def __init__(self, selection: PassSelection, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = TITLE
        self._selection = selection
        self._sparks = Sparks()
        self._top = 0
        self._shown: list[ShownPass] = []

    @property
    def page_rows(self) -> int:
        """How many passes are seen at once."""
        return max(self.size.height - 1, 1)

    def draw(self, cells: Cells, view: View) -> None:
        """Write the columns' names, then the rows around the chosen one."""
        rows = self._selection.rows(view)
        self._told(view, len(rows))
        self._shown = []
        if not rows:
            y = 0
            for ink, sentence in empty_words(view, self._selection):
                for line in wrap(sentence, max(cells.width - 2, 10)):
                    cells.put(1, y, line, ink)
                    y += 1
                y += 1
            return
        widths = self._columns(cells.width)
        self._head(cells, widths)
        chosen = self._selection.index(view)
        room = max(cells.height - 1 - self._note(cells, self._selection.sky(view).note), 1)
        self._top = max(min(self._top, chosen, len(rows) - room), chosen - room + 1, 0)
        t_s = self._selection.time(view)
        for y, row in enumerate(rows[self._top : self._top + room], 1):
            self._row(cells, y, row, t_s, self._top + y - 1 == chosen, widths)
            self._shown.append(row)

    @staticmethod
    def _note(cells: Cells, note: str) -> int:
        """Write at the bottom what has to be said of the elements; return how many rows that takes."""
        if not note:
            return 0
        words = f"▲ {note} {GET_ELEMENTS}"
        lines = wrap(words, max(cells.width - 2, 10), most=6)
        for y, line in enumerate(lines, cells.height - len(lines)):
            cells.put(1, y, line, "warn")
        return len(lines)

    def _told(self, view: View, count: int) -> None:
        """Say in the frame how many there are, and how far the search has come."""
        sky = self._selection.sky(view)
        if sky.searched is not None and sky.searched < 1.0:
            words = f"{len(sky.rows)} so far, {sky.searched:.0%} searched"
        else:
            stay = 0 if self._selection.choice.filter else sum(row.stays for row in sky.rows)
            words = f"{count} of {len(sky.rows) - stay}" if sky.rows else ""
            words += f", {stay} always up left out" if stay else ""
        if words != (self.border_subtitle or ""):
            self.border_subtitle = words

    @staticmethod
    def _columns(width: int) -> tuple[int, int, int, bool]:
        """Return the widths of name, curve and reason, and whether AOS and LOS have columns too."""
        curve = next((columns for least, columns in CURVES if width >= least), 0)
        spare = width - FIXED - curve
        timed = spare >= MOST_NAME + 1 + WHY + TIMES
        if timed:
            spare -= TIMES
        name = min(max(spare - WHY, LEAST_NAME), MOST_NAME) if spare >= LEAST_NAME + WHY + 2 else spare
        return name, curve, max(spare - name - 1, 0), timed

    @staticmethod
    def _head(cells: Cells, widths: tuple[int, int, int, bool]) -> None:
        name, curve, _, timed = widths
        cells.put(3, 0, "next event", "dim")
        cells.put(17, 0, "satellite", "dim")
        x = 17 + name
        cells.put(x + 1, 0, "reach", "dim")
        cells.right(x + 11, 0, "max", "dim")
        cells.put(x + 12, 0, "path".center(curve)[:curve], "dim")
        if timed:
            cells.put(cells.width - TIMES, 0, "AOS        LOS", "dim")

    @staticmethod
    def _times(row: ShownPass) -> str:
        """Return when and where it rises and sets: `15:30 223° 15:40  55°`."""
        if row.stays:
            return ""
        rises = "up" if row.already_up else f"{clock_text(row.aos_s, seconds=False)} {row.aos_az_deg:3.0f}°"
        sets = "later" if row.still_up else f"{clock_text(row.los_s, seconds=False)} {row.los_az_deg:3.0f}°"
        return f"{rises:<11}{sets}"

    def _row(
        self, cells: Cells, y: int, row: ShownPass, t_s: float, here: bool, widths: tuple[int, int, int, bool]
    ) -> None:
        width, curve, why, timed = widths
        lit = here and self.has_focus
        text, dim = ("accent-row", "accent-row") if lit else ("text", "dim")
        if lit:
            cells.put(0, y, " " * cells.width, text)
        reachable = bool(row.reach.intervals)
        cells.put(0, y, "▶" if here else " ", text if lit else "accent-strong")
        if row.favourite:
            cells.put(1, y, "★", text if lit else "target")
        event = row.next_event(t_s)
        if event is not None:
            soon = event[1] in ("out", "LOS") or event[0] - t_s < 600.0
            ink = text if lit else "target" if event[1] == "out" else text if soon else dim
            cells.put(3, y, f"{event[1]:<5}", dim)
            cells.right(16, y, count_text(event[0] - t_s), ink)
        else:
            cells.put(3, y, standing_text(row), dim)
        cells.put(17, y, fit(row.name, width), text if reachable else dim)
        x = 17 + width
        cells.right(x + 6, y, reach_text(row), text if reachable else dim)
        cells.right(x + 11, y, f"{row.max_el_deg:.0f}°", dim)
        if curve and not row.stays:  # its curve would be a line
            self._sparks.draw(cells, x + 12, y, curve, row, dim, text if lit else "target")
        sign, ink, words = reach_sign(row.reach)
        x = cells.put(x + 13 + curve, y, sign, text if lit else ink)
        cells.put(x + 1, y, reasons_text(words, why), dim)
        if timed:
            cells.put(cells.width - TIMES, y, self._times(row), dim)

    def on_focus(self) -> None:
        """Show the cursor, once Textual has taken the focus in."""
        self.call_later(self.redraw)

    def on_blur(self) -> None:
        """Show that keys go elsewhere."""
        self.call_later(self.redraw)

    def on_click(self, event: events.Click) -> None:
        """Choose a row."""
        offset = event.get_content_offset(self)
        if offset is not None and 1 <= offset.y <= len(self._shown):
            event.stop()
            self._selection.choose(self._shown[offset.y - 1])
            cast(AppHost, self.app).paint()

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Choose the one below."""
        self._wheel(event, 1)

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Choose the one above."""
        self._wheel(event, -1)

    def _wheel(self, event: events.MouseEvent, by: int) -> None:
        event.stop()
        if self.view is not None:
            self._selection.move(self.view, by)
            cast(AppHost, self.app).paint()
