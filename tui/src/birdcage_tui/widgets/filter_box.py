"""A list under the line to filter it with, which is not seen before it is asked for."""

from __future__ import annotations

from textual import events
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widget import Widget
from textual.widgets import Input

from birdcage_tui.widgets.esc_field import EscField, LeaveField
from birdcage_tui.widgets.pane import Pane


class FilteredPane(Pane, can_focus=True):
    """A list that shows what its filter lets through."""

    filter = ""
    """Part of what is looked for; empty shows all."""

    def filter_by(self, words: str) -> None:
        """Show what these words let through, from the top."""
        raise NotImplementedError


class FilterHands(Widget):
    """What keys do in the filter of a list below: Enter goes back there, Esc and Backspace clear the filter."""

    def close_filter(self, words: str) -> None:
        """Go back to the list, with these words in force."""
        raise NotImplementedError

    def leave_list(self) -> bool:
        """Do what Esc does in the list, and return whether that is anything."""
        return False

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Go back to the list, with the filter in force."""
        event.stop()
        self.close_filter(event.value.strip())

    def on_leave_field_left(self, event: LeaveField.Left) -> None:
        """Clear the filter."""
        event.stop()
        self.close_filter("")

    def on_key(self, event: events.Key) -> None:
        """Esc in the filter clears it; what it does in the list is the list's."""
        if event.key != "escape":
            return
        if self.query_one(Input).has_focus:
            event.stop()
            self.close_filter("")
        elif self.leave_list():
            event.stop()


class FilterBox(FilterHands, Vertical):
    """Typing filters at once, Enter goes back to the list, Esc clears the filter."""

    def __init__(self, pane: FilteredPane, *hints: str, field_id: str, id: str | None = None) -> None:  # noqa: A002
        super().__init__(id=id)
        self._pane, self._hints, self._field_id = pane, hints, field_id

    def compose(self) -> ComposeResult:
        """The filter, and the list."""
        field = EscField(*self._hints, closes="clears it", id=self._field_id)
        field.display = False
        yield field
        yield self._pane

    def open_filter(self) -> None:
        """Take the focus into the filter."""
        field = self.query_one(Input)
        field.disabled, field.display = False, True
        field.focus()

    def close_filter(self, words: str) -> None:
        """Go back to the list, with these words in force."""
        field = self.query_one(Input)
        field.value = words
        self._pane.focus()
        field.disabled, field.display = True, bool(words)

    def on_input_changed(self, event: Input.Changed) -> None:
        """Show what is left."""
        event.stop()
        self._pane.filter_by(event.value.strip())
