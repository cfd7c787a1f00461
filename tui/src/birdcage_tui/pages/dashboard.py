"""F1: what the dish does, what stops it, what comes next; then pictures."""

from __future__ import annotations

from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from birdcage_tui.drawing.screen_size import size_classes
from birdcage_tui.drawing.terminal_cells import ASPECT
from birdcage_tui.panes.cards import CardsPane
from birdcage_tui.panes.health import HealthPane
from birdcage_tui.panes.next import NextPane
from birdcage_tui.panes.pointing import PointingPane
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.shown.next_passes import next_pass
from birdcage_tui.shown.offer import Offer
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.skew import SkewPane, has_skew

CARD_ROWS = 2
"""Rows of the cards, where there is room for them."""
LEAST_FOR_HEALTH = 31
"""Rows from which there is one for everything."""
ROOMY, VAST = 54, 62
"""Rows from which more passes are worth more than a taller chart; from which the link has its last minutes, too."""


class DashboardPage(Page):
    """The sky at the left, as large as it can be round; readings and words at the right."""

    WATCHES = frozenset({"position", "signal", "health"})
    RATE_HZ = 2.0
    _aspect = ASPECT

    def compose(self) -> ComposeResult:
        """Sky, then the right-hand column; below them the row of cards."""
        with Horizontal(id="panes"):
            yield SkyPane(id="sky")
            with Vertical(id="readings") as column:
                column.border_title = "Pointing"
                yield PointingPane(id="pointing")
                yield SignalPane(id="signal")
                yield SkewPane(id="skew")
                yield HealthPane(id="health")
                yield NextPane(id="next")
        yield CardsPane(id="cards")

    def show(self, view: View) -> None:
        """Give the place of the signal to the skew where neither a tuner nor a receiver is heard, then draw."""
        dish = view.state.dish
        instead = dish is not None and not dish.has_rssi and view.heard.of_dish and has_skew(view)
        signal, skew = self.query_one(SignalPane), self.query_one(SkewPane)
        if skew.display != instead or signal.display == instead:
            signal.display, skew.display = not instead, instead
        self.query_one(PointingPane).with_skew = not instead
        if view.settings.cell_aspect != self._aspect:
            self._aspect = view.settings.cell_aspect
            self.on_resize()
        super().show(view)

    def on_resize(self) -> None:
        """Give the sky the width that makes its disc fill the height, and leave the readings theirs."""
        width, height = self.size
        below = CARD_ROWS if size_classes(*self.screen.size)["-wide"] else 0
        round_width = round((height - below - 2) * self._aspect) + 6
        sky = 40 if width < 100 or height < 27 else max(min(round_width, width - 50), 40)
        self.query_one(SkyPane).styles.width = sky
        self.set_class(height < LEAST_FOR_HEALTH, "-short")
        self.set_class(width >= 150 and height >= ROOMY, "-roomy")
        self.set_class(width >= 150 and height >= VAST, "-vast")

    def do(self, command: str) -> bool:
        """Plan the next pass, or sweep."""
        match command:
            case "next-pass":
                view = self.host.view()
                row = next_pass(view.sky, view.utc.timestamp(), view.state)
                if row is None:
                    return False
                self.host.track.offer = Offer(row.name, row.norad_id, row.tca_s)
                self.host.show_page("control", "open-offer")
            case "scan-sky":
                self.host.show_page("signal", "map-begin")
            case _:
                return False
        return True
