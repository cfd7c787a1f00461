"""OMM in a table (CSV): a head line of keywords, then a line for each satellite."""

from __future__ import annotations

import csv

from birdcage.sky.formats import lines as text_lines
from birdcage.sky.formats import omm
from birdcage.sky.formats.lines import Lines
from birdcage.sky.formats.parse_result import ParseCollector, Unreadable
from birdcage.sky.formats.tle import type_of_line


def read(lines: Lines, start: int, basket: ParseCollector) -> int:
    """Read the table whose head is line `start` (counted from 0); return the line after it."""
    comma = text_lines.delimiter(lines[start]) or ","
    columns = [cell.strip().upper() for cell in next(csv.reader([lines[start]], delimiter=comma))]
    missing = [key for key in ("EPOCH", "MEAN_MOTION", "ECCENTRICITY") if key not in columns]
    if missing:
        basket.complain(start + 1, f"a table without {', '.join(missing)} holds no elements: skipped")
    at, rows = start + 1, 0
    while at < len(lines) and not (lines[at].strip() and _ends(lines, at, comma)):
        if lines[at].strip():
            rows += 1
            if not missing:
                _row(lines[at], at + 1, columns, comma, basket)
        at += 1
    if not rows and not missing:
        basket.complain(start + 1, "the head of a table, with no row below it")
    return at


def _ends(lines: Lines, at: int, comma: str) -> bool:
    """Tell whether something else than a row begins here: another head, another format, a name above a TLE."""
    line = lines[at].strip()
    if type_of_line(line) and comma not in line:
        return True
    if comma not in line:
        return text_lines.kind(lines, at) != "tle" or bool(type_of_line(text_lines.next_full(lines, at + 1)))
    return text_lines.kind(lines, at) == "table" or line[0] in "<{" or line.startswith("[{")


def _row(line: str, number: int, columns: list[str], comma: str, basket: ParseCollector) -> None:
    try:
        cells = next(csv.reader([line], delimiter=comma, strict=True))
    except csv.Error as error:
        basket.complain(number, f"no row of a table: {error}")
        return
    if len(cells) != len(columns):
        cut = ": it was cut" if len(cells) < len(columns) else ""
        basket.complain(number, f"{len(cells)} columns where the head has {len(columns)}{cut}")
        return
    try:
        basket.elements.append(omm.elements_of(dict(zip(columns, cells, strict=True)), basket.source))
    except Unreadable as unreadable:
        basket.complain(number, str(unreadable))
