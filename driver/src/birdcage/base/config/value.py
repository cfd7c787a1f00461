"""Turns what a file, a variable or a flag holds into the value of a setting, or says why not."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable

from birdcage.base.config.schema import KeyRow
from birdcage.base.config.sections import HorizonPoint
from birdcage.base.no_go import NoGoSector


class BadValue(ValueError):
    """The message is the end of a sentence that begins with the key: `is 95, more than 90 deg`."""


def from_toml(row: KeyRow, value: object) -> object:
    """Return `value`, as tomllib gave it, in the type of the setting. BadValue says what was expected."""
    if row.kind == "number" and isinstance(value, int | float) and not isinstance(value, bool):
        return _in_range(row, float(value))
    if row.kind == "whole number" and isinstance(value, int) and not isinstance(value, bool):
        _in_range(row, value)
        return value
    if row.kind == "true or false" and isinstance(value, bool):
        return value
    if row.kind == "text" and isinstance(value, str):
        if not value.strip():
            raise BadValue("is empty; leave the line out to leave it unset")
        return value
    if row.kind == "choice" and isinstance(value, str):
        if value in row.choices:
            return value
        raise BadValue(f"is {value!r}, not one of {', '.join(row.choices)}{did_you_mean(value, row.choices)}")
    if row.kind == "sectors" and isinstance(value, list):
        return tuple(_sector(each) for each in value)
    if row.kind == "points" and isinstance(value, list):
        return tuple(_point(each) for each in value)
    raise BadValue(f"is {_shown(value)}, not {_expected(row)}")


def from_text(row: KeyRow, text: str) -> object:
    """Return the value of a variable. BadValue says what was expected."""
    text = text.strip()
    words = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}
    try:
        if row.kind == "whole number":
            return from_toml(row, int(text))
        if row.kind == "number":
            return from_toml(row, float(text))
    except BadValue:
        raise
    except ValueError:
        raise BadValue(f"is {text!r}, not {_expected(row)}") from None
    if row.kind == "true or false":
        return from_toml(row, words.get(text.lower(), text))
    return from_toml(row, text)


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """Return `; did you mean X?` if something known is near, else nothing."""
    near = nearest(word, known)
    return f"; did you mean {near}?" if near else ""


def nearest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word most like `word`, None if none is."""
    return next(iter(difflib.get_close_matches(word, list(known), n=1, cutoff=0.5)), None)


def _in_range(row: KeyRow, value: float) -> float:
    unit = f" {row.unit}" if row.unit else ""
    if not math.isfinite(value):
        raise BadValue(f"is {value}, not a finite number")
    if row.minimum is not None and value < row.minimum:
        raise BadValue(f"is {value:g}, less than {row.minimum:g}{unit}")
    if row.maximum is not None and value > row.maximum:
        raise BadValue(f"is {value:g}, more than {row.maximum:g}{unit}")
    return value


def _sector(value: object) -> NoGoSector:
    if isinstance(value, list) and (len(value) == 3 or (len(value) == 4 and isinstance(value[3], str))):
        numbers = _numbers(value[:3])
        if len(numbers) == 3:
            return NoGoSector(numbers[0], numbers[1], numbers[2], "".join(value[3:]))
    raise BadValue(f"has {_shown(value)}, where three numbers [az_from, az_to, el_below] belong")


def _point(value: object) -> HorizonPoint:
    if isinstance(value, list) and len(value) == 2:
        numbers = _numbers(value)
        if len(numbers) == 2 and abs(numbers[0]) <= 360.0 and abs(numbers[1]) <= 90.0:
            return HorizonPoint(*numbers)
    raise BadValue(f"has {_shown(value)}, where [az, el] belongs, az from -360 to 360 and el from -90 to 90")


def _numbers(values: list[object]) -> list[float]:
    """Return those that are finite numbers."""
    numbers = [float(each) for each in values if isinstance(each, int | float) and not isinstance(each, bool)]
    return [each for each in numbers if math.isfinite(each)]


def _expected(row: KeyRow) -> str:
    if row.kind == "choice":
        return f"one of {', '.join(row.choices)}"
    if row.kind == "sectors":
        return "a list of [az_from, az_to, el_below]"
    if row.kind == "points":
        return "a list of [az, el]"
    return {"text": 'text in "quotes"', "true or false": "true or false"}.get(row.kind, f"a {row.kind}")


def _shown(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return "a table" if isinstance(value, dict) else repr(value)[:60]
