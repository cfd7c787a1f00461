"""The coastlines of the world, for maps on a screen: Natural Earth at 1:110 million, public domain."""

from __future__ import annotations

from functools import cache
from importlib.resources import files

Line = tuple[tuple[float, float], ...]
"""Latitude and longitude in degrees, from point to point; none crosses the antimeridian."""


@cache
def coastline() -> tuple[Line, ...]:
    """Return 129 lines of 5,000 pieces in all, the longest first (`scripts/cut_coastline.py`).

    The first call reads a file of 37 kB in a few milliseconds.
    """
    text = (files("birdcage.sky") / "data" / "coastline.txt").read_text(encoding="ascii")
    return tuple(_line(row) for row in text.splitlines() if not row.startswith("#"))


def _line(row: str) -> Line:
    """Return the points of a row: longitude and latitude in hundredths of a degree, then the steps."""
    numbers = [int(word) for word in row.split()]
    x = y = 0
    points = []
    for dx, dy in zip(numbers[::2], numbers[1::2], strict=True):
        x, y = x + dx, y + dy
        points.append((y / 100, x / 100))
    return tuple(points)
