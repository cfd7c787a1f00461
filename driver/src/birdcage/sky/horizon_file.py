"""Horizons that other programs and people write, as text.

- `az el` a line, split by blanks, tabs, commas or semicolons; `#`, `;` or `//` begins a remark, a first line of words
  is a heading. So are the lists of Stellarium's polygonal landscapes (`azDeg_altDeg`, their default).
- What PVGIS prints as its horizon profile: columns `A` and `H_hor`, azimuth 0 in the south, west positive.
- What PVGIS reads: one height a line, the first one north, clockwise, all equally far apart.
"""

from __future__ import annotations

import math
import re
from pathlib import Path

from birdcage.base.user_file import read_user_file
from birdcage.sky.horizon import HorizonMask

MOST_POINTS = 3600
"""A tenth of a degree is finer than any beam."""
_SPLIT = re.compile(r"[\s,;]+")


def read_horizon(text: str, source: str = "") -> HorizonMask:
    """Return the horizon in a text. ValueError names the line that is none; `source` is the file's name."""
    rows: list[tuple[int, list[float]]] = []
    pvgis = False
    for number, line in enumerate(text.splitlines(), 1):
        words = _words(line)
        if not words:
            continue
        numbers = _numbers(words)
        if numbers is None:
            if words[:2] in (["a", "h_hor"], ["a_hor", "h_hor"]) and not rows:
                pvgis = True
                continue
            if not rows or pvgis:
                continue  # a heading, or what PVGIS explains below its table
            raise ValueError(f"{_where(source, number)}: {line.strip()[:40]!r} is no azimuth and elevation.")
        rows.append((number, numbers))
    if pvgis:
        return _mask([(number, [each[0] + 180.0, *each[1:]]) for number, each in rows if len(each) >= 2], source)
    if rows and all(len(each) == 1 for _number, each in rows):
        step = 360.0 / len(rows)
        rows = [(number, [index * step, each[0]]) for index, (number, each) in enumerate(rows)]
    return _mask(rows, source)


def read_horizon_file(path: Path) -> HorizonMask:
    """Return the horizon in a file. ValueError with file and line for what is none; OSError if it can't be read."""
    try:
        text = read_user_file(path).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(f"{path} is no text.") from None
    return read_horizon(text, str(path))


def write_horizon(mask: HorizonMask) -> str:
    """Return a text that `read_horizon` and Stellarium read."""
    lines = [f"{az_deg:.2f} {el_deg:.2f}" for az_deg, el_deg in mask.points]
    return "\n".join(["# azimuth elevation, true degrees", *lines]) + "\n"


def _words(line: str) -> list[str]:
    line = re.split(r"#|//", line, maxsplit=1)[0].strip()
    if line.startswith(";"):
        return []
    return [word.rstrip("°").casefold() for word in _SPLIT.split(line) if word]


def _numbers(words: list[str]) -> list[float] | None:
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


def _mask(rows: list[tuple[int, list[float]]], source: str) -> HorizonMask:
    if not rows:
        raise ValueError(f"{source or 'The text'} holds no point of a horizon: write `azimuth elevation` on each line.")
    if len(rows) > MOST_POINTS:
        raise ValueError(f"{source or 'The text'} has {len(rows)} points, more than {MOST_POINTS}.")
    points = []
    for number, values in rows:
        if len(values) < 2:
            raise ValueError(f"{_where(source, number)}: an elevation is missing after {values[0]:g}.")
        az_deg, el_deg = values[:2]
        if not (math.isfinite(az_deg) and abs(az_deg) <= 360.0):
            raise ValueError(f"{_where(source, number)}: azimuth {az_deg:g} does not lie from -360 to 360.")
        if not (math.isfinite(el_deg) and abs(el_deg) <= 90.0):
            raise ValueError(f"{_where(source, number)}: elevation {el_deg:g} does not lie from -90 to 90.")
        points.append((az_deg, el_deg))
    return HorizonMask(points)


def _where(source: str, line: int) -> str:
    return f"{source}:{line}" if source else f"line {line}"
