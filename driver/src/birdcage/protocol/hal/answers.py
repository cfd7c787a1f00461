"""Reads what HAL consoles print: positions and settings, leniently in layout and strictly in what counts."""

from __future__ import annotations

import re
from collections.abc import Iterable

from birdcage.base.errors import PositionUnknown
from birdcage.base.reason import Reason
from birdcage.protocol.unhomed import is_unhomed, unreadable
from birdcage.rotator.values import Position

_ANGLE = re.compile(r"\b(AZ|EL|(SK)) =\s+([-+]?\d+(?:\.\d+)?)(?!\S)(?(2)|(?=\s+[A-Za-z]|\s*$))")
"""Label, space, `=`, at least one space, a decimal; on one line or on three (`docs/reference/travler.md`, *Position*).

What no word follows, noise has cut in two; after the skew the wrap position may follow as it is.
"""
_PLAUSIBLE = {"AZ": (-360.0, 720.0), "EL": (-90.0, 180.0), "SK": (-360.0, 360.0)}
"""Wider than any dish turns: what lies outside is a misread number, not an angle."""
_NUMBER = re.compile(r"(?:^|(?<=[\s=:]))([-+]?\d+(?:\.\d+)?)(?=\s|$)")


def parse_position(lines: Iterable[str]) -> Position:
    """Return the angles that `a` printed; skew None if none was printed.

    PositionUnknown (`unhomed`) for an axis that does not know where it is, UnreadablePosition unless azimuth and
    elevation were printed as angles.
    """
    printed = tuple(lines)
    told = " ".join(printed)
    found: dict[str, str] = {}
    for match in _ANGLE.finditer(told):
        found.setdefault(match[1], match[3])
    if any(is_unhomed(float(text)) for text in found.values()):
        raise PositionUnknown(
            "The dish is not homed, so it does not know where it points. It homes by itself at power-up.",
            reason=Reason.UNHOMED,
        )
    angles = {label: _angle(label, text) for label, text in found.items()}
    az_deg, el_deg = angles.get("AZ"), angles.get("EL")
    if az_deg is None or el_deg is None or ("SK" in angles and angles["SK"] is None):
        raise unreadable(f"The dish answered `a` with {told!r}, not with an azimuth and an elevation.", printed)
    return Position(az_deg, el_deg, angles.get("SK"))


def parse_setting(index: int, lines: Iterable[str]) -> str | None:
    """Return the value in force of one row of the settings memory, as printed; None when none is to be seen.

    How `e <index>` prints it no source tells: taken is the first number that stands by itself after the index.
    """
    for line in lines:
        text = re.sub(rf"^\D*\b{index}\b[^\w\s]*", " ", line)
        if found := _NUMBER.search(text):
            return found[1]
    return None


def _angle(label: str, text: str) -> float | None:
    low, high = _PLAUSIBLE[label]
    value = float(text)
    return value if "." in text and low <= value <= high else None
