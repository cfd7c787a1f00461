"""What a terminal's size means for the layout: classes that the style sheets go by."""

from __future__ import annotations

POCKET_TALL = 20
"""From so many rows on the pocket view's buttons are three rows tall."""


def is_tiny(width: int, height: int) -> bool:
    """Return whether the pocket view stands in for every page."""
    return width < 80 or height < 24


def size_classes(width: int, height: int) -> dict[str, bool]:
    """Return each class of the screen, and whether it holds: one size may need both its width and its height."""
    tiny = is_tiny(width, height)
    return {
        "-tiny": tiny,
        "-thumb": tiny and height >= POCKET_TALL,
        "-wide": width >= 100 and height >= 30,
        "-grand": width >= 150,
        "-tall": height >= 44,
    }
