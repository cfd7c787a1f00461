"""The dialogs of a value: a field for the new one, then the question that names old, new and hazard."""

from __future__ import annotations

from birdcage.base.errors import OutOfRange
from birdcage.rotator.feature import DISEQC, Feature, FeatureKind, Value, Writer
from textual.app import ComposeResult
from textual.containers import Vertical, VerticalScroll
from textual.markup import escape
from textual.widgets import Static

from birdcage_tui.shown.system_sheet import cell_text, may_be_set_words, words_of_value
from birdcage_tui.shown.view import View
from birdcage_tui.system.cursor_pane import Detail
from birdcage_tui.widgets.dialogs import Dialog, QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values
from birdcage_tui.widgets.status import TopRow

DETAIL_WIDTH = 70
HOLDS = {
    Writer.NONE: "",
    Writer.UNTIL_RESTART: "Takes effect at once, until the dish restarts.",
    Writer.FROM_POWER_UP: "It is saved, and takes effect at the next power-up.",
    Writer.AT_ONCE: "Done at once.",
    Writer.WHILE_HELD: "It runs while its key is held.",
}
"""How long a new value holds."""


def read_value(feature: Feature, text: str) -> Value:
    """Return what was typed as a value of the feature. OutOfRange, a sentence, for what is none."""
    text = text.strip()
    value: Value = text
    if feature.kind is FeatureKind.NUMBER:
        try:
            value = float(text)
        except ValueError:
            limits = "" if feature.range is None else f" Type {feature.range} {feature.unit}".rstrip() + "."
            raise OutOfRange(f"{text!r} is no number.{limits}") from None
    feature.check(value)
    if feature.id == DISEQC:
        from birdcage.coax.messages import typed_message

        try:
            typed_message(text)
        except ValueError as wrong:
            raise OutOfRange(str(wrong)) from None
    return value


def value_field(feature: Feature, view: View) -> FieldsScreen:
    """Return the line for a new value: what it is now, its limits, and how long it holds."""
    now = cell_text(feature, view.state.readings, view.now).value
    told = f"Now {now}. " if feature.is_readable else ""
    words = f"{told}{may_be_set_words(feature)}. {feature.note}".strip()
    limits = "" if feature.range is None else f"{feature.range} {feature.unit}".strip()

    def wrong(values: Values) -> str:
        try:
            read_value(feature, values[0])
        except OutOfRange as error:
            return str(error)
        return ""

    return FieldsScreen(feature.label, words, (FieldRow(feature.unit or "value", "", limits),), wrong,
                        enter="Enter goes on")  # fmt: skip


def new_value(feature: Feature, view: View) -> bool:
    """Return the other value of a switch: on where it is not known."""
    last = view.state.readings.get(feature.id)
    return not (last is not None and last.value is True)


def set_question(feature: Feature, value: Value, view: View, said: str = "") -> QuestionScreen:
    """Return the question before anything is sent: old and new value, how long it holds, hazard."""
    shown = words_of_value(feature, value)
    if feature.kind is FeatureKind.MOMENTARY:
        return QuestionScreen(feature.label, f"{feature.hazard}\n\n{feature.note}".strip(), "do it")
    old = cell_text(feature, view.state.readings, view.now).value
    change = f"{old}  →  {shown}" if feature.is_readable else shown
    holds = HOLDS[feature.writer]
    words = "\n\n".join(each for each in (change, said, holds, feature.hazard) if each)
    return QuestionScreen(feature.label, words, f"set {shown}")


class LinesScreen(Dialog[None]):
    """All that there is to say of a value; the arrows scroll."""

    KEYS, OTHER = "↑ ↓ scroll", "q closes"
    BINDINGS = [("escape,q,enter", "leave", "close")]  # noqa: RUF012

    def __init__(self, title: str, lines: str) -> None:
        super().__init__()
        self._title, self._lines = title, lines

    def compose(self) -> ComposeResult:
        """The lines, as printed."""
        yield TopRow()
        with Vertical() as frame:
            frame.border_title = escape(self._title)
            with VerticalScroll():
                yield Static(self._lines, markup=False)

    def on_mount(self) -> None:
        """Let the arrows scroll."""
        super().on_mount()
        self.query_one(VerticalScroll).focus()


def lines_screen(detail: Detail) -> LinesScreen:
    """Return all that there is to know of a row."""
    return LinesScreen(detail.title, "\n".join(line for _, line in detail.lines))
