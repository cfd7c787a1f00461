"""Catalogue numbers in the five columns of a TLE: five digits, or a letter and four digits (Space-Track's Alpha-5)."""

from __future__ import annotations

from birdcage.sky.formats.parse_result import Unreadable

LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
"""For 10 to 33; I and O are left out because they look like digits."""


def decode(field: str) -> int:
    """Return the number of five columns; leading blanks count as zeros. Raise Unreadable for anything else."""
    if field.isascii():
        if field.isdigit():
            return int(field)
        if len(field) == 5 and field[1:].isdigit() and field[0] in LETTERS:
            return (LETTERS.index(field[0]) + 10) * 10_000 + int(field[1:])
        if field.strip().isdigit() and not field.endswith(" "):
            return int(field)
        if field[:1] in ("I", "O") and field[1:].isdigit():
            raise Unreadable(f"catalogue number {field}: the letters I and O are never used, a digit was meant")
    raise Unreadable(f"catalogue number {field!r} is neither five digits nor a letter and four digits")
