"""Where the parts of the page stand, from its size in cells."""

from __future__ import annotations

from dataclasses import dataclass

VIEWS = ("path", "elevation", "timeline")
"""What a small page shows beside or under its list; `v` goes on to the next."""
ROOMY = (100, 28)


@dataclass(frozen=True, slots=True)
class Layout:
    """Sizes in cells; 0 hides."""

    roomy: bool
    list_width: int
    list_height: int
    plot_height: int
    strip_height: int
    timeline_height: int


def layout(width: int, height: int, shown: str) -> Layout:
    """Return the layout of a page of that size; `shown` is one of `VIEWS`."""
    height -= 1  # the first row
    if width < ROOMY[0] or height + 1 < ROOMY[1]:
        if shown == "path":
            plot = max(min(width - 50, 44), 28)
            return Layout(False, width - plot, height, height, 0, 0)
        lower = max(height * 2 // 5, 8)
        strip, timeline = (lower, 0) if shown == "elevation" else (0, lower)
        return Layout(False, width, height - lower, 0, strip, timeline)
    timeline = min(max(height // 4, 8), 14)
    upper = height - timeline
    strip = min(max(upper // 3, 8), 12)
    listing = min(max(width * 52 // 100, 58), 92)
    return Layout(True, listing, upper, upper - strip, strip, timeline)
