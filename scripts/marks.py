"""Characters that fonts draw differently, or lack, as shapes: marks, blocks and hatching of one cell."""

from __future__ import annotations

import math
from collections.abc import Callable

WIDE, HIGH = 10, 21
"""One cell, in pixels."""
_RADIUS = 4.2
Draw = Callable[[float, float, str], str]
"""Makes the shape about a middle, in an ink."""


def _disc(radius: float, *, filled: bool, dashes: str = "") -> Draw:
    def draw(x: float, y: float, ink: str) -> str:
        paint = f'fill="{ink}"' if filled else f'fill="none" stroke="{ink}" stroke-width="1.2"{dashes}'
        return f'<circle cx="{x:g}" cy="{y:g}" r="{radius}" {paint}/>'

    return draw


def _polygon(*corners: tuple[float, float]) -> Draw:
    def draw(x: float, y: float, ink: str) -> str:
        points = " ".join(f"{x + dx * _RADIUS:g},{y + dy * _RADIUS:g}" for dx, dy in corners)
        return f'<polygon points="{points}" fill="{ink}"/>'

    return draw


def _strokes(width: float, *lines: tuple[float, float, float, float]) -> Draw:
    def draw(x: float, y: float, ink: str) -> str:
        path = "".join(
            f"M{x + ax * _RADIUS:g} {y + ay * _RADIUS:g}L{x + bx * _RADIUS:g} {y + by * _RADIUS:g}"
            for ax, ay, bx, by in lines
        )
        return f'<path d="{path}" stroke="{ink}" stroke-width="{width}" fill="none"/>'

    return draw


def _together(*parts: Draw) -> Draw:
    return lambda x, y, ink: "".join(part(x, y, ink) for part in parts)


def _moon(x: float, y: float, ink: str) -> str:
    return (
        f'<path d="M{x + 2:g} {y - 4:g}A4.4 4.4 0 1 0 {x + 2:g} {y + 4:g}A5 5 0 0 1 {x + 2:g} {y - 4:g}" fill="{ink}"/>'
    )


def _rays() -> tuple[tuple[float, float, float, float], ...]:
    turns = [math.radians(45 * step) for step in range(8)]
    return tuple((0.75 * math.cos(t), 0.75 * math.sin(t), 1.15 * math.cos(t), 1.15 * math.sin(t)) for t in turns)


_CROSS = ((-0.8, -0.8, 0.8, 0.8), (-0.8, 0.8, 0.8, -0.8))
_SQUARE = ((-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9))
_EDGES = ((-0.9, -0.9, 0.9, -0.9), (0.9, -0.9, 0.9, 0.9), (0.9, 0.9, -0.9, 0.9), (-0.9, 0.9, -0.9, -0.9))
_BARS = ((-0.4, -0.8, -0.4, 0.8), (0, -0.9, 0, 0.9), (0.4, -0.8, 0.4, 0.8))
_HATCH = ((-0.9, -0.3, 0.3, 0.9), (-0.9, -0.9, 0.9, 0.9), (-0.3, -0.9, 0.9, 0.3))
_MARKS: dict[str, Draw] = {
    "●": _disc(3.9, filled=True),
    "○": _disc(3.7, filled=False),
    "◌": _disc(3.7, filled=False, dashes=' stroke-dasharray="1.5 1.8"'),
    "◍": _together(_disc(3.7, filled=False), _strokes(0.9, *_BARS)),
    "◉": _together(_disc(4.4, filled=False), _disc(2.3, filled=True)),
    "◎": _together(_disc(4.4, filled=False), _disc(2.0, filled=False)),
    "✕": _strokes(1.5, *_CROSS),
    "✖": _strokes(2.4, *_CROSS),
    "▲": _polygon((0, -0.95), (1, 0.85), (-1, 0.85)),
    "▼": _polygon((0, 0.95), (1, -0.85), (-1, -0.85)),
    "◀": _polygon((-1, 0), (0.85, -1), (0.85, 1)),
    "▶": _polygon((1, 0), (-0.85, -1), (-0.85, 1)),
    "◆": _polygon((0, -1.1), (0.95, 0), (0, 1.1), (-0.95, 0)),
    "◇": _strokes(1.2, (0, -1.1, 0.95, 0), (0.95, 0, 0, 1.1), (0, 1.1, -0.95, 0), (-0.95, 0, 0, -1.1)),
    "■": _polygon(*_SQUARE),
    "▨": _strokes(1.0, *_EDGES, *_HATCH),
    "☼": _together(_disc(2.2, filled=False), _strokes(1.1, *_rays())),
    "☾": _moon,
}  # fmt: skip
_BLOCKS = {
    "█": ((0, 0, 1, 1),), "▀": ((0, 0, 1, 0.5),), "▄": ((0, 0.5, 1, 0.5),), "▌": ((0, 0, 0.5, 1),),
    "▐": ((0.5, 0, 0.5, 1),), "▘": ((0, 0, 0.5, 0.5),), "▝": ((0.5, 0, 0.5, 0.5),), "▖": ((0, 0.5, 0.5, 0.5),),
    "▗": ((0.5, 0.5, 0.5, 0.5),), "▚": ((0, 0, 0.5, 0.5), (0.5, 0.5, 0.5, 0.5)),
    "▞": ((0.5, 0, 0.5, 0.5), (0, 0.5, 0.5, 0.5)), "▙": ((0, 0, 0.5, 1), (0.5, 0.5, 0.5, 0.5)),
    "▟": ((0.5, 0, 0.5, 1), (0, 0.5, 0.5, 0.5)), "▛": ((0, 0, 1, 0.5), (0, 0.5, 0.5, 0.5)),
    "▜": ((0, 0, 1, 0.5), (0.5, 0.5, 0.5, 0.5)), "▏": ((0, 0, 0.15, 1),), "▕": ((0.85, 0, 0.15, 1),),
    **{char: ((0, 1 - (i + 1) / 8, 1, (i + 1) / 8),) for i, char in enumerate("▁▂▃") },
    "▅": ((0, 0.375, 1, 0.625),), "▆": ((0, 0.25, 1, 0.75),), "▇": ((0, 0.125, 1, 0.875),),
}  # fmt: skip


def mark(char: str, x: float, y: float, ink: str) -> str | None:
    """Return the shape of a character whose cell has its top left corner at (x, y); None for one that is text."""
    if char in _MARKS:
        return _MARKS[char](x + WIDE / 2, y + HIGH / 2, ink)
    if char in _BLOCKS:
        return "".join(
            f'<rect x="{x + left * WIDE:g}" y="{y + top * HIGH:g}" width="{wide * WIDE:g}" height="{high * HIGH:g}" '
            f'fill="{ink}"/>'
            for left, top, wide, high in _BLOCKS[char]
        )
    return None
