"""Gpredict's own files: a satellite in `25544.sat`, many in `satellites.dat`, a group of numbers in `.cat`.

A satellite is a section, `[Satellite]` or `[25544]`, with `NAME`, `NICKNAME`, `TLE1` and `TLE2`.
"""

from __future__ import annotations

import re

from birdcage.base.text import clean
from birdcage.sky.formats import lines as text_lines
from birdcage.sky.formats import tle
from birdcage.sky.formats.lines import Lines
from birdcage.sky.formats.parse_result import NumberGroup, ParseCollector, Unreadable

_KEY = re.compile(r"([A-Za-z][A-Za-z0-9_]*)\s*=\s*(.*)").fullmatch
_NUMBER = re.compile(r"\d{1,9}", re.ASCII).fullmatch


def read_sections(lines: Lines, start: int, basket: ParseCollector) -> int:
    """Read sections from line `start` (counted from 0); return the line where something else begins."""
    section = start
    values: dict[str, tuple[int, str]] = {}
    for at in range(start + 1, len(lines)):
        line = lines[at].strip()
        if not line or line.startswith("#"):
            continue
        if text_lines.is_section(line):
            _satellite(section + 1, values, basket)
            section, values = at, {}
            continue
        key = _KEY(line)
        if key is None or text_lines.kind(lines, at) == "kvn":
            _satellite(section + 1, values, basket)
            return at
        values[key[1].upper()] = (at + 1, key[2])
    _satellite(section + 1, values, basket)
    return len(lines)


def _satellite(section: int, values: dict[str, tuple[int, str]], basket: ParseCollector) -> None:
    first, second = values.get("TLE1"), values.get("TLE2")
    if first is None or second is None:
        basket.complain(section, f"{'TLE1' if first is None else 'TLE2'} is missing in this section")
        return
    name = values.get("NAME") or values.get("NICKNAME") or (0, "")
    try:
        basket.elements.append(tle.parse(name[1], first[1], second[1], basket.source))
    except Unreadable as unreadable:
        basket.complain(first[0] if unreadable.where == "line 1" else second[0], str(unreadable))


def is_group(lines: Lines) -> bool:
    """Tell whether a text is a title and then nothing but catalogue numbers."""
    full = [line.strip() for line in lines if line.strip()]
    return len(full) > 1 and not _NUMBER(full[0]) and all(map(_NUMBER, full[1:]))


def read_group(lines: Lines, basket: ParseCollector) -> None:
    """Read a `.cat` file: its first line is the title, each further one a catalogue number."""
    title = ""
    numbers: list[int] = []
    for at, line in enumerate(lines, 1):
        text = line.strip()
        if not text:
            continue
        if not title:
            title = text
        elif _NUMBER(text):
            numbers.append(int(text))
        else:
            basket.complain(at, f"{text[:40]!r} is not a catalogue number")
    if title:
        basket.groups.append(NumberGroup(clean(title), tuple(numbers), basket.source))
    else:
        basket.complain(0, "the group has no title: the file is empty")
