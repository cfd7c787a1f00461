"""How large each part of the Craft tab is, from the tab's own size in cells."""

from __future__ import annotations

from dataclasses import dataclass

ROOMY = (100, 25)
"""From this size on passes, autotrack and radio are always seen."""
VIEWS = ("curves", "passes", "autotrack", "radio")
"""What takes turns where there is no room for all."""
LISTS = ("passes", "autotrack")
FRAME = 2


@dataclass(frozen=True, slots=True)
class TrackLayout:
    """Sizes in cells, frames included; 0 hides."""

    roomy: bool
    head: int
    sky: int
    """Width of the map."""
    now: int
    """Height of the words; the curves have the rest of the column."""
    lower: int
    """Height of passes, autotrack and radio."""
    radio: int = 0
    """Width of the radio beside the two others."""


def layout(width: int, height: int, shown: str = VIEWS[0]) -> TrackLayout:
    """Return the layout of a tab of that size: the map is as wide as its height makes it round.

    `shown` is one of `VIEWS`: lists grow while they are chosen, where there is little room for them.
    """
    roomy = width >= ROOMY[0] and height >= ROOMY[1]
    if not roomy:
        return TrackLayout(False, 3, min(max((height - 3 - FRAME) * 2 + 6, 24), width - 42), 5, 0)
    head, lower = 4, min(max(-(-height // 4), 7 if height < 26 else 8), 14)  # the curves need four rows
    if shown in LISTS:
        lower = max(lower, min(lower + 6, height - head - 14))
    upper = height - head - lower
    sky = min((upper - FRAME) * 2 + 6, width - 56)
    now = 9 + FRAME if upper >= 24 else 5 + FRAME
    return TrackLayout(True, head, sky, now, lower, 44 if width >= 150 else 0)
