"""What a person may type into the go-to line, and what it means. Pure: text in, a wish or a sentence out."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from birdcage.base.geometry import wrap_360
from birdcage.base.presets import Preset
from birdcage.station.state import StationState

WINDS = ("N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE", "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW")
"""The sixteen winds, clockwise from north, 22.5 degrees apart."""
EXAMPLES = "180 45, az=180, S 40, +5 -2, or a preset's name"
HALF_TURN_DEG = 180.0

_NUMBER = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)")
_KEYED = re.compile(r"(azimuth|elevation|az|el|a|e)\s*[=:]\s*(?=[+\-.\d])|\b(az|el)\s+(?=[+\-.\d])", re.IGNORECASE)
_TIGHT_COMMA = re.compile(r"(?<=\d),(?=\d)")


@dataclass(frozen=True, slots=True)
class Part:
    """What is wished of one axis: an angle, or with `relative` a way from where it was sent last."""

    deg: float
    relative: bool = False


@dataclass(frozen=True, slots=True)
class Wish:
    """What was typed. An axis that is None stays where it is."""

    az: Part | None = None
    el: Part | None = None
    name: str = ""
    """The preset that was named, if one was."""


@dataclass(frozen=True, slots=True)
class Aim:
    """A wish made whole: true degrees."""

    az_deg: float
    el_deg: float
    name: str = ""


def wind_of(az_deg: float) -> str:
    """Return the nearest of the sixteen winds."""
    return WINDS[round(az_deg / 22.5) % 16]


def parse(text: str, presets: Sequence[Preset] = ()) -> Wish:
    """Return what `text` wishes. A sign makes a number relative. ValueError says what to type instead."""
    plain = text.replace("−", "-").replace("°", " ").replace("º", " ")
    try:
        return _direction(plain)
    except ValueError as wrong:
        preset = _preset(text, presets)
        if preset is None:
            raise wrong from None
    return Wish(Part(preset.az_deg), Part(preset.el_deg), preset.name)


def is_direction(text: str) -> bool:
    """Return whether `text` reads as a direction, so that it cannot be the name of one."""
    if re.match(r"\s*(?:skew|sk)\b", text, re.IGNORECASE):
        return True  # the go-to line takes it for an angle of the third axis
    try:
        parse(text)
    except ValueError:
        return False
    return True


def resolve(wish: Wish, state: StationState) -> Aim:
    """Return where a wish leads: relative parts count from the last commanded target, else from the position.

    ValueError while neither is known, or where the azimuth would go more than half a turn.
    """
    position = state.position
    az_from = state.target_az_deg if state.target_az_deg is not None else position.az_deg if position else None
    el_from = state.target_el_deg if state.target_el_deg is not None else position.el_deg if position else None
    az_deg, el_deg = _whole(wish.az, az_from), _whole(wish.el, el_from)
    if az_deg is None or el_deg is None:
        raise ValueError("Where the dish points is not known: type both, such as 180 45.")
    return Aim(wrap_360(az_deg), el_deg, wish.name)


def _whole(part: Part | None, start_deg: float | None) -> float | None:
    if part is not None and not part.relative:
        return part.deg
    return None if start_deg is None else start_deg + (part.deg if part is not None else 0.0)


def _preset(text: str, presets: Sequence[Preset]) -> Preset | None:
    """Return the preset of that name, or the only one whose name begins so."""
    wanted = " ".join(text.split()).casefold()
    if not wanted:
        return None
    exact = [preset for preset in presets if preset.name.casefold() == wanted]
    found = exact or [preset for preset in presets if preset.name.casefold().startswith(wanted)]
    return found[0] if len(found) == 1 else None


def _direction(text: str) -> Wish:
    if not text.strip():
        raise ValueError(f"Type where to: {EXAMPLES}.")
    keyed = _KEYED.sub(lambda found: f" {(found.group(1) or found.group(2))[0].lower()}=", text)
    words = [word for word in re.split(r"[;/\s]+|(?<!\d),|,(?!\d)", keyed) if word]
    if len(words) == 1:
        words = _pair(words[0])
    parts: dict[str, Part] = {}
    for word in words:
        axis, value = ("", word) if "=" not in word else word.split("=", 1)
        if not axis:
            axis = "a" if "a" not in parts else "e"
            if axis in parts or (axis == "e" and value.upper() in WINDS):
                raise ValueError(f"That is too much: azimuth and elevation, such as {EXAMPLES}.")
        if axis in parts:
            raise ValueError(f"{'Azimuth' if axis == 'a' else 'Elevation'} stands there twice: type it once.")
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
        raise ValueError(f"{word} could be read in two ways: write 180.5 45 with points, or 180,5 45 with a space.")
    return [word]


def _part(axis: str, word: str) -> Part:
    if axis == "a" and word.upper() in WINDS:
        return Part(WINDS.index(word.upper()) * 22.5)
    number = _TIGHT_COMMA.sub(".", word)
    if number.count(".") > 1 and "," in word:
        raise ValueError(f"{word} could be read in two ways: write 180.5 45 with points, or 180,5 45 with a space.")
    if not _NUMBER.fullmatch(number):
        raise ValueError(f"{word[:24]} is no direction and no preset: type {EXAMPLES}.")
    value, relative = float(number), number[0] in "+-"
    if axis == "a" and relative and abs(value) > HALF_TURN_DEG:
        raise ValueError(f"{word} is more than half a turn: type the azimuth itself, from 0 to 360.")
    if axis == "a" and value > 360.0:
        raise ValueError(f"Azimuth {word} is more than a full turn: type one from 0 to 360.")
    if axis == "e" and abs(value) > HALF_TURN_DEG:
        raise ValueError(f"Elevation {word} is no elevation: 0 is the horizon, 90 is straight up.")
    return Part(value, relative)
