"""F3: how strong the signal is, and which way it gets stronger."""

from __future__ import annotations

from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical

from birdcage_tui.control.jog import JogPane
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.signal.head import SignalHead
from birdcage_tui.signal.level import LevelPane
from birdcage_tui.signal.receiver import FEATURES, ReceiverPane
from birdcage_tui.signal.to_peak import ToPeakPane
from birdcage_tui.widgets.page import Page

UPPER, UPPER_TALL = 9, 13
"""Rows of level and way to the peak, and where there is room for larger digits."""
TALL = 30


class SignalPage(Page):
    """Level and way to the peak above, the last minute below, the receiver's own words at the bottom."""

    DEFAULT_CSS = """
    SignalPage { layout: vertical; }
    SignalPage SignalHead { height: 1; }
    SignalPage #signal-upper { height: 9; }
    SignalPage LevelPane, SignalPage #signal-peak, SignalPage SignalPane, SignalPage ReceiverPane {
        border: round $line; border-title-color: $dim; border-title-style: none; border-subtitle-color: $dim;
        width: 1fr; }
    SignalPage #signal-peak Pane { width: 1fr; }
    SignalPage ToPeakPane { height: 1fr; }
    SignalPage JogPane { height: 1; }
    SignalPage SignalPane { height: 1fr; }
    SignalPage ReceiverPane { height: 4; }
    """
    WATCHES = frozenset({"position", "signal steadily", *FEATURES})
    RATE_HZ = 1.0
    HELP = "The signal, read as often as the wire allows. Arrows step the dish; p offers the way back to the peak."

    def compose(self) -> ComposeResult:
        """From the top."""
        yield SignalHead()
        with Horizontal(id="signal-upper"):
            yield LevelPane(id="level")
            with Vertical(id="signal-peak") as column:
                column.border_title = "To the peak"
                yield ToPeakPane(id="to-peak")
                yield JogPane(id="signal-jog")
        yield SignalPane(id="signal-strip")
        yield ReceiverPane(id="receiver")

    def on_resize(self) -> None:
        """Give the digits more room where there is some."""
        tall = self.size.height >= TALL
        self.query_one("#signal-upper").styles.height = UPPER_TALL if tall else UPPER
        self.query_one(ReceiverPane).styles.height = 3 if self.size.width >= 110 else 4

    def do(self, command: str) -> bool:
        """Offer the way to the peak, or forget it."""
        level = self.host.view().level
        match command:
            case "signal-peak":
                peak = None if level is None else level.peak
                if peak is None or peak.az_deg is None or peak.el_deg is None:
                    self.host.say("No peak with a direction was heard yet.")
                else:
                    self.host.open_goto(f"{peak.az_deg:.2f} {peak.el_deg:.2f}")
            case "signal-forget":
                self.host.signals.book.forget_peak()
                self.host.say("Peak and floor are forgotten. They are heard anew.")
            case _:
                return False
        return True
