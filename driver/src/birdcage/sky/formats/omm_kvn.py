"""OMM in KVN, the CCSDS's own notation: a `KEYWORD = value` on each line (CCSDS 502.0-B section 7.4)."""

from __future__ import annotations

import re

from birdcage.sky.formats import lines as text_lines
from birdcage.sky.formats import omm
from birdcage.sky.formats.lines import Lines
from birdcage.sky.formats.parse_result import ParseCollector, Unreadable
from birdcage.sky.formats.tle import type_of_line

_WITH_UNIT = re.compile(r"([-+.\deE]+)\s*\[[^\]]*\]").fullmatch
_HEADER = frozenset(["CCSDS_OMM_VERS", "CLASSIFICATION", "CREATION_DATE", "ORIGINATOR", "MESSAGE_ID"])


class _Message:
    """One message while its lines come in."""

    def __init__(self) -> None:
        self.fields: dict[str, object] = {}
        self.lines: dict[str, int] = {}
        self.damaged = False

    def settle(self, basket: ParseCollector) -> None:
        """Put its elements into the basket; a header alone is nothing."""
        if self.damaged or self.fields.keys() <= _HEADER:
            return
        first = min(self.lines.values())
        try:
            basket.elements.append(omm.elements_of(self.fields, basket.source))
        except Unreadable as unreadable:
            who = self.fields.get("OBJECT_NAME") or self.fields.get("NORAD_CAT_ID")
            why = f"{who}: {unreadable}" if who else str(unreadable)
            basket.complain(self.lines.get(unreadable.where, first), why)


def read(lines: Lines, start: int, basket: ParseCollector) -> int:
    """Read messages from line `start` (counted from 0); return the line where another format begins."""
    message = _Message()
    at = start
    for at in range(start, len(lines) + 1):
        if at == len(lines):
            break
        line = lines[at].strip()
        if not line or line.split(maxsplit=1)[0] == "COMMENT":
            continue
        key = text_lines.keyword(line)
        if key is None:
            if _ends(lines, at):
                break
            if not message.damaged:
                basket.complain(at + 1, f"no `KEYWORD = value`: {line[:40]!r}; this message is skipped")
            message.damaged = True
            continue
        if key == "CCSDS_OMM_VERS" or (key in message.fields and not key.startswith("USER_DEFINED")):
            message.settle(basket)
            message = _Message()
        value = line.partition("=")[2].strip()
        # Only behind a number: `COSMOS 2619 [GLONASS-K1]` is a name.
        number = _WITH_UNIT(value)
        message.fields[key] = number[1] if number else value
        message.lines[key] = at + 1
    message.settle(basket)
    return at


def _ends(lines: Lines, at: int) -> bool:
    """Tell whether another format begins: one that is known by its start, or a name above a TLE."""
    return (
        text_lines.kind(lines, at) != "tle"
        or bool(type_of_line(lines[at].strip()))
        or bool(type_of_line(text_lines.next_full(lines, at + 1)))
    )
