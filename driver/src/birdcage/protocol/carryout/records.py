"""Reads the live records of a Carryout of 2003, from whatever pieces of the stream they come in.

Split at single blanks, a record holds the token `el`; three tokens before it stands the azimuth, two after it the
elevation, as whole numbers of 0.01 degrees. That is all that is known (`docs/reference/carryout-2003.md`): the tokens
in between may be anything, or empty, and what surrounds a record is free.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_WORDS = r" [^ ]{0,24} [^ ]{0,24} el [^ ]{0,24} "
LIVE = re.compile(rf"(?<![^ ])\d{{1,5}}{_WORDS}\d{{4}}(?!\d)")
"""A record in a line that a console has cut off."""
_RECORD = re.compile(rf"(?<=[ \r\n])(\d{{1,5}})[\r\n]*{_WORDS}(\d{{4}})(?=\D)")
"""The azimuth must be seen to begin, and the elevation to end: a number that is cut is another number. Every elevation
that the dish takes has four digits."""
_LONGEST = 128
"""Characters that a record may still need behind it."""
_HIGHEST_AZ_DEG = 720.0
"""Wider than any dish turns: what lies beyond is a misread number, not an angle."""


@dataclass(frozen=True, slots=True)
class LiveRecord:
    """Where the motors were when it was printed, in degrees of the dish's own frame."""

    az_deg: float
    el_deg: float


class RecordReader:
    """Takes in bytes as they come. A record that noise has touched is passed over, never guessed."""

    def __init__(self) -> None:
        self._text = ""

    def feed(self, data: bytes) -> list[LiveRecord]:
        """Return the records that have become whole, oldest first."""
        self._text += data.decode("latin-1")
        found, end = [], 0
        for match in _RECORD.finditer(self._text):
            end = match.end()
            record = LiveRecord(int(match[1]) / 100.0, int(match[2]) / 100.0)
            if record.az_deg <= _HIGHEST_AZ_DEG:
                found.append(record)
        self._text = self._text[max(end, len(self._text) - _LONGEST) :]
        return found

    def feed_line(self, line: str) -> list[LiveRecord]:
        """Take in a line that a console has cut off already."""
        return self.feed(b"\n" + line.encode("latin-1", "replace") + b"\n")

    def forget(self) -> None:
        """Drop what was begun: what comes next is not its continuation."""
        self._text = ""
