"""Glyph sets: `braille` as drawn, `block` for fonts without braille, `ascii` for a serial terminal.

Everything is drawn once, in the richest set. The other two are a table of characters that is laid over finished rows,
frames and Textual's own widgets included; `braille` costs nothing.
"""

from __future__ import annotations

import codecs
import locale
import sys
import unicodedata
from collections.abc import Mapping

from rich.cells import cell_len
from rich.segment import Segment
from textual.color import Color
from textual.filter import LineFilter

SETS = ("braille", "block", "ascii")
POOR_TERMINALS = ("linux", "vt", "dumb", "ansi", "cons")
"""Beginnings of `TERM` whose fonts hold no braille, and often no lines either."""
_BRAILLE = 0x2800
_LEFT, _RIGHT = (0x01, 0x02, 0x04, 0x40), (0x08, 0x10, 0x20, 0x80)
"""A braille cell's bits, from the top."""
_QUADRANTS = " ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█"
"""By the sum of 1 top left, 2 top right, 4 bottom left, 8 bottom right."""
_ONE_ROW = {0: ("'", '"'), 1: ("'", "-"), 2: (".", "-"), 3: (".", "_")}
"""A cell with dots in one row only: one dot, two dots."""
_SIGNS = {
    **dict(zip("●○•◉✕✖▨■▲▼◀▶✓◍◌☼☾★◐", "*Oo@Xx%!^v<>V?&$Cfc", strict=True)),
    **dict(zip("─━═╌┄╎╏│┃║▕▏╭╮╰╯", "-==--::|||||..''", strict=True)),
    **dict(zip("▔▁▂▃▄▅▆▇█▀▌▐░▒▓", '-_.-=+*##"[]:%#', strict=True)),
    **dict(zip("←→↑↓↔↕°·…×±µ–—‘’“”≤≥−✗", "<>^v-|d.~x~u--''\"\"<>-x", strict=True)),
    **dict.fromkeys("▎▍▋▊▉", "|"),
    "🔎": "/ ",
    "◆": "o",
    "◎": "0",
}
"""A state's signs stay different from each other; arrows and triangles that point the same way are the same."""


def _dots(bits: int) -> tuple[list[int], list[int]]:
    """Return the rows of the dots in the left and in the right half of a braille cell."""
    return [row for row in range(4) if bits & _LEFT[row]], [row for row in range(4) if bits & _RIGHT[row]]


def quadrants_for(bits: int) -> str:
    """Return the block character whose quarters hold these braille dots."""
    left, right = _dots(bits)
    halves = ((1, left, (0, 1)), (2, right, (0, 1)), (4, left, (2, 3)), (8, right, (2, 3)))
    return _QUADRANTS[sum(value for value, dots, rows in halves if any(row in rows for row in dots))]


def ascii_for(bits: int) -> str:
    """Return the ASCII character that looks most like these braille dots."""
    left, right = _dots(bits)
    rows, count = {*left, *right}, len(left) + len(right)
    if not count:
        return " "
    if len(rows) == 1:
        return _ONE_ROW[rows.pop()][count - 1]
    if not (left and right):
        return "|" if count >= 3 else ":"
    slope = sum(left) / len(left) - sum(right) / len(right)
    if abs(slope) >= 1:
        return "/" if slope > 0 else "\\"
    if count >= 6:
        return "#" if count >= 7 else "*"
    return "+" if len(rows) >= 3 else "-" if rows == {1, 2} else ":"


class _Ascii(dict[int, str]):
    """Any character to ASCII of the same width: accents are dropped, what has no likeness is a question mark."""

    def __missing__(self, code: int) -> str:
        char = chr(code)
        plain = "".join(part for part in unicodedata.normalize("NFKD", char) if " " <= part < "\x7f")
        width = cell_len(char)
        if "BOX DRAWINGS" in unicodedata.name(char, ""):
            plain = "+"
        self[code] = char if code < 0x7F else plain if len(plain) == width else "?" * width
        return self[code]


_BLOCK = {_BRAILLE + bits: quadrants_for(bits) for bits in range(256)}
_ASCII = _Ascii({ord(char): sign for char, sign in _SIGNS.items()})
_ASCII.update({_BRAILLE + bits: ascii_for(bits) for bits in range(256)})


def translate(text: str, glyphs: str) -> str:
    """Return `text` in that glyph set, as many cells wide as before."""
    if glyphs == "braille" or text.isascii():
        return text
    return text.translate(_BLOCK if glyphs == "block" else _ASCII)


class GlyphFilter(LineFilter):
    """Puts finished rows into another glyph set."""

    def __init__(self, glyphs: str) -> None:
        super().__init__(enabled=glyphs != "braille")
        self._glyphs = glyphs

    def apply(self, segments: list[Segment], _background: Color) -> list[Segment]:
        """Return the same row in the set's characters."""
        return [Segment(translate(text, self._glyphs), style, control) for text, style, control in segments]


def fitting(environ: Mapping[str, str], encoding: str | None = None) -> str:
    """Return the set for a terminal without a chosen one: `ascii` unless it takes UTF-8 and is no poor one.

    `encoding` is by default the locale's, and what stdout was told to use. The set `block` is never guessed.
    """
    encodings = [encoding] if encoding else [locale.getencoding(), getattr(sys.stdout, "encoding", None) or "utf-8"]
    try:
        utf8 = all(codecs.lookup(name).name == "utf-8" for name in encodings)
    except LookupError:
        utf8 = False
    poor = environ.get("TERM", "").startswith(POOR_TERMINALS)
    return "braille" if utf8 and not poor else "ascii"
