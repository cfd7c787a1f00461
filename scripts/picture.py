"""Draw a screen of cells as SVG, as a terminal does: lines that join, dots that are round, text in its cells."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from itertools import groupby
from typing import TYPE_CHECKING

from birdcage_tui.drawing.cell_text import pieces as pieces_of
from marks import HIGH, WIDE, mark

if TYPE_CHECKING:
    from rich.style import Style

FONT = "'IBM Plex Mono', Menlo, Consolas, monospace"
FONT_SIZE = WIDE / 0.6
CELL_ASPECT = HIGH / WIDE
"""What a terminal would tell of its characters: circles are round in pictures too."""
MARGIN = 14
_ARMS = {"─": "LR", "━": "LR", "│": "UD", "├": "UDR", "┤": "UDL", "┬": "LRD", "┴": "LRU", "┼": "LRUD"}
_ARMS |= {"┌": "RD", "┐": "LD", "└": "RU", "┘": "LU", "╶": "R", "╴": "L", "╷": "D", "╵": "U"}
_ROUND = {"╭": "RD", "╮": "LD", "╰": "RU", "╯": "LU"}
_EDGE = {"L": (0, HIGH / 2), "R": (WIDE, HIGH / 2), "U": (WIDE / 2, 0), "D": (WIDE / 2, HIGH)}
_DOTS = ((0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (0, 3), (1, 3))


def _colours(style: Style | None, ground: str) -> tuple[str, str, bool]:
    """Return ink, ground and weight of a cell."""
    if style is None:
        return ground, ground, False
    ink = style.color.get_truecolor().hex if style.color is not None else "#c0c0c0"
    back = style.bgcolor.get_truecolor().hex if style.bgcolor is not None else ground
    return (back, ink, bool(style.bold)) if style.reverse else (ink, back, bool(style.bold))


def _shape(char: str, x: float, y: float, ink: str) -> str | None:
    """Return a character that fonts draw badly as a shape; None for one that is text."""
    middle = (x + WIDE / 2, y + HIGH / 2)
    stroke = f'stroke="{ink}" stroke-width="{2.6 if char == "━" else 1.3}" fill="none"'
    if char in _ARMS:
        ends = [_EDGE[arm] for arm in _ARMS[char]]
        path = "".join(f"M{middle[0]} {middle[1]}L{x + dx} {y + dy}" for dx, dy in ends)
        return f'<path d="{path}" {stroke}/>'
    if char in _ROUND:
        (ax, ay), (bx, by) = (_EDGE[arm] for arm in _ROUND[char])
        bend = by + (HIGH / 2 - by) * 0.52
        path = f"M{x + ax} {y + ay}Q{middle[0]} {middle[1]} {x + bx} {y + bend}L{x + bx} {y + by}"
        return f'<path d="{path}" {stroke}/>'
    if "\u2800" <= char[:1] <= "\u28ff":
        bits = ord(char) - 0x2800
        return "".join(
            f'<circle cx="{x + WIDE * (0.25 + 0.5 * column):g}" cy="{y + HIGH * (0.125 + 0.25 * row):g}" '
            f'r="1.45" fill="{ink}"/>'
            for bit, (column, row) in enumerate(_DOTS)
            if bits >> bit & 1
        )
    return mark(char, x, y, ink)


def _by_cell(text: str) -> list[str]:
    """Return what stands in each cell: nothing in the second one of a wide sign."""
    return [each for piece, width in pieces_of(text) for each in (piece, "")[:width]]


Cell = tuple[str, str, str, bool]
"""A character (none in the second cell of a wide one), its ink, its ground, and whether it is bold."""


def cells_of(pieces: Iterable[tuple[str, Style | None]], ground: str) -> list[Cell]:
    """Return a row of texts with their styles cell by cell."""
    return [(char, *_colours(style, ground)) for text, style in pieces for char in _by_cell(text)]


def draw_row(row: int, cells: Sequence[Cell], ground: str) -> tuple[list[str], list[str], list[str]]:
    """Return what lies behind a row, its shapes and its texts; spaces on `ground` are nothing."""
    backs, shapes, texts, y = [], [], [], row * HIGH
    x = 0
    for back, group in groupby(cells, key=lambda cell: cell[2]):
        count = len(list(group))
        if back != ground:
            backs.append(f'<rect x="{x * WIDE}" y="{y}" width="{count * WIDE}" height="{HIGH}" fill="{back}"/>')
        x += count
    word, start, look = "", 0, ("", False)
    for column, (char, ink, _, bold) in enumerate([*cells, (" ", "", "", False)]):
        shape = None if char == " " else _shape(char, column * WIDE, y, ink)
        if word and (char == " " or shape is not None or (ink, bold) != look):
            weight = ' font-weight="bold"' if look[1] else ""
            texts.append(
                f'<text x="{start * WIDE}" y="{y + HIGH * 0.74:g}" fill="{look[0]}"{weight} '
                f'textLength="{(column - start) * WIDE}">{escape(word)}</text>'
            )
            word = ""
        if shape is not None:
            shapes.append(shape)
        elif char != " ":
            if not word:
                start, look = column, (ink, bold)
            word += char
    return backs, shapes, texts


def frame(width: int, height: int, ground: str, inside: Iterable[str]) -> str:
    """Return a picture of `width` x `height` cells around what is drawn inside."""
    wide, high = width * WIDE + 2 * MARGIN, height * HIGH + 2 * MARGIN
    return "\n".join(
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" viewBox="0 0 {wide} {high}">',
            f'<rect width="100%" height="100%" rx="8" fill="{ground}"/>',
            f'<g transform="translate({MARGIN} {MARGIN})" font-family="{FONT}" font-size="{FONT_SIZE:.3f}">',
            *inside,
            "</g></svg>\n",
        )
    )


def svg(rows: Sequence[Iterable[tuple[str, Style | None]]], ground: str) -> str:
    """Return the picture of `rows`, each a sequence of texts with their styles."""
    grid = [cells_of(pieces, ground) for pieces in rows]
    drawn = [draw_row(row, cells, ground) for row, cells in enumerate(grid)]
    inside = [part for layer in zip(*drawn, strict=True) for parts in layer for part in parts]
    return frame(max(map(len, grid), default=0), len(grid), ground, inside)


def png(picture: str) -> bytes:
    """Return an SVG as pixels. Its text needs a font, which comes with the development tools."""
    import fontpkg_ibm_plex_mono as plex
    import resvg_py

    files = [str(plex.ROOT / "files" / f"IBMPlexMono-{weight}.ttf") for weight in ("Regular", "Bold")]
    return bytes(resvg_py.svg_to_bytes(svg_string=picture, font_files=files, font_family=plex.FAMILY))
