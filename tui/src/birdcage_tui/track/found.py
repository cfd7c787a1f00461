"""Targets to choose from: what was found, or, before anything is typed, the favourites and what is up."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from textual import events

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import cell_len, cut, fit, wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.pass_words import count_text, reach_text
from birdcage_tui.shown.pursuit import LOADING
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

MOST_UP = 40
DETAIL = 26
"""Columns that are kept for what is told of a target; a longer name takes up to three fifths of a row."""
UP = "up now"
EMPTY = "Searching …"
HEADINGS = "name", "number · elements", "next event"
BRIEF = 16
"""The same without time in reach: what a person chooses by, where a number and an age have no room."""
PASS = 30
"""Columns of the next pass: its event, countdown, maximum and time in reach."""


@dataclass(frozen=True, slots=True)
class FoundTarget:
    """A row: what is given to the desk, and what a person reads."""

    text: str
    name: str
    detail: str
    favourite: bool = False
    silent: bool = False
    """Whether it is known to send nothing any more: its detail says so, and no pass may stand in its place."""
    up: bool = False
    """Whether it is listed because it is up now."""


def candidates(view: View) -> list[FoundTarget]:
    """Return the rows: what the desk has found; with nothing typed, what is up besides, the highest first."""
    desk = view.track
    if desk is None or desk.is_away:
        return []
    rows = [FoundTarget(one.text, one.name, one.detail or one.kind, one.favourite, one.silent) for one in desk.found]
    if desk.query.strip() or view.sky is None:
        return rows
    known = {row.name for row in rows}
    floor = view.state.el_min_deg or 0.0
    up = sorted((one for one in view.sky.up if one.name not in known and not one.fixed), key=lambda one: -one.el_deg)
    return rows + [
        FoundTarget(str(one.norad_id or one.name), one.name,
                  f"{UP}, {one.el_deg:.0f}°{'' if one.el_deg >= floor else ', too low'}", one.favourite, up=True)
        for one in up[:MOST_UP]
    ]  # fmt: skip


def next_passes(view: View, wanted: set[str], *, brief: bool = False) -> dict[str, str]:
    """Return what comes next of each of these satellites that passes: `reach   02:58   71°    7m28`.

    `brief`: as `reach 02:58  71°`.
    """
    found: dict[str, str] = {}
    now_s = view.utc.timestamp()
    for row in () if view.sky is None else view.sky.rows:
        text = str(row.norad_id or row.name)
        event = row.next_event(now_s) if text in wanted and text not in found else None
        if event is not None:
            count = count_text(event[0] - now_s)
            told = f"{event[1]:<6}{count:>7} {row.max_el_deg:>4.0f}°{reach_text(row):>8}"
            found[text] = f"{event[1]:<5}{count:>6}{row.max_el_deg:>4.0f}°" if brief else told
    return found


def _nothing(view: View) -> str:
    """Return why there is no row."""
    desk = view.track
    if desk is None:
        return LOADING
    if desk.is_away:
        return desk.problem
    if desk.query.strip():
        return desk.found_note or EMPTY
    return "No favourites, and nothing is up. / searches. On page 7, * marks favourites."


class FoundList(Pane):
    """Rows with a cursor. The keys are the tab's: a text field may have the focus meanwhile."""

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Targets"
        self.cursor = 0
        self._top = self._above = 0
        self._moved = False

    def move(self, by: int) -> None:
        """Move the cursor."""
        if self.view is not None:
            here = self._here(self.view)
            self.cursor = 0 if here is None else min(max(here + by, 0), max(len(candidates(self.view)) - 1, 0))
            self._moved = True
            self.show(self.view)

    def chosen(self, view: View) -> FoundTarget | None:
        """Return the one under the cursor; None when there is none."""
        here = self._here(view)
        return None if here is None else candidates(view)[here]

    def restart(self) -> None:
        """Go back to the first row: another text was typed."""
        self.cursor, self._moved = 0, False

    def _here(self, view: View) -> int | None:
        """Return the row under the cursor; None while none of them is what was typed, until a person moves there."""
        rows = candidates(view)
        if not rows or (not self._moved and view.track is not None and view.track.found_note):
            return None
        return min(self.cursor, len(rows) - 1)

    def draw(self, cells: Cells, view: View) -> None:
        """Write the rows around the cursor."""
        rows = candidates(view)
        if not rows:
            words = _nothing(view)
            for y, line in enumerate(wrap(words, max(cells.width - 2, 10))):
                cells.put(1, y, line, "dim")
            return
        self.cursor = min(self.cursor, len(rows) - 1)
        above, chosen = self._note(cells, view) + 1, self._here(view)
        self._above = above
        room = max(cells.height - above, 1)
        self._top = max(min(self._top, self.cursor, len(rows) - room), self.cursor - room + 1, 0)
        width = min(max(cells.width - DETAIL, cells.width * 3 // 5, 12), max(cell_len(row.name) for row in rows))
        shown = rows[self._top : self._top + room]
        details = max(cell_len(HEADINGS[1]), *(cell_len(row.detail) for row in shown))
        aside = 4 + width + details + 3
        passes = next_passes(view, {row.text for row in shown}) if aside + PASS <= cells.width else {}
        cells.put(3, above - 1, HEADINGS[0], "dim")
        least = cells.width - 5 - width
        narrow = any(cell_len(row.detail) > least for row in shown)
        brief = next_passes(view, {row.text for row in shown}, brief=True) if narrow and least >= BRIEF else {}
        if brief:
            cells.put(4 + width, above - 1, f"{HEADINGS[2]:<11}{'max':>5}", "dim")
        elif not any(row.up for row in shown):
            cells.put(4 + width, above - 1, cut(HEADINGS[1], max(cells.width - 5 - width, 0)), "dim")
        if passes:
            cells.put(aside, above - 1, f"{HEADINGS[2]:<14}{'max':>5}{'reach':>8}", "dim")
        for y, row in enumerate(shown, above):
            here = self._top + y - above == chosen
            ink = "accent-row" if here else "text"
            if here:
                cells.put(0, y, " " * cells.width, ink)
            cells.put(0, y, f"{'▶' if here else ' '}{'★' if row.favourite else ' '} ", ink if here else "target")
            cells.put(3, y, fit(row.name, width), ink)
            parts = row.detail.split(" · ")
            detail = parts[0 if row.silent else -1] if cell_len(row.detail) > least else row.detail
            cells.put(
                4 + width,
                y,
                cut(detail if row.silent else brief.get(row.text, detail), max(least, 0)),
                ink if here else "dim",
            )
            if row.text in passes:
                cells.put(aside, y, passes[row.text], ink if here else "dim")

    def _note(self, cells: Cells, view: View) -> int:
        """Say above the rows why none of them is what was typed; return how many rows that takes."""
        note = "" if view.track is None else view.track.found_note
        lines = wrap(note, max(cells.width - 2, 10))[: max(cells.height - 1, 0)]
        for y, line in enumerate(lines):
            cells.put(1, y, line, "warn")
        self._above = len(lines)
        return self._above

    def on_click(self, event: events.Click) -> None:
        """Choose a row: the first press moves the cursor there, one on the cursor takes it."""
        offset = event.get_content_offset(self)
        if (
            offset is None
            or self.view is None
            or not 0 <= offset.y - self._above < len(candidates(self.view)) - self._top
        ):
            return
        event.stop()
        index = self._top + offset.y - self._above
        if index == self._here(self.view):
            cast(AppHost, self.app).action_command("track-take")
        else:
            self.cursor, self._moved = index, True
            self.show(self.view)

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Go down."""
        event.stop()
        self.move(1)

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Go up."""
        event.stop()
        self.move(-1)
