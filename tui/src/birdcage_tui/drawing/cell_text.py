"""Text by the cells that it takes on a terminal: a Chinese sign takes two, an accent that is combined takes none."""

from __future__ import annotations

import textwrap
import unicodedata

from rich.cells import cell_len, get_character_cell_size, set_cell_size

__all__ = ["cell_len", "cut", "elide", "fit", "pad", "pieces", "shorten", "wrap"]
BREAKS = ("  ", ". ", ", ", ": ", " (")
"""Where one thing ends that a line tells, and the next one begins."""
_FILLER = "\ue000"
"""Stands for the second cell of a wide sign while rows are wrapped: for private use, so no text holds it."""


def pieces(text: str) -> list[tuple[str, int]]:
    """Return each sign that is seen, with the accents combined into it, and its width of 1 or 2 cells."""
    found: list[tuple[str, int]] = []
    for char in text:
        width = get_character_cell_size(char)
        if width:
            found.append((char, width))
        elif found and unicodedata.category(char) in ("Mn", "Me"):
            found[-1] = (found[-1][0] + char, found[-1][1])
    return found


def pad(text: str, width: int) -> str:
    """Return `text` in exactly so many cells: filled with spaces, or cut."""
    return text.ljust(width)[: max(width, 0)] if text.isascii() else set_cell_size(text, max(width, 0))


def cut(text: str, width: int) -> str:
    """Return `text` in so many cells at most; where its end is cut, an ellipsis stands for it."""
    return text if cell_len(text) <= width else f"{_begin(text, width - 1)}…"


def elide(text: str, width: int) -> str:
    """Return `text` in so many cells at most; where it is too long, an ellipsis stands for its middle."""
    if cell_len(text) <= width:
        return text
    room = max(width - 1, 0)
    end = _begin(text[::-1], room // 2)[::-1]
    return f"{_begin(text, room - cell_len(end)).rstrip()}…{end.lstrip()}"


def fit(name: str, width: int) -> str:
    """Return a name in so many cells: what stands in brackets goes first, then the middle."""
    if cell_len(name) > width:
        name = name.partition(" (")[0]
    return elide(name, width)


def shorten(text: str, width: int) -> str:
    """Return as much of a line as is whole in so many cells: no figure loses what belongs to it.

    It ends where one thing is told, with an ellipsis; where that would leave less than half of the room, behind a word.
    """
    if cell_len(text) <= width:
        return text
    begin = _begin(text, width - 1)
    end = max(begin.rfind(mark) for mark in BREAKS)
    if cell_len(begin[: max(end, 0)]) * 2 < width:
        end = begin.rfind(" ")
    return f"{begin[:end].rstrip(' ,:(')} …" if end > 0 else cut(text, width)


def wrap(text: str, width: int, *, indent: str = "", most: int | None = None) -> list[str]:
    """Return `text` in rows of so many cells at most; all but the first begin with `indent`.

    `most`: the greatest number of rows; the last ends in an ellipsis where there would be more.
    """
    if text.isascii() or cell_len(text) == len(text):
        return _wrap(text, width, indent, most)
    filled = "".join(piece + _FILLER * (size - 1) for piece, size in pieces(text))
    rows: list[str] = []
    for room in (width, width - 1):  # a word that is too long may be broken in the middle of a sign
        rows = [row.replace(_FILLER, "") for row in _wrap(filled, room, indent, most)]
        if all(cell_len(row) <= width for row in rows):
            break
    return rows


def _begin(text: str, width: int) -> str:
    begin, used = "", 0
    for piece, size in pieces(text):
        used += size
        if used > width:
            break
        begin += piece
    return begin


def _wrap(text: str, width: int, indent: str, most: int | None) -> list[str]:
    return textwrap.wrap(text, max(width, 2), subsequent_indent=indent, max_lines=most, placeholder=" …")
