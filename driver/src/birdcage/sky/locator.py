"""Maidenhead locators: `JO21`, `JO21JV`, `JO21JV83` (IARU Region 1 VHF Managers Handbook, "Locator").

Pairs of letters, digits, letters, digits divide the globe, longitude first: fields of 20 by 10 degrees, squares of
2 by 1 degrees, subsquares of 5 by 2.5 minutes, extended squares of 30 by 15 seconds.
"""

from __future__ import annotations

import math
import re

_LOCATOR = re.compile(r"([A-R]{2})(\d{2})(?:([A-X]{2})(\d{2})?)?")
_PARTS = (18, 10, 24, 10)
"""Into how many parts each pair divides what the one before it left."""


def decode(locator: str) -> tuple[float, float, float]:
    """Return latitude and longitude in degrees of the middle of a locator, and half its height in degrees.

    4, 6 or 8 characters, in capitals or not. ValueError with a sentence for anything else.
    """
    text = locator.strip().upper()
    found = _LOCATOR.fullmatch(text)
    if found is None:
        raise ValueError(
            f"{locator.strip()!r} is not a Maidenhead locator of 4, 6 or 8 characters. Type it like JO21jv."
        )
    lon_deg, lat_deg, size_deg = -180.0, -90.0, 180.0
    for pair, parts in zip((pair for pair in found.groups() if pair), _PARTS, strict=False):
        first = ord("0") if pair.isdigit() else ord("A")
        size_deg /= parts
        lon_deg += 2 * size_deg * (ord(pair[0]) - first)
        lat_deg += size_deg * (ord(pair[1]) - first)
    return lat_deg + size_deg / 2, lon_deg + size_deg, size_deg / 2


def encode(latitude_deg: float, longitude_deg: float) -> str:
    """Return the six-character locator of a place, as people write it: `JO21jv`. ValueError for no place."""
    if not (math.isfinite(longitude_deg) and abs(latitude_deg) <= 90.0):
        raise ValueError(f"no place on Earth: latitude {latitude_deg}, longitude {longitude_deg}")
    # In subsquares counted from the corner of AA00aa; the pole belongs to the last one.
    rows = min(math.floor((latitude_deg + 90.0) * 24.0), 180 * 24 - 1)
    columns = math.floor(((longitude_deg + 180.0) % 360.0) * 12.0)
    text = ""
    for square, first in ((240, "A"), (24, "0"), (1, "a")):
        for count in (columns, rows):
            text += chr(ord(first) + count // square)
        columns, rows = columns % square, rows % square
    return text
