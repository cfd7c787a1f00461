"""The one-line go-to above the footer."""

from __future__ import annotations

import math

from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.message import Message
from textual.widgets import Input, Label


def parse_direction(text: str) -> tuple[float, float]:
    """Return azimuth and elevation from `231.4 44`, space, comma or slash between.

    ValueError says what is wrong.
    """
    words = text.replace(",", " ").replace("/", " ").replace("°", " ").split()
    try:
        az_deg, el_deg = map(float, words)
    except ValueError:
        raise ValueError("Type two numbers, azimuth and elevation: 231.4 44") from None
    if not (math.isfinite(az_deg) and math.isfinite(el_deg)):
        raise ValueError("Both must be finite numbers.")
    return az_deg, el_deg


class GotoLine(Horizontal):
    """One line above the footer: azimuth and elevation; Enter sends it and gives the focus back."""

    class Sent(Message):
        """A direction to go to."""

        def __init__(self, az_deg: float, el_deg: float) -> None:
            super().__init__()
            self.az_deg, self.el_deg = az_deg, el_deg

    def compose(self) -> ComposeResult:
        """A label and a field, which has no focus before `open`."""
        yield Label("go to  az el:")
        yield Input(placeholder="231.4 44      Enter goes there, Esc closes, Ctrl+C stops", disabled=True)

    def open(self) -> None:
        """Show the line and take the focus."""
        self.add_class("-open")
        field = self.query_one(Input)
        field.disabled = False
        field.value = ""
        field.focus()

    def close(self) -> None:
        """Hide the line and give the focus back."""
        self.remove_class("-open")
        self.query_one(Input).disabled = True
        self.screen.set_focus(None)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Send what was typed, or say what is wrong with it."""
        event.stop()
        try:
            az_deg, el_deg = parse_direction(event.value)
        except ValueError as wrong:
            self.query_one(Input).value = ""
            self.query_one(Input).placeholder = str(wrong)
            return
        self.close()
        self.post_message(self.Sent(az_deg, el_deg))

    def on_key(self, event: events.Key) -> None:
        """Esc closes the line (the app has stopped the dish first, if it could move)."""
        if event.key == "escape":
            event.stop()
            self.close()
