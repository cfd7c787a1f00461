"""Numbers and times as CCSDS 502.0-B section 7.5 writes them, read more strictly than `float` and `int` would."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta

from birdcage.sky.formats.parse_result import Unreadable

_DECIMAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,4})?", re.ASCII).fullmatch
_INTEGER = re.compile(r"[-+]?\d{1,18}", re.ASCII).fullmatch
_EPOCH = re.compile(
    r"(\d{4})-(?:(\d\d)-(\d\d)|(\d{3}))T(\d\d):(\d\d):(\d\d)(?:\.(\d+))?Z?", re.ASCII | re.IGNORECASE
).fullmatch


def decimal(value: object, keyword: str) -> float:
    """Return the number. Raise Unreadable for text that is none (also `nan`, `1_0`), naming the keyword."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            raise Unreadable(f"{keyword} is too large for a number", keyword) from None
    if isinstance(value, str) and _DECIMAL(value.strip()):
        return float(value)
    raise Unreadable(f"{keyword} is {_shown(value)}, not a number", keyword)


def integer(value: object, keyword: str) -> int:
    """Return the whole number. Raise Unreadable for anything else, naming the keyword."""
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    if isinstance(value, str) and _INTEGER(value.strip()):
        return int(value)
    raise Unreadable(f"{keyword} is {_shown(value)}, not a whole number", keyword)


def epoch(value: object) -> datetime:
    """Return the time, UTC, to the microsecond; calendar or day-of-year form. Raise Unreadable otherwise.

    A leap second (second 60) is told as the last microsecond before midnight's second ends: a datetime has none.
    """
    match = _EPOCH(value.strip()) if isinstance(value, str) else None
    if match is None:
        raise Unreadable(f"EPOCH is {_shown(value)}, not a time like 2026-11-21T09:30:00.000000", "EPOCH")
    year, month, day, day_of_year, hour, minute, second, fraction = match.groups()
    digits = ((fraction or "") + "0000000")[:7]
    microseconds = (int(digits) + 5) // 10
    try:
        if day_of_year:
            first = datetime(int(year), 1, 1, tzinfo=UTC)
            when = first + timedelta(days=int(day_of_year) - 1)
            if int(day_of_year) < 1 or when.year != first.year:
                raise ValueError
        else:
            when = datetime(int(year), int(month), int(day), tzinfo=UTC)
        leap = second == "60" and hour == "23" and minute == "59"
        when = when.replace(hour=int(hour), minute=int(minute), second=59 if leap else int(second))
    except ValueError:
        raise Unreadable(f"EPOCH is {_shown(value)}: there is no such day or time", "EPOCH") from None
    return when + timedelta(microseconds=microseconds)


def _shown(value: object) -> str:
    if value is None or (isinstance(value, str) and not value.strip()):
        return "empty"
    text = repr(value)
    return text if len(text) <= 40 else text[:39] + "…"
