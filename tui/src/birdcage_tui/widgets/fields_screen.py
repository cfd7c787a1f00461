"""A dialog with a few lines to fill in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from textual import events, on
from textual.app import ComposeResult
from textual.containers import Horizontal, Vertical
from textual.widgets import Input, Label, Static

from birdcage_tui.drawing.cell_text import shorten
from birdcage_tui.widgets.cancel import CancelButton
from birdcage_tui.widgets.dialogs import Dialog
from birdcage_tui.widgets.status import TopRow

Values = tuple[str, ...]
LINE_END = "␤"
"""Stands for the end of a line in a field of one row."""


@dataclass(frozen=True, slots=True)
class FieldRow:
    """One line: its name, what stands in it, and what it is for."""

    label: str
    value: str = ""
    hint: str = ""
    pastes: bool = False
    """Whether a text of several lines may be pasted: their ends are `LINE_END`."""
    is_off: bool = False
    """Whether it can only be looked at: `value` says why."""


class HintedInput(Input):
    """A field that says, while it is empty, as much of what it is for as there is room for in whole words."""

    def __init__(self, field: FieldRow, *, replaces: bool) -> None:
        super().__init__(field.value, placeholder=field.hint, select_on_focus=replaces, disabled=field.is_off)
        self._whole = field.hint

    def on_resize(self) -> None:
        """Cut the hint anew."""
        self.placeholder = shorten(self._whole, self.content_size.width)


class PasteInput(HintedInput):
    """A field that takes a pasted text whole."""

    def _on_paste(self, event: events.Paste) -> None:
        event.prevent_default()
        event.stop()
        start, end = self.selection
        self.replace(LINE_END.join(event.text.splitlines()), start, end)


class FieldsScreen(Dialog[Values | None]):
    """Enter keeps all lines if `check` finds nothing wrong, else its sentence is shown; Cancel keeps nothing.

    `read`: what is understood of the lines, told under them as one types; else what the line with the focus is for.
    """

    DEFAULT_CSS = """
    FieldsScreen Horizontal { height: 1; }
    FieldsScreen Label { color: $dim; }
    FieldsScreen Input, FieldsScreen Input:focus { width: 1fr; height: 1; border: none; padding: 0 1;
        background: $panel; }
    FieldsScreen Input:disabled { color: $dim; }
    FieldsScreen #wrong { color: $warning; margin-top: 1; }
    FieldsScreen #wrong.-read { color: $foreground; }
    FieldsScreen #wrong.-hint { color: $dim; }
    FieldsScreen #words { margin-bottom: 1; }
    """
    KEYS, OTHER = "Enter saves", "Tab to Cancel"
    BINDINGS = [("escape", "leave", "close")]  # noqa: RUF012

    def __init__(
        self, title: str, words: str, fields: Sequence[FieldRow], check: Callable[[Values], str], wrong: str = "",
        read: Callable[[Values], str] | None = None, enter: str = KEYS,
    ) -> None:  # fmt: skip
        super().__init__()
        self.KEYS = enter
        self._read = read
        self._wrong = wrong
        self._title, self._words, self._fields, self._check = title, words, fields, check

    def compose(self) -> ComposeResult:
        """The words, the lines, and room for what is wrong."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = self._title
            yield Static(self._words, id="words", markup=False)
            for field in self._fields:
                with Horizontal():
                    label = Label(field.label)
                    # The sheet of the app gives every text in a dialog the whole width.
                    label.styles.width = max(len(each.label) for each in self._fields) + 2
                    yield label
                    # What stands in a later field is replaced by typing there.
                    replaces = field is not self._fields[0]
                    if field.pastes:
                        yield PasteInput(field, replaces=replaces)
                    else:
                        yield HintedInput(field, replaces=replaces)
            yield Static(f"▲ {self._wrong}" if self._wrong else "", id="wrong", markup=False)
            self.set_class(bool(self._wrong), "-told")
            yield CancelButton()

    def on_mount(self) -> None:
        """Give the focus to the first line: a person has asked for it."""
        self.screen.set_focus(self.query(Input).first())
        super().on_mount()

    @on(CancelButton.Pressed)
    def _cancelled(self) -> None:
        self.action_leave()

    @property
    def _values(self) -> Values:
        return tuple(field.value for field in self.query(Input))

    def on_input_changed(self, event: Input.Changed) -> None:
        """Say what is understood so far."""
        event.stop()
        if self._read is not None:
            self._tell(self._read(self._values), read=True)
        self._hint()

    def on_descendant_focus(self) -> None:
        """Say what the line is for, which its own words hide."""
        self._hint()

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Keep, or say what is wrong."""
        event.stop()
        wrong = self._check(self._values)
        if wrong:
            self._tell(f"▲ {wrong}", read=False)
        else:
            self.dismiss(self._values)

    def _hint(self) -> None:
        """Say what the line with the focus is for, where nothing else is told, and on no small screen."""
        told = self.query_one("#wrong", Static)
        if (told.content and not told.has_class("-hint")) or self.app.has_class("-tiny"):
            return
        lines = zip(self._fields, self.query(Input), strict=True)
        hint = next((field.hint for field, line in lines if line.has_focus and line.value), "")
        told.set_class(bool(hint), "-hint")
        told.update(hint)

    def _tell(self, words: str, *, read: bool) -> None:
        told = self.query_one("#wrong", Static)
        told.remove_class("-hint")
        told.set_class(read, "-read")
        told.update(words)
        self.set_class(bool(words), "-told")
