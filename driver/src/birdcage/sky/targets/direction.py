"""Directions as people type them: `180 45`, `180,5 45`, `az=180`, `S 40`, `+5 -2`. Pure: text in, a wish out."""

from __future__ import annotations

import re
from dataclasses import dataclass

WINDS = ("N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW")
"""The sixteen winds, clockwise from north, 22.5 degrees apart."""
EXAMPLES = "180 45, az=180, S 40, +5 -2"
HALF_TURN_DEG = 180.0
STRAIGHT_UP_DEG = 90.0

_NUMBER = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)")
_KEYED = re.compile(r"(azimuth|elevation|az|el|a|e)\s*[=:]\s*(?=[+\-.\d])|\b(az|el)\s+(?=[+\-.\d])", re.IGNORECASE)
_TWO_WAYS = re.compile(r"\s*(?P<half>[ew])\s+(?P<number>\d+(?:[.,]\d+)?)\s*°?\s*", re.IGNORECASE)
_TIGHT_COMMA = re.compile(r"(?<=\d),(?=\d)")


@dataclass(frozen=True, slots=True)
class AxisWish:
    """What is wished of one axis: an angle, or with `relative` a way from where it was sent last."""

    deg: float
    relative: bool = False


@dataclass(frozen=True, slots=True)
class Wish:
    """A direction as typed. An axis that is None stays where it is."""

    az: AxisWish | None = None
    el: AxisWish | None = None


def refuse_two_ways(text: str) -> None:
    """Raise ValueError for `E 40` and `W 40`: an azimuth with an elevation, or a place on the geostationary arc."""
    found = _TWO_WAYS.fullmatch(text)
    if found is not None and float(found["number"].replace(",", ".")) <= STRAIGHT_UP_DEG:
        half, number = found["half"].upper(), found["number"]
        wind = "90" if half == "E" else "270"
        raise ValueError(
            f"{text.strip()} may be a direction or a place on the arc: type az {wind} el {number}, or {number}{half}."
        )


def read_direction(text: str) -> Wish:
    """Return what `text` wishes. A sign makes a number relative. ValueError says what to type instead."""
    text = text.replace("−", "-").replace("°", " ").replace("º", " ")
    refuse_two_ways(text)
    if _TWO_WAYS.fullmatch(text):
        raise ValueError(f"{text.strip()} is a place on the arc, not a direction.")
    if not text.strip():
        raise ValueError(f"Type where to: {EXAMPLES}.")
    keyed = _KEYED.sub(lambda found: f" {(found.group(1) or found.group(2))[0].lower()}=", text)
    words = [word for word in re.split(r"[;/\s]+|(?<!\d),|,(?!\d)", keyed) if word]
    if len(words) == 1:
        words = _pair(words[0])
    parts: dict[str, AxisWish] = {}
    for word in words:
        axis, value = ("", word) if "=" not in word else word.split("=", 1)
        if not axis:
            axis = "a" if "a" not in parts else "e"
            if axis in parts or (axis == "e" and value.upper() in WINDS):
                raise ValueError(f"Type only azimuth and elevation: {EXAMPLES}.")
        if axis in parts:
            raise ValueError(f"{'Azimuth' if axis == 'a' else 'Elevation'} appears twice. Type it once.")
        parts[axis] = _part(axis, value)
    if len(words) == 1 and parts.get("a") and "=" not in words[0] and words[0][0].isdigit():
        raise ValueError(f"Type two numbers, {words[0]} 45; or az={words[0]}, or el={words[0]}.")
    return Wish(parts.get("a"), parts.get("e"))


def _pair(word: str) -> list[str]:
    """Split `180,45`: alone, its comma parts two numbers. What has more commas, or a key, could be read two ways."""
    commas = len(_TIGHT_COMMA.findall(word))
    if commas == 1 and "=" not in word:
        return _TIGHT_COMMA.split(word)
    if commas:
        raise ValueError(f"{word} has two meanings. Type 180.5 45 with points, or 180,5 45 with a space.")
    return [word]


def _part(axis: str, word: str) -> AxisWish:
    if axis == "a" and word.upper() in WINDS:
        return AxisWish(WINDS.index(word.upper()) * 22.5)
    number = _TIGHT_COMMA.sub(".", word)
    if number.count(".") > 1 and "," in word:
        raise ValueError(f"{word} has two meanings. Type 180.5 45 with points, or 180,5 45 with a space.")
    if not _NUMBER.fullmatch(number):
        raise ValueError(f"{word[:24]} is not a direction. Type {EXAMPLES}.")
    value, relative = float(number), number[0] in "+-"
    if axis == "a" and relative and abs(value) > HALF_TURN_DEG:
        raise ValueError(f"{word} is more than half a turn. Type the azimuth itself: 0 to 360.")
    if axis == "a" and value > 360.0:
        raise ValueError(f"Azimuth {word} is more than a full turn. Type 0 to 360.")
    if axis == "e" and abs(value) > HALF_TURN_DEG:
        raise ValueError(f"Elevation {word} is out of range: 0 is the horizon, 90 the zenith.")
    return AxisWish(value, relative)
