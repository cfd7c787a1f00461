"""Leaves a layer that is typed into and keeps nothing: for Tab and Enter, and for the mouse, whatever moves."""

from __future__ import annotations

from textual.message import Message
from textual.widgets import Static


class CancelButton(Static, can_focus=True):
    """A word that Enter or a click takes. Space stops the dish here as everywhere."""

    BINDINGS = [("enter", "press", "cancel")]  # noqa: RUF012

    class Pressed(Message):
        """A person cancels."""

    def __init__(self) -> None:
        super().__init__(" Cancel ", markup=False)

    def action_press(self) -> None:
        """Tell the layer."""
        self.post_message(self.Pressed())

    def on_click(self) -> None:
        """Tell the layer."""
        self.action_press()
