"""Two known levels: the dialog that makes decibels of counts, or takes that back."""

from __future__ import annotations

from birdcage.signal.level_scale import KnownLevel, LevelScale, checked_scale

from birdcage_tui.shown.view import View
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

WORDS = (
    "Two levels of this tuner that you know in dB: cold sky 0, an attenuator or another source the other. "
    "A straight line joins them, which is assumed: the scale was never measured. Empty all lines to remove it."
)


def levels_question(view: View) -> FieldsScreen:
    """Return what is asked: what is kept now, else the levels of the last two markers."""
    unit = view.heard.unit
    scale = view.scale
    if scale is not None:
        told = [f"{scale.low.value:g}", f"{scale.low.db:g}", f"{scale.high.value:g}", f"{scale.high.db:g}"]
    else:
        levels = [f"{marker.level:.{view.heard.decimals + 1}f}" for marker in view.markers[-2:]]
        told = [*(part for level in levels for part in (level, "")), *[""] * 4][:4]
    hints = ("as F3 shows it, or a marker's", "decibels")
    rows = [
        FieldRow(f"level {number}, {what}", told[2 * number - 2 + place], hints[place])
        for number in (1, 2)
        for place, what in enumerate((unit, "dB"))
    ]

    def wrong(values: Values) -> str:
        try:
            read_levels(values, view)
        except ValueError as error:
            return f"{error}."
        return ""

    return FieldsScreen("Two known levels", WORDS, rows, wrong)


def read_levels(values: Values, view: View) -> LevelScale | None:
    """Return what the lines say; None where all are empty. ValueError says what is wrong, in a sentence."""
    lines = [value.strip() for value in values]
    if not any(lines):
        return None
    try:
        one, one_db, other, other_db = (float(line.lower().removesuffix("db")) for line in lines)
    except ValueError:
        raise ValueError(f"Each line is a number: 401 {view.heard.unit}, 0 dB. Or empty all four") from None
    feed = view.state.feed_name
    return checked_scale(view.heard.id, feed, KnownLevel(one, one_db), KnownLevel(other, other_db))
