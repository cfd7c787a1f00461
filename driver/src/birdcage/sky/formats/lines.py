"""The lines of a text, and which of them begin something."""

from __future__ import annotations

import re
from collections.abc import Sequence

from birdcage.sky.formats.tle import type_of_line

Lines = Sequence[str]

_SECTION = re.compile(r"\[[^\[\]{}\",]*\]$").match
_KEYWORD = re.compile(r"([A-Z][A-Z0-9_]*)\s*=").match
_KVN_STARTS = frozenset(
    (
        *("CCSDS_OMM_VERS", "COMMENT", "CLASSIFICATION", "CREATION_DATE", "ORIGINATOR", "MESSAGE_ID"),
        *("OBJECT_NAME", "OBJECT_ID", "CENTER_NAME", "REF_FRAME", "TIME_SYSTEM", "MEAN_ELEMENT_THEORY"),
        *("EPOCH", "MEAN_MOTION", "NORAD_CAT_ID"),
    )
)


def split(text: str) -> list[str]:
    """Return the lines as an editor counts them, whatever ends them, without a byte order mark."""
    return text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n").split("\n")


def next_full(lines: Lines, start: int) -> str:
    """Return the next line that is not blank, stripped; empty at the end."""
    return next((line.strip() for line in lines[start : start + 50] if line.strip()), "")


def is_section(line: str) -> bool:
    """Tell whether a line is the head of a section, as in Gpredict's files."""
    return bool(_SECTION(line.strip()))


def keyword(line: str) -> str | None:
    """Return the keyword of a `KEY = value` line."""
    match = _KEYWORD(line.strip())
    return match[1] if match else None


def delimiter(line: str) -> str | None:
    """Return what parts the columns of a table of elements, when this line is its head."""
    upper = line.upper()
    if "NORAD_CAT_ID" not in upper and "OBJECT_NAME" not in upper and "MEAN_MOTION" not in upper:
        return None
    found = max(",;\t", key=line.count)
    return found if line.count(found) >= 2 else None


def kind(lines: Lines, at: int) -> str:
    """Return what begins at a line that is not blank: xml, json, sections, table, kvn or tle."""
    line = lines[at].strip()
    first = line[0]
    # Whatever stands above an element line is a name, however it looks.
    if type_of_line(line) or type_of_line(next_full(lines, at + 1)):
        return "tle"
    if first == "<":
        return "xml" if re.match(r"<[?!A-Za-z]", line) else "tle"
    if first == "[" and is_section(line) and "=" in next_full(lines, at + 1):
        return "sections"
    if first in "[{":
        return "json" if re.match(r'[\[{]\s*($|[\[{"\]}])', line) else "tle"
    if delimiter(line):
        return "table"
    if keyword(line) in _KVN_STARTS:
        return "kvn"
    return "tle"
