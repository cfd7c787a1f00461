"""Values of a machine's settings as text: what they are, whether two are the same, what a person may give."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from birdcage.base.errors import OutOfRange
from birdcage.rotator.feature import FeatureKind

if TYPE_CHECKING:
    from birdcage.rotator.own_settings import SettingKnown, SettingRow

SettingValue = bool | int | float | str
LONGEST_VALUE = 24
"""Characters of a value that may be given: more than any that a machine prints."""
UNDOCUMENTED = "Undocumented row. A wrong value may stop the dish from working."
"""What a person has to agree to who changes a row that no source tells of."""

_HEX = re.compile(r"0[xX][0-9A-Fa-f]{1,8}")
_WHOLE = re.compile(r"[-+]?\d{1,10}", re.ASCII)
_DECIMAL = re.compile(r"[-+]?\d{1,10}\.\d+", re.ASCII)
_WORDS = {"TRUE": "TRUE", "ON": "TRUE", "YES": "TRUE", "1": "TRUE", "FALSE": "FALSE", "OFF": "FALSE", "NO": "FALSE",
          "0": "FALSE"}  # fmt: skip


def typed(text: str) -> SettingValue:
    """Return a value as what it is: `TRUE`, `0x00000007`, `200`, `+0`, `65.00`; any other text as it stands."""
    if text in ("TRUE", "FALSE"):
        return text == "TRUE"
    if _HEX.fullmatch(text):
        return int(text, 16)
    if _WHOLE.fullmatch(text):
        return int(text)
    if _DECIMAL.fullmatch(text):
        return float(text)
    return text


def same_value(printed: str, given: str) -> bool:
    """Return whether a machine that was given one text prints the other for it: `1` is `TRUE`, `18` is `18.00`."""
    one, other = typed(printed), typed(given.upper() if given.upper() in ("TRUE", "FALSE") else given)
    return one == other


def danger_of(known: SettingKnown | None) -> str:
    """Return what a person has to agree to who changes a row; empty if nothing speaks against it."""
    return UNDOCUMENTED if known is None else known.danger


def given_value(row: SettingRow, known: SettingKnown | None, text: str) -> str:
    """Return what a person gave for a row as the machine would print it: `on` is `TRUE`, `18` is `18.00`.

    The form is that of the present value. OutOfRange, which names value, limit and remedy, for what does not fit.
    """
    where, text = f"Row {row.index} ({row.name})" if row.name else f"Row {row.index}", text.strip()
    now = typed(row.current)
    if isinstance(now, bool):
        if text.upper() not in _WORDS:
            raise OutOfRange(f"{where} is a switch, and {text!r} was given. Give on or off.")
        return _WORDS[text.upper()]
    if isinstance(now, str) or (known is not None and known.kind is FeatureKind.TEXT):
        if not text or len(text) > LONGEST_VALUE or not text.isascii() or not text.isprintable() or " " in text:
            raise OutOfRange(f"{where}: {text!r} is no single word of 1 to {LONGEST_VALUE} plain characters.")
        return text
    value = typed(text)
    if isinstance(value, bool | str) or (isinstance(now, int) and isinstance(value, float)):
        kind = "a whole number" if isinstance(now, int) else "a number"
        raise OutOfRange(f"{where} is {row.current}, and {text!r} was given. Give {kind}.")
    limits = None if known is None else known.range
    if limits is not None and not limits.holds(value):
        unit = f" {known.unit}" if known is not None and known.unit else ""
        limit = limits.low if value < limits.low else limits.high
        raise OutOfRange(
            f"{where}: {value:g}{unit} is {abs(value - limit):.6g}{unit} beyond its limit of {limit:g}{unit}. "
            f"Give {limits}{unit}."
        )
    return _as_printed(row, where, value)


def _as_printed(row: SettingRow, where: str, value: float) -> str:
    if _HEX.fullmatch(row.current):
        if not 0 <= value < 2**32:
            raise OutOfRange(f"{where}: {value:g} does not fit. Give 0x00000000 to 0xFFFFFFFF.")
        return f"0x{int(value):08X}"
    if isinstance(typed(row.current), float):
        places = len(row.current.partition(".")[2])
        text = f"{value:.{places}f}"
        if float(text) != value:
            raise OutOfRange(f"{where} has {places} decimals, and {value:g} was given. Give {text}.")
        return text
    signed = row.current.startswith(("+", "-"))
    return f"{int(value):+d}" if signed else str(int(value))
