"""What the lists of the System page share: a cursor for keys and mouse, and what there is to say of its row."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from textual import events
from textual.geometry import Region

from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.filter_box import FilteredPane
from birdcage_tui.widgets.page import Page

Line = tuple[str, str]
"""Ink and words."""


@dataclass(frozen=True, slots=True)
class Detail:
    """What there is to know of a row, what counts most first."""

    title: str
    lines: list[Line]


class CursorPane(FilteredPane):
    """Rows to choose from; `at` is the one under the cursor."""

    def __init__(self, scope: str, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._scope = scope
        self.at = 0
        self.top = 0
        """The first line that is seen."""
        self.hits: list[tuple[Region, int, int]] = []
        """Where a click chooses which row, and which of its values; filled by `draw`."""

    @property
    def scope(self) -> str:
        """What its commands have in `where`."""
        return self._scope

    def do(self, command: str) -> bool:
        """Have the page do it: it asks."""
        return self.query_ancestor(Page).do(command)

    def filter_by(self, words: str) -> None:
        """Show what these words let through, from the top."""
        self.filter, self.at = words, 0
        cast(AppHost, self.app).paint()

    def count(self, view: View) -> int:
        """Return how many rows there are."""
        raise NotImplementedError

    def detail(self, view: View, width: int) -> Detail | None:
        """Return what there is to say of the row under the cursor, wrapped to a width; None where there is none."""
        raise NotImplementedError

    @property
    def page_rows(self) -> int:
        """How many rows are seen at once, about."""
        return max(self.size.height - 2, 1)

    def move(self, by: int) -> None:
        """Move the cursor by rows."""
        if self.view is not None:
            self.at = min(max(self.at + by, 0), max(self.count(self.view) - 1, 0))
            cast(AppHost, self.app).paint()

    def choose(self, row: int, value: int) -> None:  # noqa: ARG002 - most rows have one value
        """Put the cursor on a row."""
        self.at = row

    def scroll(self, here: int, lines: int, room: int, *, head: int = 0) -> int:
        """Return the first line to be seen, so that line `here` and `head` lines above it are."""
        self.top = max(min(self.top, here - head), here - room + 1, 0)
        self.top = min(self.top, max(lines - room, 0))
        return self.top

    def on_focus(self) -> None:
        """Show the cursor, once Textual has taken the focus in."""
        self.call_later(self.redraw)

    def on_blur(self) -> None:
        """Show that keys go elsewhere."""
        self.call_later(self.redraw)

    def on_click(self, event: events.Click) -> None:
        """Choose a row."""
        offset = event.get_content_offset(self)
        for region, row, value in reversed(self.hits):
            if offset is not None and region.contains_point(offset):
                event.stop()
                self.choose(row, value)
                cast(AppHost, self.app).paint()
                return

    def on_mouse_scroll_down(self, event: events.MouseScrollDown) -> None:
        """Choose the one below."""
        event.stop()
        self.move(1)

    def on_mouse_scroll_up(self, event: events.MouseScrollUp) -> None:
        """Choose the one above."""
        event.stop()
        self.move(-1)
