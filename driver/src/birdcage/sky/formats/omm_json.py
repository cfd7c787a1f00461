"""OMM in JSON, as CelesTrak and Space-Track write it, and TLEs in JSON, as SatNOGS DB does.

Objects are read one by one, so that a damaged one, or a text that was cut, costs no other.
"""

from __future__ import annotations

import json
import re
from bisect import bisect_right
from collections.abc import Mapping
from itertools import accumulate

from birdcage.sky.formats import omm, tle
from birdcage.sky.formats.lines import Lines, kind
from birdcage.sky.formats.parse_result import ParseCollector, Unreadable
from birdcage.sky.formats.tle_text import name_of

_GAP = re.compile(r"[\s,]*").match
_NEXT_OBJECT = re.compile(r"\}[\s,]*(?=\{)|\}[\s,]*(?=\])").search
_SCAN = json.JSONDecoder().raw_decode


class _Text:
    """The rest of the text as one string, and the line that a place in it is on."""

    def __init__(self, lines: Lines, start: int) -> None:
        self.body = "\n".join(lines[start:])
        self._start = start
        self._starts = list(accumulate((len(line) + 1 for line in lines[start:]), initial=0))

    def line(self, place: int) -> int:
        """Return the line, counted from 1."""
        return self._start + bisect_right(self._starts, place)


def read(lines: Lines, start: int, basket: ParseCollector) -> int:
    """Read arrays and objects from line `start` (counted from 0); return the line after them."""
    text = _Text(lines, start)
    body = text.body
    place = 0
    open_arrays: list[int] = []
    while True:
        before = text.line(place)
        place = _GAP(body, place).end()  # type: ignore[union-attr]  # it matches the empty string too
        here = body[place : place + 1]
        at = text.line(place) - 1
        if here and not open_arrays and at >= before and kind(lines, at) != "json":
            return at
        if here == "[":
            open_arrays.append(place)
            place += 1
        elif here == "]" and open_arrays:
            open_arrays.pop()
            place += 1
        elif here == "{":
            place = _object(text, place, basket)
        elif not here:
            if open_arrays:
                line = text.line(len(body.rstrip()))
                basket.complain(line, "the text ends before the ] that closes the list: it was cut, more may be lost")
            return len(lines)
        elif open_arrays:
            basket.complain(text.line(place), f"no element set: {body[place : place + 30].splitlines()[0]!r}")
            further = re.compile(r"[{\]]").search(body, place)
            place = further.start() if further else len(body)
        else:
            basket.complain(text.line(place), "there is more behind the JSON on this line, which is not read")
            return text.line(place)


def _object(text: _Text, place: int, basket: ParseCollector) -> int:
    """Read the object that begins at a place; return where to go on."""
    try:
        found, end = _SCAN(text.body, place)
    except json.JSONDecodeError as error:
        further = _NEXT_OBJECT(text.body, place)
        end = further.end() if further else len(text.body)
        cut = not text.body[error.pos :].strip() or error.msg.startswith("Unterminated string")
        why = "the text ends inside this element set: it was cut" if cut else f"damaged JSON: {error.msg}"
        basket.complain(text.line(error.pos if not cut else place), why)
        return end
    except (RecursionError, ValueError) as error:
        basket.complain(text.line(place), f"not JSON that can be read: {error}")
        return len(text.body)
    _take(found, text, place, end, basket)
    return end


def _take(found: Mapping[str, object], text: _Text, place: int, end: int, basket: ParseCollector) -> None:
    """Put one object's elements into the basket; look into one that only wraps lists."""
    fields = {key.upper(): value for key, value in found.items()}
    try:
        if "MEAN_MOTION" in fields or "EPOCH" in fields:
            basket.elements.append(omm.elements_of(fields, basket.source))
        elif (pair := _lines(fields)) is not None:
            basket.elements.append(tle.parse(*pair, basket.source))
        else:
            inner = [item for value in found.values() if isinstance(value, list) for item in value]
            objects = [item for item in inner if isinstance(item, dict)]
            if not objects:
                basket.complain(text.line(place), f"an object without elements: {', '.join(found)[:60] or 'empty'}")
            for item in objects:
                _take(item, text, place, end, basket)
    except Unreadable as unreadable:
        basket.complain(_line_of(unreadable.where, text, place, end), _named(fields, unreadable))


def _lines(fields: Mapping[str, object]) -> tuple[str, str, str] | None:
    """Return name and lines of a TLE inside an object (SatNOGS DB: tle0, tle1, tle2)."""
    for name, line_1, line_2 in (("TLE0", "TLE1", "TLE2"), ("TLE_LINE0", "TLE_LINE1", "TLE_LINE2")):
        first, second = fields.get(line_1), fields.get(line_2)
        if isinstance(first, str) and isinstance(second, str):
            return name_of(str(fields.get(name) or "")), first, second
    return None


def _named(fields: Mapping[str, object], unreadable: Unreadable) -> str:
    """Return the reason with the satellite it is about: all of a file may be on one line."""
    who = fields.get("OBJECT_NAME") or fields.get("TLE0") or fields.get("NORAD_CAT_ID")
    return f"{name_of(str(who))}: {unreadable}" if who else str(unreadable)


def _line_of(where: str, text: _Text, place: int, end: int) -> int:
    """Return the line of a keyword inside an object; the object's own where it is not there."""
    key = where.replace("line ", "tle")
    found = re.compile(f'"{re.escape(key)}"', re.IGNORECASE).search(text.body, place, end) if key else None
    return text.line(found.start() if found else place)
