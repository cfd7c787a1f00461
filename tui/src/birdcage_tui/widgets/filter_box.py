"""A list under the line to filter it with, which is not seen before it is asked for."""

from __future__ import annotations

from textual import events, on
from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widgets import Input

from birdcage_tui.widgets.esc_field import EscField
from birdcage_tui.widgets.pane import Pane


class FilteredPane(Pane, can_focus=True):
    """A list that shows what its filter lets through."""

    filter = ""
    """Part of what is looked for; empty shows all."""

    def filter_by(self, words: str) -> None:
        """Show what these words let through, from the top."""
        raise NotImplementedError


class FilterBox(Vertical):
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

    def _close_filter(self, words: str) -> None:
        field = self.query_one(Input)
        field.value = words
        self._pane.focus()
        field.disabled, field.display = True, bool(words)

    def on_input_changed(self, event: Input.Changed) -> None:
        """Show what is left."""
        event.stop()
        self._pane.filter_by(event.value.strip())

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Go back to the list, with the filter in force."""
        event.stop()
        self._close_filter(event.value.strip())

    @on(EscField.Left)
    def _left_filter(self, event: EscField.Left) -> None:
        event.stop()
        self._close_filter("")

    def on_key(self, event: events.Key) -> None:
        """Esc in the filter clears it; what it does in the list is the list's."""
        if event.key == "escape":
            event.stop()
            if self.query_one(Input).has_focus:
                self._close_filter("")
            else:
                self.leave()

    def leave(self) -> None:
        """Esc in the list: where it leads from there."""
