"""Texts of TLEs: pairs of lines (2LE), with names above (3LE), with or without the `0` before the name."""

from __future__ import annotations

from birdcage.sky.formats import lines as text_lines
from birdcage.sky.formats import tle
from birdcage.sky.formats.lines import Lines
from birdcage.sky.formats.parse_result import ParseCollector, Unreadable

LONGEST_NAME = 60
"""Providers write up to 25 characters; more than this is not a name but a damaged line, or prose."""

NOTHING_FOUND = ("no gp data found", "no supgp data found", "no results returned")
"""What CelesTrak and Space-Track answer, as text, when they hold nothing for a request."""


class _Stray:
    """Consecutive lines that belong to nothing: one complaint says it for all."""

    def __init__(self, basket: ParseCollector) -> None:
        self._basket = basket
        self._first = 0
        self._last = 0
        self._text = ""

    def note(self, number: int, text: str) -> None:
        """Take a line that has no elements below it."""
        if text.lower().startswith(NOTHING_FOUND):
            self._basket.complain(number, f"the source has nothing for this request: it answered {text!r}")
            return
        if not self._first:
            self._first, self._text = number, text
        self._last = number

    def settle(self) -> None:
        """Say what was noted."""
        if self._first:
            quoted = self._text if len(self._text) <= 40 else self._text[:39] + "…"
            rest = f" (to line {self._last})" if self._last > self._first else ""
            self._basket.complain(self._first, f"no elements follow, and no format is known by this: {quoted!r}{rest}")
        self._first = 0


def name_of(line: str) -> str:
    """Return the name on a name line."""
    line = line.strip()
    return line[2:].strip() if line.startswith("0 ") else line


def read(lines: Lines, start: int, basket: ParseCollector) -> int:
    """Read from line `start` (counted from 0) to where another format begins; return that line."""
    stray = _Stray(basket)
    name: tuple[int, str] | None = None
    first: tuple[int, str, str] | None = None
    """Line 1 that waits for its line 2: number, name, text."""
    at = start
    while at < len(lines):
        line = lines[at]
        match = tle.type_of_line(line) or tle.type_of_line(line.lstrip())
        at += 1
        if match is None:
            text = line.strip()
            if not text or text.startswith("#"):
                continue
            if at - 1 > start and text_lines.kind(lines, at - 1) != "tle":
                at -= 1
                break
            if first:
                basket.complain(first[0], "line 2 is missing below this line 1")
                first = None
            if name:
                stray.note(*name)
            name = (at, text)
            continue
        line = line.lstrip()
        if match[1] == "1":
            if first:
                basket.complain(first[0], "line 2 is missing below this line 1")
            if name and len(name[1]) > LONGEST_NAME:
                stray.note(*name)
                name = None
            stray.settle()
            first = (at, name_of(name[1]) if name else "", line)
            name = None
            continue
        if first is None:
            if name and len(name[1]) > LONGEST_NAME:
                stray.note(*name)
            name = None
            stray.settle()
            basket.complain(at, "line 1 is missing above this line 2")
            continue
        try:
            basket.elements.append(tle.parse(first[1], first[2], line, basket.source))
        except Unreadable as unreadable:
            basket.complain(first[0] if unreadable.where == "line 1" else at, str(unreadable))
        first = None
    if first:
        basket.complain(first[0], "line 2 is missing below this line 1")
    if name:
        stray.note(*name)
    stray.settle()
    return at
