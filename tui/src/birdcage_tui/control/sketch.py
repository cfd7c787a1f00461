"""A horizon while it is being drawn: one height for each column of the picture."""

from __future__ import annotations

from birdcage.sky.horizon import HorizonMask

TOP_DEG = 45.0
"""The picture ends here; a column that is higher already keeps its height until it is drawn over."""
STRAIGHT_DEG = 1e-6
"""A point this near to the straight line between its neighbours is left out."""


class Sketch:
    """Columns from north over east, south and west to north. Only what was drawn over changes."""

    def __init__(self, mask: HorizonMask, columns: int) -> None:
        self._mask = mask
        self.columns = max(columns, 8)
        self.heights = [mask.at(self.azimuth(column)) for column in range(self.columns)]
        """Degrees."""
        self.drawn: set[int] = set()
        """The columns that were drawn over."""

    def azimuth(self, column: int) -> float:
        """Return the true azimuth of the middle of a column."""
        return (column + 0.5) * 360.0 / self.columns

    def put(self, column: int, el_deg: float) -> None:
        """Set a column's height, within 0 and the top of the picture."""
        column %= self.columns
        self.heights[column] = min(max(el_deg, 0.0), TOP_DEG)
        self.drawn.add(column)

    def line(self, start: tuple[int, float], end: tuple[int, float]) -> None:
        """Draw straight from one column and height to another: a mouse jumps over columns."""
        (first, low), (last, high) = start, end
        steps = abs(last - first)
        for step in range(steps + 1):
            part = step / steps if steps else 1.0
            self.put(round(first + (last - first) * part), low + (high - low) * part)

    def mask(self) -> HorizonMask:
        """Return the horizon with what was drawn in place of what stood there; elsewhere the line is as it was."""
        if not self.drawn:
            return self._mask
        half = 180.0 / self.columns
        drawn = [self.azimuth(column) for column in sorted(self.drawn)]
        kept = [
            point for point in self._mask.points
            if not any(abs((point[0] - az_deg + 180.0) % 360.0 - 180.0) <= half for az_deg in drawn)
        ]  # fmt: skip
        # Where the drawing ends, the old line goes on from where it was.
        edges = {(column + by) % self.columns for column in self.drawn for by in (-1, 1)} - self.drawn
        fresh = [self.azimuth(column) for column in sorted(edges | self._corners())]
        points = [(az_deg, self.heights[int(az_deg * self.columns / 360.0)]) for az_deg in fresh]
        return HorizonMask([*kept, *points])

    def _corners(self) -> set[int]:
        """Return the drawn columns that are needed: those on a straight line between their neighbours are not."""
        size = self.columns

        def bent(column: int) -> bool:
            before, after = (column - 1) % size, (column + 1) % size
            if not {before, after} <= self.drawn:
                return True
            straight = (self.heights[before] + self.heights[after]) / 2.0
            return abs(self.heights[column] - straight) > STRAIGHT_DEG

        bends = {column for column in self.drawn if bent(column)}
        # Equally high all round: a line needs two azimuths even so.
        return bends or {0, size // 2}
