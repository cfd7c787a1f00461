"""Big digits, three rows tall, or five where there is room.

Unknown is `--.--`; the width never changes with the value.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise

from birdcage_tui.drawing.canvas import Cells

_GLYPHS = {
    "0": ("╭─╮", "│ │", "╰─╯"),
    "1": ("╶╮ ", " │ ", "╶┴╴"),
    "2": ("╶─╮", "┌─┘", "╰─╴"),
    "3": ("╶─╮", " ─┤", "╶─╯"),
    "4": ("╷ ╷", "╰─┤", "  ╵"),
    "5": ("╭─╴", "╰─╮", "╶─╯"),
    "6": ("╭─╴", "├─╮", "╰─╯"),
    "7": ("╶─┐", "  │", "  ╵"),
    "8": ("╭─╮", "├─┤", "╰─╯"),
    "9": ("╭─╮", "╰─┤", "╶─╯"),
    "-": ("   ", "╶─╴", "   "),
    " ": ("   ", "   ", "   "),
    ".": (" ", " ", "•"),
    "°": ("°", " ", " "),
}
_SEGMENTS = {
    "0": "abcdef", "1": "bc", "2": "abged", "3": "abgcd", "4": "fgbc", "5": "afgcd", "6": "afgedc", "7": "abc",
    "8": "abcdefg", "9": "abcdfg", "-": "g", " ": "",
}  # fmt: skip
"""Which of the seven segments burn, for plain ASCII: a top, then clockwise to f, g in the middle."""
_ASIDE = {".": (" ", " ", "."), "°": ("o", " ", " ")}
_RIGHT, _LEFT = "╭╰─├╶┌└┴┬", "╮╯─┤╴┐┘┴┬"
_DOWN, _UP = "╭╮│├┤╷┌┐", "╰╯│├┤╵└┘┴"


def angle_text(angle_deg: float | None, places: int) -> str:
    """Return `231.07`, right-aligned with `places` digits before the point; `--.--` when it is not known."""
    width = places + 3
    return ("-" * places + ".--" if angle_deg is None else f"{angle_deg:.2f}").rjust(width)


def width_of(text: str, *, large: bool = False) -> int:
    """Return how many columns `text` takes in big digits."""
    return sum(len(_glyph(char, large=large)[0]) for char in text)


def _glyph(char: str, *, large: bool) -> tuple[str, ...]:
    return _stretched(char) if large else _GLYPHS[char]


@cache
def _burning(char: str, *, large: bool) -> tuple[str, ...]:
    """Return the glyph in `_` and `|`, as large as the one in lines."""
    if char in _ASIDE:
        top, middle, low = _ASIDE[char]
        return (top, " ", middle, " ", low) if large else (top, middle, low)
    on, wide = _SEGMENTS[char], 3 if large else 1

    def row(left: str, line: str, right: str) -> str:
        return ("|" if left in on else " ") + ("_" if line in on else " ") * wide + ("|" if right in on else " ")

    rows = [" " + ("_" if "a" in on else " ") * wide + " ", row("f", "g", "b"), row("e", "d", "c")]
    return (rows[0], row("f", "?", "b"), rows[1], row("e", "?", "c"), rows[2]) if large else tuple(rows)


@cache
def _stretched(char: str) -> tuple[str, ...]:
    """Return the glyph five rows tall and, unless it is one column wide, five wide: its lines drawn out."""
    rows = []
    for row in _GLYPHS[char]:
        wide = row[0]
        for left, right in pairwise(row):
            wide += ("─" if left in _RIGHT and right in _LEFT else " ") + right
        rows.append(wide)
    tall = [rows[0]]
    for upper, lower in pairwise(rows):
        tall.append("".join("│" if a in _DOWN and b in _UP else " " for a, b in zip(upper, lower, strict=True)))
        tall.append(lower)
    return tuple(tall)


def put_big(cells: Cells, x: int, y: int, text: str, ink: str, *, large: bool = False) -> int:
    """Draw `text` (digits, point, minus, degree sign). Return the column after it."""
    for char in text:
        glyph = _burning(char, large=large) if cells.glyphs == "ascii" else _glyph(char, large=large)
        for row, piece in enumerate(glyph):
            cells.put(x, y + row, piece, "dim" if char == "°" else ink)
        x += len(glyph[0])
    return x
