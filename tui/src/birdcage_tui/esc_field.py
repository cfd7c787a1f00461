"""Text fields that can be left while the dish moves: Esc stops it then, and Backspace leaves a field that is empty."""

from __future__ import annotations

from textual import events
from textual.message import Message
from textual.widgets import Input

from birdcage_tui.stop_words import esc_text, stop_keys
from birdcage_tui.view import View


class LeaveField(Input):
    """A field that is left by Backspace where nothing is typed, whatever moves."""

    class Left(Message):
        """A person leaves the field."""

    def on_key(self, event: events.Key) -> None:
        """Leave it, if there is nothing to delete."""
        if event.key == "backspace" and not self.value:
            event.stop()
            event.prevent_default()
            self.post_message(self.Left())


class EscField(LeaveField):
    """`hints` tell what to type and what Enter does, the longest first: the first that fits is shown.

    `closes` is what Esc does while nothing moves, and Backspace in the empty field at any time.
    """

    def __init__(self, *hints: str, closes: str, id: str | None = None) -> None:  # noqa: A002
        super().__init__(placeholder=hints[0], id=id, disabled=True)
        self._hints, self._closes = hints, closes

    def show(self, view: View) -> None:
        """Renew the placeholder."""
        leaves = esc_text(view, closes=self._closes, other=f"Backspace {self._closes}")
        said = [f"{hint}, {leaves}, {stop_keys(view)}" for hint in self._hints]
        said += [*(f"{hint}, {leaves}" for hint in self._hints), leaves]
        width = self.content_size.width
        words = next((each for each in said if not width or len(each) <= width), said[-1])
        if self.placeholder != words:
            self.placeholder = words
