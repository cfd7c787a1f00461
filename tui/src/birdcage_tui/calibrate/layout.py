"""How large each part of the Calibrate tab is, from the room under the tabs in cells."""

from __future__ import annotations

from dataclasses import dataclass

ROOMY = (100, 26)
"""From this size on all lists are seen at once."""
GRAND = (150, 38)
"""From this size on both pictures are."""
FRAME = 2
LEAST_SQUARE = 24


@dataclass(frozen=True, slots=True)
class Layout:
    """Sizes in cells, frames included; 0 hides."""

    roomy: bool
    grand: bool
    left: int
    """Width of the pictures and what stands below them."""
    pictures: int
    """Height of the pictures; the figures have the rest of the column."""
    aim: int
    """Height of what is pointed at."""
    signal: int = 0
    peaks: int = 0
    sets: int = 0
    """Heights of these lists; that of the objects takes the rest. Without room the chosen list has all of it."""


def layout(width: int, height: int) -> Layout:
    """Return the layout for so much room; pictures are about as wide as their height makes them square."""
    if width >= GRAND[0] and height >= GRAND[1]:
        pictures = min(height - 14, (width - 64) // 4 + FRAME)
        return Layout(True, True, width - 62, pictures, 11, 7, max(height // 5, 8), 6)
    if width >= ROOMY[0] and height >= ROOMY[1]:
        pictures = height - 13
        return Layout(True, False, min(max(pictures * 2 + 6, LEAST_SQUARE * 2), width - 50), pictures, 10, 0, 8, 5)
    return Layout(False, False, width - 43, height - 7, 10)
