"""The words of the page's questions, and the forms that it has filled in."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import NamedTuple

from birdcage.base.presets import Preset, checked
from birdcage.station.known import speed_of

from birdcage_tui.feeds.preset_book import PresetBook
from birdcage_tui.goto.goto_text import is_direction
from birdcage_tui.shown.stop_words import power_switch
from birdcage_tui.shown.view import View
from birdcage_tui.widgets.fields_screen import FieldRow, FieldsScreen, Values

Change = Callable[[], str]
"""Changes the presets; returns what was done. ConfigError says why not."""
LEAST_DEG_S = 0.1


def engage() -> tuple[str, str, str]:
    """Return title, words and consent of engaging the motors."""
    words = (
        "This switches the motor current on, and the motors hold the dish in place. The dish may jerk. "
        "If the motors were released, its position stays unknown until you home it."
    )
    return "Engage the motors", words, "engage"


def release() -> tuple[str, str, str]:
    """Return title, words and consent of releasing the motors."""
    words = (
        "This switches the current of both motors off. The dish may fall under its own weight. Keep clear, or hold it. "
        "Its position is unknown afterwards. birdcage moves it again only after homing."
    )
    return "Release the motors", words, "release the motors"


def stow(view: View) -> tuple[str, str, str]:
    """Return title, words and consent of stowing."""
    words = (
        "The firmware folds the dish flat by its own path, beyond your limits. This crushes whatever is mounted in "
        "place of the stock feed. No STOP is documented for it. Keep a hand on the "
        f"{power_switch(view)}."
    )
    return "Stow the dish", words, "area is clear: fold it flat"


def _number(text: str) -> float | None:
    try:
        value = float(text.strip().replace(",", ".").rstrip("°").strip())
    except ValueError:
        return None
    return value if math.isfinite(value) else None


# Speeds.


class AxisRange(NamedTuple):
    """An axis: its motor's number, what to call it, the most it does."""

    motor: int
    name: str
    most_deg_s: float


def _limits(view: View) -> tuple[AxisRange, ...]:
    dish = view.state.dish
    axes = () if dish is None else (dish.azimuth, dish.elevation)
    return tuple(AxisRange(axis.index, axis.name, axis.speed_deg_s) for axis in axes)


def speeds(view: View) -> FieldsScreen:
    """Return the form for both speeds, filled with those in force."""
    fields = []
    for axis in _limits(view):
        reading = view.state.readings.get(speed_of(axis.name))
        known = reading is not None and isinstance(reading.value, int | float)
        fields.append(
            FieldRow(axis.name, f"{reading.value:g}" if reading is not None and known else "",
                  f"{LEAST_DEG_S:g} to {axis.most_deg_s:g} °/s; empty: unchanged")
        )  # fmt: skip

    def check(values: Values) -> str:
        for axis, text in zip(_limits(view), values, strict=True):
            value = _number(text)
            if text.strip() and (value is None or not LEAST_DEG_S <= value <= axis.most_deg_s):
                return f"{axis.name}: type {LEAST_DEG_S:g} to {axis.most_deg_s:g} degrees a second, or leave it empty."
        return ""

    words = "Maximum speed of each axis in degrees a second, until the dish restarts. Saving does not move the dish."
    return FieldsScreen("Maximum speeds", words, fields, check)


def speeds_of(values: Values | None, view: View) -> Iterator[tuple[int, float]]:
    """Yield motor and speed of those that were typed and differ from what is in force."""
    for axis, text in zip(_limits(view), values or (), strict=False):
        value, reading = _number(text), view.state.readings.get(speed_of(axis.name))
        if value is not None and (reading is None or reading.value != value):
            yield axis.motor, value


# Presets.


def preset_fields(preset: Preset | None) -> tuple[FieldRow, ...]:
    """Return the four lines of a preset, filled with what is known of it."""
    az, el = ("", "") if preset is None else (f"{preset.az_deg:.2f}", f"{preset.el_deg:.2f}")
    name, note = ("", "") if preset is None else (preset.name, preset.note)
    return (
        FieldRow("name", name, "name of the direction"),
        FieldRow("azimuth °", az, "clockwise from true north"),
        FieldRow("elevation °", el, "above the horizon"),
        FieldRow("note", note, "optional"),
    )


def preset_of(values: Values) -> Preset:
    """Return the preset that was typed. ValueError says what is wrong with it."""
    name, az, el, note = values
    az_deg, el_deg = _number(az), _number(el)
    if az_deg is None or el_deg is None:
        raise ValueError("Type azimuth and elevation in degrees: 180.5 and 45.")
    if is_direction(name):
        raise ValueError(f'"{name.strip()}" reads as a direction. Type another name.')
    return checked(name, az_deg, el_deg, note)


def preset(title: str, fields: tuple[FieldRow, ...], book: PresetBook, old: str | None) -> FieldsScreen:
    """Return the form for a preset; `old` is the name of the one that is edited."""

    def check(values: Values) -> str:
        try:
            typed = preset_of(values)
        except ValueError as wrong:
            return f"{str(wrong)[:1].upper()}{str(wrong)[1:]}."
        names = {entry.name.casefold() for entry in book.entries} - {(old or "").casefold()}
        return f'A preset "{typed.name}" exists.' if typed.name.casefold() in names else ""

    words = "Save a direction, in true degrees, under a name. Saving does not move the dish."
    return FieldsScreen(title, words, fields, check)
