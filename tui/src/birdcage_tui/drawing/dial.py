"""What round pictures share: how wide a dot is, and how large a circle fits."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage_tui.drawing.terminal_cells import ASPECT


@dataclass(frozen=True, slots=True)
class Dial:
    """A round picture in the middle of `width` by `height` cells."""

    width: int
    height: int
    aspect: float = ASPECT
    """Height over width of a cell."""

    @property
    def dot_aspect(self) -> float:
        """Height over width of a dot: a cell is 2 dots wide and 4 tall."""
        return self.aspect / 2.0

    @property
    def radius(self) -> float:
        """Widths of a dot from the middle to the rim."""
        return max(4.0, min(self.width * 2 - 8, (self.height * 4 - 4) * self.dot_aspect) / 2)
