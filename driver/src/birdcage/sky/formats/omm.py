"""One Orbit Mean-Elements Message (CCSDS 502.0-B section 4) as keywords and values, whatever it was written in."""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import UTC, datetime, timedelta

from birdcage.sky.elements import ElementSet
from birdcage.sky.formats.limits import checked
from birdcage.sky.formats.parse_result import Unreadable

SGP4_XP = 4
"""The ephemeris type of elements for another theory than SGP4."""

_MUST_BE = (
    ("CENTER_NAME", ("EARTH",)),
    ("REF_FRAME", ("TEME",)),
    ("TIME_SYSTEM", ("UTC",)),
    ("MEAN_ELEMENT_THEORY", ("SGP4", "SGP/SGP4", "SGP")),
)
"""Left out of CSV and JSON by every provider, where they are then meant."""

_NEEDED = (
    "EPOCH",
    "MEAN_MOTION",
    "ECCENTRICITY",
    "INCLINATION",
    "RA_OF_ASC_NODE",
    "ARG_OF_PERICENTER",
    "MEAN_ANOMALY",
    "BSTAR",
)

# Numbers and times as CCSDS 502.0-B section 7.5 writes them, read more strictly than `float` and `int` would.
_DECIMAL = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,4})?", re.ASCII).fullmatch
_INTEGER = re.compile(r"[-+]?\d{1,18}", re.ASCII).fullmatch
_EPOCH = re.compile(
    r"(\d{4})-(?:(\d\d)-(\d\d)|(\d{3}))T(\d\d):(\d\d):(\d\d)(?:\.(\d+))?Z?", re.ASCII | re.IGNORECASE
).fullmatch


def _filled(fields: Mapping[str, object], key: str) -> object:
    """Return the value, None if it is left out or empty."""
    value = fields.get(key)
    return None if isinstance(value, str) and not value.strip() else value


def elements_of(fields: Mapping[str, object], source: str) -> ElementSet:
    """Return the elements. Raise Unreadable, naming the keyword, for what is missing, no number, or not for SGP4."""
    for key in _NEEDED:
        if _filled(fields, key) is None:
            raise Unreadable(f"{key} is {'empty' if key in fields else 'missing'}", key)
    for key, allowed in _MUST_BE:
        value = _filled(fields, key)
        if value is not None and str(value).strip().upper() not in allowed:
            raise Unreadable(f"{key} is {value!r}; birdcage reads {' or '.join(allowed[:2])}", key)
    number, revolution, kind = (
        integer(value, key) if (value := _filled(fields, key)) is not None else 0
        for key in ("NORAD_CAT_ID", "REV_AT_EPOCH", "EPHEMERIS_TYPE")
    )
    if kind == SGP4_XP:
        raise Unreadable("made for SGP4-XP (ephemeris type 4), which birdcage does not compute", "EPHEMERIS_TYPE")
    dot, ddot = (
        _decimal(value, key) if (value := _filled(fields, key)) is not None else 0.0
        for key in ("MEAN_MOTION_DOT", "MEAN_MOTION_DDOT")
    )
    return checked(
        ElementSet(
            name=str(_filled(fields, "OBJECT_NAME") or number or "unnamed").strip(),
            norad_id=number,
            epoch=epoch(fields["EPOCH"]),
            inclination_deg=_decimal(fields["INCLINATION"], "INCLINATION"),
            raan_deg=_decimal(fields["RA_OF_ASC_NODE"], "RA_OF_ASC_NODE"),
            eccentricity=_decimal(fields["ECCENTRICITY"], "ECCENTRICITY"),
            argument_of_perigee_deg=_decimal(fields["ARG_OF_PERICENTER"], "ARG_OF_PERICENTER"),
            mean_anomaly_deg=_decimal(fields["MEAN_ANOMALY"], "MEAN_ANOMALY"),
            mean_motion_rev_day=_decimal(fields["MEAN_MOTION"], "MEAN_MOTION"),
            bstar=_decimal(fields["BSTAR"], "BSTAR"),
            mean_motion_dot=dot,
            mean_motion_ddot=ddot,
            international_designator=str(_filled(fields, "OBJECT_ID") or "").strip(),
            revolution=revolution,
            source=source,
        )
    )


def _decimal(value: object, keyword: str) -> float:
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
