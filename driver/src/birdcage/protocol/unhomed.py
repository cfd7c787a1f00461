"""What firmwares print of an axis that does not know where it is: one place for all dialects."""

from __future__ import annotations

import re
from collections.abc import Iterable

from birdcage.rotator.readings import UnreadablePosition

INT_MAX = 2147483647
"""What an unhomed G2 holds as its azimuth; in which form it prints it no source tells (`docs/reference/g2-motors.md`,
*Position*)."""

_EDGES = (INT_MAX, -INT_MAX - 1)
_UNITS = (1.0, 100.0)
"""As degrees, and as hundredths of a degree, which these firmwares count in (`wrap_min:-42333`)."""
_ROUNDED = 1.0
"""How far single precision, or a form without decimals, moves those numbers."""

_WORDS = re.compile(
    r"\b(?:not|never)\s+(?:yet\s+|been\s+)*(?:homed|calibrated|referenced)\b|\bun(?:homed|calibrated)\b", re.IGNORECASE
)


def is_unhomed(value: float) -> bool:
    """Return whether a printed number stands for an axis that does not know where it is: INT_MAX or INT_MIN."""
    return any(abs(value - edge / unit) <= _ROUNDED for edge in _EDGES for unit in _UNITS)


def says_unhomed(lines: Iterable[str]) -> bool:
    """Return whether an answer says in words that the dish is not homed."""
    return any(_WORDS.search(line) for line in lines)


def unreadable(message: str, printed: Iterable[str]) -> UnreadablePosition:
    """Return the error of an answer that is no position."""
    lines = tuple(printed)
    return UnreadablePosition(message, lines, unhomed=says_unhomed(lines))
