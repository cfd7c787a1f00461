"""The question which moment the page of passes shall show."""

from __future__ import annotations

from datetime import datetime

from birdcage_tui.passes.time_text import EXAMPLES, moment_of
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values


def time_screen(shown: datetime) -> FieldsScreen:
    """Return the form; `shown` is the moment that is shown now."""

    def check(values: Values) -> str:
        try:
            moment_of(values[0], shown)
        except ValueError as wrong:
            return str(wrong)
        return ""

    words = (
        f"Shown now is {shown:%Y-%m-%d %H:%M}Z. A time of day is the next one; a sign counts from what is shown. "
        "This changes only the view. Nothing moves, and the clock stays."
    )
    return FieldsScreen("Jump to a time", words, (FieldRow("UTC", "", EXAMPLES),), check)
