"""What both firmwares read off a word: a command with a number behind it, as C reads numbers."""

from __future__ import annotations

import re

_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)")


def number_after(word: str, command: str) -> float | None:
    """Return the number that follows a command without a blank; None where the word is another, or none follows."""
    if not word.upper().startswith(command):
        return None
    found = _NUMBER.match(word[len(command) :])
    return None if found is None else float(found[1])


def pair(az_deg: float, el_deg: float) -> str:
    """Return a position as both firmwares print it."""
    return f"AZ{az_deg:.1f} EL{el_deg:.1f}\n"
