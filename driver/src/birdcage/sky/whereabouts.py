"""What people type for a place: two angles, a Maidenhead locator, or a city."""

from __future__ import annotations

import re

from birdcage.sky.cities import find_city
from birdcage.sky.locator import decode
from birdcage.sky.observer import Observer

COARSE_DEG = 0.2
"""Half the height of a locator square from which its middle is no place to point from."""
_ANGLE = re.compile(r"([-+]?\d+(?:\.\d+)?)\s*°?\s*([NSEW]?)", re.IGNORECASE)


def parse_place(text: str) -> Observer:
    """Return the place meant by `51.9 4.8`, `33.5S, 151.2E, 640`, `JO21jv`, or `rotterdam`.

    The height is 0 where it was not typed. ValueError with a sentence for what is none, or could be several.
    """
    text = " ".join(text.split())
    if not text:
        raise ValueError("Type latitude and longitude, a Maidenhead locator, or a city.")
    if text[0] in "+-.0123456789":
        return _from_angles(text)
    if any(letter.isdigit() for letter in text):
        return from_locator(text)
    city = find_city(text)
    return Observer(city.latitude_deg, city.longitude_deg, 0.0, city.name)


def from_locator(text: str) -> Observer:
    """Return the middle of a locator. ValueError for none, or for one that is too coarse to point from."""
    latitude, longitude, half_deg = decode(text)
    if half_deg > COARSE_DEG:
        raise ValueError(f"That square is {4 * half_deg:g}° wide. Type six characters: JO21jv.")
    return Observer(round(latitude, 6), round(longitude, 6))


def _from_angles(text: str) -> Observer:
    parts = [part for part in re.split(r"[,;/]\s*|\s+(?=[-+\d])", text) if part]
    found = [_ANGLE.fullmatch(part.strip()) for part in parts]
    matches = [each for each in found if each is not None]
    if len(matches) != len(parts) or len(matches) not in (2, 3):
        raise ValueError(f"{text!r} is not a latitude and longitude. Type `51.9 4.8`; a height in metres may follow.")
    latitude, longitude = (_signed(each) for each in matches[:2])
    letters = [each[2].upper() for each in matches]
    if letters[0] in ("E", "W") or letters[1] in ("N", "S"):
        raise ValueError("The latitude comes first, then the longitude.")
    height_m = float(matches[2][1]) if len(matches) == 3 else 0.0
    return Observer(latitude, longitude, height_m)


def _signed(found: re.Match[str]) -> float:
    value = float(found[1])
    return -value if found[2].upper() in ("S", "W") else value
