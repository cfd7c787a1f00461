"""How large each part of the control page is, from the page's own size in cells."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage_tui.control.tape import ROWS

FRAME = 2
ROOMY = (100, 24)
"""From this size on each part has a frame of its own, and the presets are always seen."""


WITH_ARC = 5
"""Rows of the third axis with its arc; below it a row is left free."""


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
    skew: int = 0
    """Height of the third axis; 0 for a dish without it."""
    upper: int = 0
    """Height of elevation and hands, over the presets; 0 where the presets take turns with them."""
    log: int = 0
    """Width of the log beside the presets; 0 where there is no room for one."""
    horizon: int = 1
    """Height of its keys, and of what it is where there is a second row."""


def sizes(width: int, height: int, *, with_skew: bool = False) -> Sizes:
    """Return the sizes: the rose fills its height; beside it elevation and hands, and under both the presets."""
    roomy = width >= ROOMY[0] and height >= ROOMY[1]
    cable = (3 if height >= 34 else 2) + FRAME if roomy else 2
    top = height - cable - 1
    least = 24 if width >= 120 else 18
    rows = top - FRAME - ROWS
    if not roomy:
        left = width - 28
        rose = max(min(rows * 2 + 4 + FRAME, left - least), 20)
        skew = 1 if with_skew else 0
        actions = 3 - skew  # a dish with a third axis has no speed setting: that row is of no use
        return Sizes(False, rose, left - rose, top - FRAME - 8, 3, 1, actions, cable, skew)
    rose = max(min(rows * 2 + 4 + FRAME, width - 44 - least), 20)
    side = width - rose
    right = 57 if side >= 57 + 40 else 44
    readout = (8 if top >= 36 and right == 57 else 6) + FRAME
    digits, jog, actions = (4, 3, 4) if top >= 36 else (3, 2, 3) if top >= 25 else (3, 1, 2)
    skew = 0 if not with_skew else WITH_ARC if top >= 36 and right == 57 else 2
    if with_skew and top < 25:
        actions -= 1  # it has no speed setting
    horizon = 2 if top >= 25 else 1
    air = 1 if skew >= WITH_ARC else 0
    upper = readout + digits + skew + air + jog + actions + horizon + FRAME
    log = side - right if side >= 80 else 0
    return Sizes(True, rose, side - right, readout, digits, jog, actions, cable, skew, upper, log, horizon)
