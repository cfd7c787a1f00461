"""How large each part of the control page is, from the page's own size in cells."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage_tui.control.tape import ROWS

FRAME = 2
ROOMY = (100, 25)
"""From this size on each part has a frame of its own, and the presets are always seen."""


@dataclass(frozen=True, slots=True)
class Sizes:
    """Widths of the columns; heights of what stands in the right one, and of the cable gauge."""

    roomy: bool
    rose: int
    elevation: int
    readout: int
    digits: int
    jog: int
    actions: int
    cable: int


def sizes(width: int, height: int) -> Sizes:
    """Return the sizes: the rose fills its height, the elevation takes half as much, words get the rest."""
    roomy = width >= ROOMY[0] and height >= ROOMY[1]
    cable = (3 if height >= 26 else 2) + FRAME if roomy else 2
    top = height - cable - 1
    right = (57 if width >= 150 else 44) if roomy else 28
    left = width - right
    least = 24 if width >= 120 else 18
    rows = top - FRAME - ROWS
    rose = max(min(rows * 2 + 4 + FRAME, left - least), 20)
    elevation = max(min(left - rose, rows + 12), least)
    if not roomy:
        inside = top - FRAME
        return Sizes(False, rose, left - rose, inside - 7, 3, 1, 3, cable)
    tall = top >= 36
    if top >= 25:
        return Sizes(True, rose, elevation, (8 if tall else 6) + FRAME, 3, 2, 3, cable)
    return Sizes(True, rose, elevation, 6 + FRAME, 3, 1, 2, cable)
