"""What is written and drawn on a map, before it is known which level lies beneath."""

from __future__ import annotations

from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.drawing.cell_text import pieces


class MapOverlay:
    """Signs by column and row, each with the name of its ink: kept while the levels beneath change."""

    def __init__(self, width: int, height: int) -> None:
        self.width, self.height = width, height
        self.signs: dict[tuple[int, int], tuple[str, str]] = {}
        self._taken: set[tuple[int, int]] = set()

    def put(self, x: int, y: int, text: str, ink: str) -> None:
        """Write on the picture, clipped at its edges; no line goes over it, and `is_free` knows it."""
        for sign, width in pieces(text):
            if width == 1 and 0 <= y < self.height and 0 <= x < self.width:
                self.signs[x, y] = (sign, ink)
                self._taken.add((x, y))
            x += width

    def lines(self, canvas: Braille) -> None:
        """Lay dots on the picture, beside what is written."""
        self.signs.update(((x, y), (sign, ink)) for x, y, sign, ink in canvas.signs() if (x, y) not in self._taken)

    def is_free(self, x: int, y: int, length: int) -> bool:
        """Return whether nothing is written on these cells, which lie in the picture."""
        inside = 0 <= y < self.height and x >= 0 and x + length <= self.width
        return inside and self._taken.isdisjoint((column, y) for column in range(x, x + length))
