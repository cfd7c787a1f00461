"""Below 80x24: digits, cable, signal, jog and STOP, for a phone over ssh while standing at the dish."""

from __future__ import annotations

from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from birdcage_tui.feeds.signal_feed import STEADY
from birdcage_tui.panes.next import NextPane
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.pocket.keys import PocketKeys, StopBar
from birdcage_tui.pocket.map import PocketMap
from birdcage_tui.pocket.passes import PocketPasses
from birdcage_tui.pocket.pocket_layout import PocketLayout, arrange
from birdcage_tui.pocket.reading import PocketReading, wrong_rows
from birdcage_tui.pocket.signal import PocketSignal
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.page_tone import PageTone
from birdcage_tui.widgets.skew import has_skew


class PocketPage(Page):
    """One column, or readings beside the sky where it is wide; every row is given by `arrange`."""

    WATCHES = frozenset({"position", STEADY})
    RATE_HZ = 2.0
    HELP = "The pocket view. Arrows step the dish, - and + change the step. f lists passes, m shows the map of the sky."

    def __init__(self) -> None:
        super().__init__(id="page-pocket")
        self._layout: PocketLayout | None = None
        self._tone = PageTone(self)

    def compose(self) -> ComposeResult:
        """Readings, signal, words and sky; under them what can be pressed."""
        with Horizontal(id="pocket-body"):
            with Vertical(id="pocket-column"):
                yield PocketReading()
                yield PocketSignal()
                yield NextPane()
            yield SkyPane()
        yield PocketMap()
        yield PocketPasses()
        yield PocketKeys()
        yield StopBar()

    def show(self, view: View) -> None:
        """Give the room to what has something to show, then draw."""
        self._tone.resume()
        listed = self.query_one(PocketPasses).keep()
        mapped = self.query_one(PocketMap).keep(view, listed=listed)
        self.query_one("#pocket-body").display = not (listed or mapped)
        width, height = self.size
        if width and height:
            layout = arrange(
                width, height, heard=bool(view.signal), third_axis=has_skew(view),
                wrong_in=lambda columns: len(wrong_rows(view, columns)[1]),
            )  # fmt: skip
            if layout != self._layout:
                self._layout = layout
                self._apply(layout)
        super().show(view)

    def do(self, command: str) -> bool:
        """Open the list of passes, show or hide the map, turn the tone on or off."""
        if command == "signal-tone":
            self._tone.switch()
            return True
        if command == "pocket-map":
            shown = self.query_one(PocketMap)
            shown.is_wanted = not shown.is_wanted
            self.host.paint()
            return True
        if command == "pocket-passes":
            self.query_one(PocketPasses).open()
            return True
        return False

    def _apply(self, layout: PocketLayout) -> None:
        reading = self.query_one(PocketReading)
        reading.cramped, reading.digits = layout.keys == 0, layout.digits
        body = self.query_one("#pocket-body")
        body.styles.layout = "horizontal" if layout.beside else "vertical"
        column = self.query_one("#pocket-column")
        column.styles.width = layout.column if layout.beside else "1fr"
        column.styles.height = "1fr" if layout.beside else layout.reading + layout.signal + layout.words
        for kind, rows in ((PocketReading, layout.reading), (PocketSignal, layout.signal), (NextPane, layout.words),
                           (PocketKeys, layout.keys), (StopBar, layout.stop)):  # fmt: skip
            pane = self.query_one(kind)
            pane.display = rows > 0
            pane.styles.height = rows
        self.query_one(SkyPane).display = layout.sky
