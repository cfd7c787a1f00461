"""Big digits, three rows tall. Unknown is `--.--`; the width never changes with the value."""

from __future__ import annotations

from birdcage_tui.canvas import Cells

_GLYPHS = {
    "0": ("╭─╮", "│ │", "╰─╯"),
    "1": ("╶╮ ", " │ ", "╶┴╴"),
    "2": ("╶─╮", "┌─┘", "╰─╴"),
    "3": ("╶─╮", " ─┤", "╶─╯"),
    "4": ("╷ ╷", "╰─┤", "  ╵"),
    "5": ("╭─╴", "╰─╮", "╶─╯"),
    "6": ("╭─╴", "├─╮", "╰─╯"),
    "7": ("╶─┐", "  │", "  ╵"),
    "8": ("╭─╮", "├─┤", "╰─╯"),
    "9": ("╭─╮", "╰─┤", "╶─╯"),
    "-": ("   ", "╶─╴", "   "),
    " ": ("   ", "   ", "   "),
    ".": (" ", " ", "•"),
    "°": ("°", " ", " "),
}
HEIGHT = 3


def angle_text(angle_deg: float | None, places: int) -> str:
    """Return `231.07`, right-aligned with `places` digits before the point; `--.--` when it is not known."""
    width = places + 3
    return ("-" * places + ".--" if angle_deg is None else f"{angle_deg:.2f}").rjust(width)


def width_of(text: str) -> int:
    """Return how many columns `text` takes in big digits."""
    return sum(len(_GLYPHS[char][0]) for char in text)


def put_big(cells: Cells, x: int, y: int, text: str, ink: str, unit_ink: str = "dim") -> int:
    """Draw `text` (digits, point, minus, degree sign). Return the column after it."""
    for char in text:
        glyph = _GLYPHS[char]
        for row, piece in enumerate(glyph):
            cells.put(x, y + row, piece, unit_ink if char == "°" else ink)
        x += len(glyph[0])
    return x
