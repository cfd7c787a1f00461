"""OMM in XML (CCSDS 505.0-B): `ndm` with an `omm` for each satellite, or one `omm` alone.

Each message is parsed by itself, so that a damaged one costs no other, and so that no document type can come before
it: entities, which are the way to blow up a reader, are then never defined. A document with one is refused.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from itertools import accumulate
from xml.parsers import expat

from birdcage.sky.formats import omm
from birdcage.sky.formats.lines import Lines
from birdcage.sky.formats.parse_result import ParseCollector, Unreadable

DEEPEST = 30
"""Levels inside one message; five are used."""

_ROOT = re.compile(r"<([A-Za-z_][\w.:-]*)")
_OPEN = re.compile(r"<(?:[\w.-]+:)?omm[\s>]")
_CLOSE = re.compile(r"</(?:[\w.-]+:)?omm\s*>")


def read(lines: Lines, start: int, basket: ParseCollector) -> int:
    """Read one document from line `start` (counted from 0); return the line after it."""
    body = "\n".join(lines[start:])
    starts = list(accumulate((len(line) + 1 for line in lines[start:]), initial=0))

    def line_of(place: int) -> int:
        """Return the line of a place, counted from 1."""
        return start + bisect_right(starts, place)

    root = _ROOT.search(body)
    if root is None:
        basket.complain(start + 1, "looks like XML, but has no element")
        return len(lines)
    name = root[1]
    close = re.compile(rf"</{re.escape(name)}\s*>").search(body, root.end())
    end = close.end() if close else len(body)
    after = line_of(end) if close else len(lines)
    if name.rpartition(":")[2].lower() == "html" or "<!doctype html" in body[: root.start()].lower():
        basket.complain(start + 1, "a web page, not element sets (a log-in page or an error message?)")
        return after
    if "<!DOCTYPE" in body[: root.start()] or "<!ENTITY" in body[: root.start()]:
        basket.complain(start + 1, "XML with a document type or entities is not read: no element set needs them")
        return after
    local = name.rpartition(":")[2]
    if local not in ("ndm", "omm"):
        basket.complain(line_of(root.start()), f"XML, but <{name}>; element sets are in <ndm> or <omm>")
        return after
    found = 0
    place = root.start()
    while opening := _OPEN.search(body, place, end):
        following = _OPEN.search(body, opening.end(), end)
        limit = following.start() if following else end
        closing = _CLOSE.search(body, opening.end(), limit)
        place = closing.end() if closing else limit
        _message(body[opening.start() : place], line_of(opening.start()), basket)
        found += 1
    if not found:
        basket.complain(line_of(root.start()), f"<{name}> holds no <omm>")
    if close is None and local == "ndm":
        basket.complain(line_of(len(body.rstrip())), f"the text ends before </{name}>: it was cut, more may be lost")
    elif close and body[end : starts[after - start]].strip():
        basket.complain(after, f"there is more behind </{name}> on this line, which is not read")
    return after


class _Leaves:
    """Collects the elements that hold text."""

    def __init__(self, first_line: int) -> None:
        self.fields: dict[str, object] = {}
        self.lines: dict[str, int] = {}
        self._first_line = first_line
        self._text: list[str] = []
        self._depth = 0
        self.parser = expat.ParserCreate()
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.CharacterDataHandler = self._text.append

    @property
    def line(self) -> int:
        """Where the parser is, counted from 1."""
        return self._first_line + self.parser.CurrentLineNumber - 1

    def _start(self, name: str, _attributes: dict[str, str]) -> None:
        self._depth += 1
        if self._depth > DEEPEST:
            raise Unreadable("XML nested too deep for an element set")
        self._text.clear()
        self.lines[name.rpartition(":")[2]] = self.line

    def _end(self, name: str) -> None:
        self._depth -= 1
        key = name.rpartition(":")[2]
        if key.isupper() and key not in ("COMMENT", "USER_DEFINED"):
            self.fields[key] = "".join(self._text).strip()
        self._text.clear()


def _message(body: str, first_line: int, basket: ParseCollector) -> None:
    leaves = _Leaves(first_line)
    try:
        leaves.parser.Parse(body, True)
        basket.elements.append(omm.elements_of(leaves.fields, basket.source))
    except expat.ExpatError as error:
        cut = error.code == expat.errors.codes[expat.errors.XML_ERROR_NO_ELEMENTS] or not _CLOSE.search(body)
        why = "this <omm> is not closed: it was cut" if cut else f"damaged XML: {expat.ErrorString(error.code)}"
        line = first_line if cut else first_line + error.lineno - 1
        basket.complain(line, _named(leaves, why))
    except Unreadable as unreadable:
        basket.complain(leaves.lines.get(unreadable.where, first_line), _named(leaves, str(unreadable)))


def _named(leaves: _Leaves, why: str) -> str:
    """Return the reason with the satellite it is about: all of a file may be on one line."""
    who = leaves.fields.get("OBJECT_NAME") or leaves.fields.get("NORAD_CAT_ID")
    return f"{who}: {why}" if who else why
