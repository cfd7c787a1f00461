"""What the receiver behind the dish says of itself: lock, SNR, network, channel, the supply of its LNB."""

from __future__ import annotations

from birdcage.rotator.feature import Reading

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.shown.state_words import age_text
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.pane import Pane

FEATURES = ("lock", "snr", "network", "lnb_supply", "frequency", "symbol_rate", "polarisation", "raw_rssi")
"""In the order of what counts; what a machine lacks is left out."""
NAMES = {
    "lock": "lock", "snr": "SNR", "network": "network", "lnb_supply": "LNB", "frequency": "IF",
    "symbol_rate": "symbol rate", "polarisation": "pol", "raw_rssi": "ADC",
}  # fmt: skip
OLD_S = 60.0
"""A reading that is older shows its age: they are asked for in turn, one every few seconds."""


class ReceiverPane(Pane):
    """Names and values side by side, as many as there is room for."""

    HELP = "What the dish's own receiver tells. - is what it has not told."

    def __init__(self, *, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self.border_title = "Receiver"

    def draw(self, cells: Cells, view: View) -> None:
        """Write what the machine has, a dash for what it has not told."""
        dish = view.state.dish
        has = [name for name in FEATURES if dish is not None and name in dish.features]
        if not has:
            words = "This dish has no receiver of its own." if dish is not None else "Known once the dish answers."
            cells.put(1, 0, words, "dim")
            return
        x = y = 0
        for name in has:
            reading = view.state.readings.get(name)
            value, ink = "-", "dim"
            if reading is not None:
                old = view.now - reading.at > OLD_S
                value = _value_text(name, reading) + (f" ({age_text(view.now - reading.at)} old)" if old else "")
                ink = "dim" if old else "text"
            width = len(NAMES[name]) + len(value) + 1
            if x and x + width + 4 > cells.width:
                x, y = 0, y + 1
            if y >= cells.height:
                return
            x = cells.put(x + 1, y, f"{NAMES[name]} ", "dim")
            x = cells.put(x, y, value, ink) + 2


def _value_text(name: str, reading: Reading) -> str:
    """Return a value with its unit."""
    value = reading.value
    if name == "lock":
        return "yes" if value else "no"
    shown = f"{value:.5g}" if isinstance(value, float) else str(value)
    return f"{shown} {reading.unit}".rstrip()
