"""Text fields that can be left while the dish moves: Esc stops it then, and Backspace leaves a field that is empty."""

from __future__ import annotations

from textual import events
from textual.app import ComposeResult
from textual.containers import Horizontal
from textual.message import Message
from textual.widgets import Input, Static

from birdcage_tui.shown.stop_words import esc_text, stop_keys
from birdcage_tui.shown.view import View


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

    `closes` is what Esc does while nothing moves, and Backspace in the empty field at any time. `typed`: what Enter
    does, and where that and Esc are told while something is typed.
    """

    def __init__(
        self,
        *hints: str,
        closes: str,
        id: str | None = None,  # noqa: A002
        typed: tuple[str, Static] | None = None,
    ) -> None:
        super().__init__(placeholder=hints[0], id=id, disabled=True)
        self._hints, self._closes = hints, closes
        self._typed, self._told = typed, ""

    def show(self, view: View) -> None:
        """Renew what is said of Enter and Esc."""
        if self._typed is not None:
            enter, place = self._typed
            told = f"{enter}, {esc_text(view, closes=self._closes, other=stop_keys(view))}" if self.value else ""
            if told != self._told:
                self._told = told
                place.update(told)
        leaves = esc_text(view, closes=self._closes, other=f"Backspace {self._closes}")
        said = [f"{hint}, {leaves}, {stop_keys(view)}" for hint in self._hints]
        said += [*(f"{hint}, {leaves}" for hint in self._hints), leaves]
        width = self.content_size.width
        words = next((each for each in said if not width or len(each) <= width), said[-1])
        if self.placeholder != words:
            self.placeholder = words


class NamedField(Horizontal):
    """An `EscField` behind its name; once something is typed, what Enter and Esc do stands at its end."""

    DEFAULT_CSS = """
    NamedField { height: 1; background: $panel; }
    NamedField Static { width: auto; padding: 0 1; color: $dim; }
    NamedField EscField { width: 1fr; }
    """

    def __init__(self, name: str, *hints: str, enter: str, closes: str, field_id: str) -> None:
        super().__init__()
        self._named, self._does = name, Static()
        self._field = EscField(*hints, closes=closes, id=field_id, typed=(enter, self._does))

    def compose(self) -> ComposeResult:
        """The parts from the left."""
        yield Static(self._named)
        yield self._field
        yield self._does
