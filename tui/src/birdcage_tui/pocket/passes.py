"""The next passes on a phone: a list to pick from, and what Enter would do with the pass that was picked."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from textual import events
from textual.app import ComposeResult
from textual.containers import Vertical

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.drawing.cell_text import pad, wrap
from birdcage_tui.feeds.app_host import AppHost
from birdcage_tui.panes.sky_next import WITH_WORDS, draw_next
from birdcage_tui.passes.empty import empty_words
from birdcage_tui.passes.selection import PassSelection
from birdcage_tui.pocket.reading import wrong_rows
from birdcage_tui.shown.allowed import can_release
from birdcage_tui.shown.next_passes import next_rows
from birdcage_tui.shown.offer import Offer
from birdcage_tui.shown.view import View
from birdcage_tui.track.offer import OfferLine
from birdcage_tui.widgets.pane import Pane

if TYPE_CHECKING:
    from birdcage_tui.shown.sky_picture import ShownPass

OFFER_ROWS = 3
LEAST_ROWS = 3
"""Rows that passes have whatever is wrong."""
HEAD_FROM = 5
"""Rows of the list from which one tells what its columns are."""


class NextList(Pane, can_focus=True):
    """A row a pass: what comes next and when, its name, its highest elevation, and for how long it is in reach."""

    HELP = "The next passes that this dish can follow. Up and down select one, Enter shows its plan."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._rows: list[ShownPass] = []
        self._key: tuple[int, str, int] | None = None
        """The selected pass, wherever it stands in the list; None: the first."""
        self._top = self._head = 0
        """The first row that is seen, and how many rows stand above it."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write what is wrong, then the rows around the selected one."""
        self._rows = next_rows(view)
        wrong_ink, wrong = wrong_rows(view, cells.width)
        wrong = wrong[: max(cells.height - LEAST_ROWS, 1)]
        for y, line in enumerate(wrong):
            cells.put(0, y, pad(f" {line}", cells.width), wrong_ink)
        if not self._rows:
            words = empty_words(view, PassSelection())
            if view.sky is not None and (view.sky.note or view.sky.rows):
                words = [("text", view.sky.note or "No passes in reach of this dish soon.")]
            lines = [(ink, line) for ink, sentence in words for line in wrap(sentence, max(cells.width - 2, 10))]
            for y, (ink, line) in enumerate(lines, len(wrong)):
                cells.put(1, y, line, ink)
            return
        at = self.at
        self._head = len(wrong)
        if cells.height - len(wrong) >= HEAD_FROM:
            cells.put(1, self._head, "next         in name", "dim")
            cells.right(
                cells.width - 1, self._head, "max reach" if cells.width < WITH_WORDS else f"max   for{'':9}", "dim"
            )
            self._head += 1
        room = max(cells.height - self._head, 1)
        self._top = max(min(self._top, at, len(self._rows) - room), at - room + 1, 0)
        for y, row in enumerate(self._rows[self._top : self._top + room], self._head):
            here = y - self._head + self._top == at
            if here:
                cells.put(0, y, pad("▶", cells.width), "key")
            draw_next(cells, y, row, view.utc.timestamp(), "key" if here else "", headed=True)

    @property
    def at(self) -> int:
        """Which row is selected; the first where that pass is over."""
        return next((index for index, row in enumerate(self._rows) if row.key == self._key), 0)

    @property
    def chosen(self) -> ShownPass | None:
        """The selected pass; None in an empty list."""
        return self._rows[self.at] if self._rows else None

    def move(self, by: int) -> None:
        """Select another row."""
        if self._rows:
            self._key = self._rows[min(max(self.at + by, 0), len(self._rows) - 1)].key

    def on_click(self, event: events.Click) -> None:
        """Select the row under the finger; pick it where it is selected already."""
        offset = event.get_content_offset(self)
        index = -1 if offset is None else self._top + offset.y - self._head
        if not 0 <= index < len(self._rows):
            return
        event.stop()
        host = cast(AppHost, self.app)
        if self._key is not None and index == self.at:
            host.action_command("pocket-pick")
            return
        self._key = self._rows[index].key
        host.paint()


class PocketOffer(OfferLine):
    """The offer in as many rows as it needs."""

    def draw(self, cells: Cells, view: View) -> None:
        """Write what Enter would do."""
        ink, words = self.words(view)
        rows = wrap(f"▶ {words}", max(cells.width - 2, 10), most=cells.height)
        for y in range(cells.height):
            cells.put(0, y, pad(f" {rows[y]}" if y < len(rows) else "", cells.width), ink)
            self.heat(0, y, cells.width, self.scope)

    def closed(self) -> None:
        """Go back to the list."""
        self.screen.set_focus(self.screen.query_one(NextList))


class PocketPasses(Vertical):
    """The list, and below it what was picked. It is open as long as one of them has the focus."""

    scope = "pocket-passes"
    DEFAULT_CSS = """
    PocketPasses { height: 1fr; display: none; }
    PocketPasses NextList { height: 1fr; }
    PocketPasses PocketOffer { display: none; }
    """

    def compose(self) -> ComposeResult:
        """Both."""
        yield NextList()
        offer = PocketOffer(self.close)
        offer.styles.height = OFFER_ROWS
        yield offer

    @property
    def host(self) -> AppHost:
        """The app."""
        return cast(AppHost, self.app)

    def open(self) -> None:
        """Show the list, and give it the focus."""
        self.display = True
        self.screen.set_focus(self.query_one(NextList))
        self.host.paint()

    def close(self) -> None:
        """Go back to the readings."""
        self.screen.set_focus(None)
        self.host.paint()

    def keep(self) -> bool:
        """Return whether it is open still: keys that step the dish never hold behind a list that is seen."""
        focused = self.screen.focused
        inside = focused is not None and self in focused.ancestors
        self.display = inside
        self.query_one(PocketOffer).display = inside and isinstance(focused, PocketOffer)
        return inside

    def do(self, command: str) -> bool:
        """Move, pick, or go back."""
        match command:
            case "pocket-pass-up" | "pocket-pass-down":
                rows = self.query_one(NextList)
                rows.move(1 if command == "pocket-pass-down" else -1)
                self.screen.set_focus(rows)
            case "pocket-pick":
                self._pick()
            case "pocket-back":
                self._back()
            case _:
                return False
        self.host.paint()
        return True

    def _pick(self) -> None:
        row, source = self.query_one(NextList).chosen, self.host.track.source
        if can_release(self.host.view()) is None:
            self.host.action_command("release")
            return
        if row is None or source is None:
            self.host.say("No pass selected.")
            return
        line = self.query_one(PocketOffer)
        line.offer = Offer(row.name, row.norad_id, row.tca_s)
        source.choose(line.offer.text)
        source.choose_pass(line.offer.tca)
        line.display = True
        self.screen.set_focus(line)

    def _back(self) -> None:
        if isinstance(self.screen.focused, PocketOffer):
            self.screen.set_focus(self.query_one(NextList))
        else:
            self.close()

    def on_key(self, event: events.Key) -> None:
        """Esc goes back (the app has stopped the dish first, if it could move)."""
        if event.key == "escape":
            event.stop()
            self.close()
            self.host.paint()
