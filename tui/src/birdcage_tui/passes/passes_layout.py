"""Where the parts of the page stand, from its size in cells."""

from __future__ import annotations

from dataclasses import dataclass

VIEWS = ("path", "elevation", "figures", "timeline")
"""What a small page shows beside or under its list; a large one shows figures in place of elevation, or not."""
FIGURES = 10
"""Rows that the figures need, with their frame, on a small page; one more on a large one, where they are narrower."""
PATH = 130
"""Columns that a large map of the sky needs with all its figures beside it."""
BESIDE_MAP = 220
"""Columns from which on the list stands beside the map of the world."""
MAP_LIST = 78
"""How wide it is there."""
ROOMY = (100, 28)


@dataclass(frozen=True, slots=True)
class PassesLayout:
    """Sizes in cells; 0 hides."""

    roomy: bool
    list_width: int
    list_height: int
    plot_height: int
    strip_height: int
    timeline_height: int
    figures_height: int = 0


def layout(width: int, height: int, shown: str) -> PassesLayout:
    """Return the layout of a page of that size; `shown` is one of `VIEWS`."""
    height -= 1  # the first row
    if width < ROOMY[0] or height + 1 < ROOMY[1]:
        if shown == "path":
            plot = max(min(width - 50, 44), 28)
            return PassesLayout(False, width - plot, height, height, 0, 0)
        lower = max(height * 2 // 5, 8) if shown != "figures" else FIGURES
        strip, figures, timeline = (lower if shown == each else 0 for each in VIEWS[1:])
        return PassesLayout(False, width, height - lower, 0, strip, timeline, figures)
    timeline = min(max(height // 4, 8), 14)
    upper = height - timeline
    strip = min(max(upper // 3, 8), 12)
    listing = min(max(width * 52 // 100, 58), max(92, width - PATH))
    if shown == "figures":
        return PassesLayout(True, listing, upper, upper - FIGURES - 1, 0, timeline, FIGURES + 1)
    return PassesLayout(True, listing, upper, upper - strip, strip, timeline)
