"""The picture of a map in cells: its levels in colours or glyphs, and what lies on top with the level as its ground."""

from __future__ import annotations

from typing import TYPE_CHECKING

from birdcage_tui.drawing.canvas import Cells
from birdcage_tui.signal.map_inks import glyph, over, pair
from birdcage_tui.signal.map_overlay import MapOverlay
from birdcage_tui.signal.map_raster import LEVELS, UNKNOWN

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

HALF = "▀"
EMPTY_SIGN, EMPTY_EVERY = "·", 4
"""Where nothing was heard: one dot in so many columns, which no level looks like."""


class MapSurface:
    """Rows of signs and inks that are made once and copied for each frame; `levels` has two rows for each of them."""

    def __init__(self, levels: NDArray[np.int16], *, plain: bool, ascii_only: bool) -> None:
        """`plain`: colours can't tell levels, so that glyphs do, one a cell."""
        self.height, self.width = levels.shape[0] // 2, levels.shape[1]
        self.plain = plain
        upper, lower = levels[0::2].tolist(), levels[1::2].tolist()
        self._ground: list[list[int]] = _grounds(levels).tolist()
        """The level under what is written on a cell: that of the louder half, or of the only one that was heard."""
        self._chars: list[list[str]] = []
        self._inks: list[list[str]] = []
        for y, (top, low) in enumerate(zip(upper, lower, strict=True)):
            chars, inks = self._glyphs(y, ascii_only=ascii_only) if plain else self._halves(y, top, low)
            self._chars.append(chars)
            self._inks.append(inks)

    def _halves(self, y: int, top: list[int], low: list[int]) -> tuple[list[str], list[str]]:
        chars = [" " if one == other else HALF for one, other in zip(top, low, strict=True)]
        inks = list(map(pair, top, low))
        for x in range(y % 2 * EMPTY_EVERY // 2, self.width, EMPTY_EVERY):
            if top[x] == UNKNOWN == low[x]:
                chars[x], inks[x] = EMPTY_SIGN, "faint"
        return chars, inks

    def _glyphs(self, y: int, *, ascii_only: bool) -> tuple[list[str], list[str]]:
        ground = self._ground[y]
        chars = [glyph(level, ascii_only=ascii_only) for level in ground]
        return chars, ["text" if UNKNOWN < level < LEVELS else "faint" for level in ground]

    def copy(self) -> MapSurface:
        """Return an equal one that may be drawn on."""
        twin = object.__new__(MapSurface)
        twin.height, twin.width, twin.plain, twin._ground = self.height, self.width, self.plain, self._ground
        twin._chars = [list(row) for row in self._chars]
        twin._inks = [list(row) for row in self._inks]
        return twin

    def lay(self, overlay: MapOverlay) -> None:
        """Lay on it what is as wide and high."""
        for (x, y), (sign, ink) in overlay.signs.items():
            self._chars[y][x] = sign
            self._inks[y][x] = ink if self.plain else over(ink, self._ground[y][x])

    def onto(self, cells: Cells, x: int, y: int) -> None:
        """Put the picture into cells, with its top left corner there."""
        for row in range(self.height):
            cells.put_row(x, y + row, self._chars[row], self._inks[row])


def _grounds(levels: NDArray[np.int16]) -> NDArray[np.int16]:
    import numpy as np

    upper, lower = levels[0::2], levels[1::2]
    upper_heard, lower_heard = ((each > UNKNOWN) & (each < LEVELS) for each in (upper, lower))
    one = np.where(upper_heard, upper, lower)
    ground: NDArray[np.int16] = np.where(upper_heard == lower_heard, np.maximum(upper, lower), one)
    return ground
