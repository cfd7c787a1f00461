"""The timeline: passes of the favourites over the next hours, and the moment shown; the mouse moves it."""

from __future__ import annotations

from math import floor

from textual import events
from textual.message import Message

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import fit
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.shown.pass_words import clock_text
from birdcage_tui.shown.sky_picture import ShownPass
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

NAME, WIDE_NAME = 14, 20
"""Columns of the names; where there is room for more."""
ROOMY = 110
SCALES_S = (30.0, 60.0, 120.0, 180.0, 300.0, 600.0)
"""Seconds a column, at choice."""
TICKS_S = (900.0, 1800.0, 3600.0, 7200.0, 14400.0, 28800.0)
WITH_OTHERS = 9
"""Rows from which those that no favourite needs show what else comes into reach."""
HOURS = 6.0
"""What it shows at least, where a scale does so."""
BEHIND = 0.06
"""The part of the width that lies before now."""


class Timeline(Pane):
    """A row for each satellite: thin while it is up, thick while it is in reach."""

    class Scrubbed(Message):
        """A person moved the line with the mouse."""

        def __init__(self, t_s: float) -> None:
            super().__init__()
            self.t_s = t_s

    def __init__(self, selection: PassSelection, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Timeline"
        self._selection = selection
        self._start_s = self._column_s = 0.0
        self._names = NAME
        self._held = False

    def draw(self, cells: Cells, view: View) -> None:
        """Draw the scale, the bars and the line."""
        self._names = WIDE_NAME if cells.width >= ROOMY else NAME
        width = cells.width - self._names - 1
        if width < 20 or cells.height < 3:
            return
        self._column_s = next((scale for scale in SCALES_S if scale * width >= HOURS * 3600.0), SCALES_S[-1])
        now_s, t_s = view.utc.timestamp(), self._selection.time(view)
        self._start_s = self._from(now_s, t_s, width)
        rows = self._lanes(view, cells.height - 1)
        for y, (name, passes, favourite) in enumerate(rows, 1):
            cells.put(0, y, fit(name, self._names - 1),
                      "text" if favourite else "dim")  # fmt: skip
            for row in passes:
                self._bar(cells, y, row, width)
        self._line(cells, now_s, "line", "┆", width)
        self._line(cells, t_s, "accent-strong" if self._selection.machine.is_now else "warn-strong", "│", width)
        for y, (_, passes, _) in enumerate(rows, 1):
            for row in passes:
                self._height(cells, y, row, width)
        self._scale(cells, width)

    def _from(self, now_s: float, t_s: float, width: int) -> float:
        """Return the left end: a little before now, in steps of ten columns; it follows a moment that lies beyond."""
        step = 10.0 * self._column_s
        start = floor((now_s - BEHIND * width * self._column_s) / step) * step
        span = width * self._column_s
        while t_s > start + 0.9 * span:
            start += 0.5 * span
        return start

    def _lanes(self, view: View, room: int) -> list[tuple[str, list[ShownPass], bool]]:
        """Return the rows: favourites; where there are none, satellites whose passes come next in reach."""
        sky, chosen = self._selection.sky(view), self._selection.chosen(view)
        any_favourite = any(row.favourite for row in sky.rows)
        title = "Timeline of favourites, then of what comes next" if room >= WITH_OTHERS else "Timeline of favourites"
        title = title if any_favourite else "Timeline of next passes   * marks a favourite"
        if title != self.border_title:
            self.border_title = title
        lanes: dict[tuple[int, str], list[ShownPass]] = {}
        end_s = self._start_s + 86400.0
        for row in sky.rows:
            key = (row.norad_id, row.name)
            if row.los_s < self._start_s or row.aos_s > end_s:
                continue
            wanted = row.favourite or (row.reach_s > 0 and not row.stays and (room >= WITH_OTHERS or not any_favourite))
            if key in lanes or wanted or (chosen is not None and key == (chosen.norad_id, chosen.name)):
                lanes.setdefault(key, []).append(row)
        own = None if chosen is None else (chosen.norad_id, chosen.name)
        keys = [key for key in lanes if key != own]
        if any_favourite:
            keys.sort(
                key=lambda key: (not lanes[key][0].favourite, key[1].casefold() if lanes[key][0].favourite else "")
            )
        if own in lanes and own is not None:
            keys.insert(0, own)  # the chosen one is always seen
        return [(key[1], lanes[key], lanes[key][0].favourite) for key in keys[:room]]

    def _column(self, at_s: float) -> int:
        return floor((at_s - self._start_s) / self._column_s)

    def _scale(self, cells: Cells, width: int) -> None:
        """Write the hours, or their halves and quarters where there is room."""
        every = next(
            (each for each in (900.0, 1800.0, 3600.0, 7200.0, 14400.0) if each / self._column_s >= 12), 28800.0
        )
        at_s = floor(self._start_s / every + 1.0) * every
        while (column := self._column(at_s)) < width:
            if column + 6 <= width and cells.free(self._names + column + 1, 0, 5):
                cells.put(self._names + column + 1, 0, clock_text(at_s, seconds=False), "dim")
            if cells.free(self._names + column, 0, 1):
                cells.put(self._names + column, 0, "╷", "dim")
            for y in range(1, cells.height):
                if cells.free(self._names + column, y, 1):
                    cells.put(self._names + column, y, "╎", "faint")
            at_s += every

    def _bar(self, cells: Cells, y: int, row: ShownPass, width: int) -> None:
        first, last = self._column(row.aos_s), max(self._column(row.los_s), self._column(row.aos_s))
        for column in range(max(first, 0), min(last + 1, width)):
            cells.put(self._names + column, y, "─", "dim")
        for one in row.reach.intervals:
            for column in range(max(self._column(one.start_s), 0), min(self._column(one.end_s) + 1, width)):
                cells.put(self._names + column, y, "━", "target-strong")

    def _height(self, cells: Cells, y: int, row: ShownPass, width: int) -> None:
        """Write how high it goes behind its bar, where that lies on nothing."""
        words, after = f"{row.max_el_deg:.0f}°", max(self._column(row.los_s), self._column(row.aos_s)) + 1
        if 0 < after <= width - len(words) and cells.free(self._names + after, y, len(words)):
            cells.put(self._names + after, y, words, "dim")

    def _line(self, cells: Cells, at_s: float, ink: str, sign: str, width: int) -> None:
        column = self._column(at_s)
        if 0 <= column < width:
            for y in range(1, cells.height):
                cells.put(self._names + column, y, sign, ink)
            cells.put(self._names + column, 0, "▼", ink)

    def on_mouse_down(self, event: events.MouseDown) -> None:
        """Take hold of the line."""
        if self._scrub(event):
            self._held = True
            self.capture_mouse()

    def on_mouse_move(self, event: events.MouseMove) -> None:
        """Move it along."""
        if self._held:
            self._scrub(event)

    def on_mouse_up(self) -> None:
        """Let go of it."""
        if self._held:
            self._held = False
            self.release_mouse()

    def _scrub(self, event: events.MouseEvent) -> bool:
        offset = event.get_content_offset(self) if not self._held else event.offset - self.gutter.top_left
        if offset is None or offset.x < self._names or not self._column_s:
            return False
        event.stop()
        self.post_message(self.Scrubbed(self._start_s + (offset.x - self._names + 0.5) * self._column_s))
        return True
