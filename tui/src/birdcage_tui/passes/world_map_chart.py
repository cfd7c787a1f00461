"""The geometry of the world map, and its quiet layers: coast, grid and night, kept from frame to frame."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

from birdcage.base.geometry import shortest_turn
from birdcage.sky.coastline import Line, coastline
from birdcage.sky.terminator import SubSolar

from birdcage_tui.drawing.canvas import Braille

STRETCH = 1.35
"""How much wider or higher than true the map may be, to fill its pane."""
ALMOST_180 = 179.999
"""The right side of the map, which as 180 degrees would be the left one."""
SMALLEST_DOTS = 2.5
"""An island smaller than this would be a blot."""
NIGHT_DEG = 0.25
"""The Sun goes so far in a minute; the night is drawn again then."""


@dataclass(frozen=True, slots=True)
class Chart:
    """An equirectangular map of `width` by `height` cells, Greenwich in the middle."""

    width: int
    height: int

    @classmethod
    def within(cls, width: int, height: int) -> Chart:
        """Return the largest map for a space: as wide as two dots for each one high, or nearly."""
        high = min(height, round(width / 4 * STRETCH))
        return cls(min(width, round(high * 4 * STRETCH)), high)

    def dot(self, latitude_deg: float, longitude_deg: float) -> tuple[float, float]:
        """Return the dot of a place."""
        across = (longitude_deg + 180.0) % 360.0 / 360.0 * self.width * 2
        return across, min((90.0 - latitude_deg) / 180.0 * self.height * 4, self.height * 4 - 1.0)

    def cell(self, latitude_deg: float, longitude_deg: float) -> tuple[int, int]:
        """Return the cell of a place."""
        x, y = self.dot(latitude_deg, longitude_deg)
        return min(math.floor(x / 2), self.width - 1), math.floor(y / 4)

    def place(self, column: int, row: int) -> tuple[float, float] | None:
        """Return latitude and longitude of a cell's middle; None outside the map."""
        if not (0 <= column < self.width and 0 <= row < self.height):
            return None
        return 90.0 - (row + 0.5) / self.height * 180.0, (column + 0.5) / self.width * 360.0 - 180.0

    def along(self, places: Sequence[tuple[float, float]], spacing: float) -> Iterator[tuple[float, float]]:
        """Yield dots along a line of places, `spacing` apart along its flatter axis, so that 1 makes a thin line.

        What leaves at one side comes in at the other.
        """
        across = self.width * 2
        due = 0.0
        for (lat0, lon0), (lat1, lon1) in pairwise(places):
            x, y = self.dot(lat0, lon0)
            dx = shortest_turn(lon0, lon1) / 360.0 * across
            dy = self.dot(lat1, lon1)[1] - y
            length = max(abs(dx), abs(dy))
            while due <= length and length > 0.0:
                yield (x + dx * due / length) % across, y + dy * due / length
                due += spacing
            due -= length


class Layers:
    """Coast and grid, drawn once for a size; and the night over them, once a minute."""

    def __init__(self) -> None:
        self._still: tuple[Chart, Braille] | None = None
        self._dark: tuple[tuple[Chart, int, int], Braille] | None = None

    def draw(self, chart: Chart, sun: SubSolar) -> Braille:
        """Return a canvas with all that is quiet, to be drawn on."""
        key = (chart, round(sun.latitude_deg / NIGHT_DEG), round(sun.longitude_deg / NIGHT_DEG))
        if self._dark is None or self._dark[0] != key:
            canvas = self._coast(chart).copy()
            _night(canvas, chart, sun)
            self._dark = (key, canvas)
        return self._dark[1].copy()

    def _coast(self, chart: Chart) -> Braille:
        if self._still is None or self._still[0] != chart:
            canvas = Braille(chart.width, chart.height)
            for line in coastline():
                if _size_deg(line) * chart.height * 4 / 180.0 < SMALLEST_DOTS:
                    continue
                # From dot to dot: pieces shorter than one would make a thick line of corners.
                dots = [tuple(map(math.floor, chart.dot(lat, min(lon, ALMOST_180)))) for lat, lon in line]
                for (x0, y0), (x1, y1) in pairwise(key for key, _ in groupby(dots)):
                    canvas.line(x0, y0, x1, y1, "line")
            self._still = (chart, canvas)
        return self._still[1]


def _size_deg(line: Line) -> float:
    """Return how far a coast reaches, north to south or east to west."""
    latitudes, longitudes = [lat for lat, _ in line], [lon for _, lon in line]
    south, north = min(latitudes), max(latitudes)
    across = (max(longitudes) - min(longitudes)) * math.cos(math.radians((south + north) / 2.0))
    return max(north - south, across)


def _night(canvas: Braille, chart: Chart, sun: SubSolar) -> None:
    """Fill the night with sparse dots, and draw its edge."""
    for x in range(0, chart.width * 2, 2):
        longitude = (x + 0.5) / (chart.width * 2) * 360.0 - 180.0
        edge = (90.0 - sun.terminator_deg(longitude)) / 180.0 * chart.height * 4
        # The pole that is turned away from the Sun has night up to the edge.
        start, end = (edge, chart.height * 4) if sun.latitude_deg >= 0.0 else (0.0, edge)
        for y in range(1 + x % 4, chart.height * 4, 4):
            if start <= y < end:
                canvas.dot(x, y, "faint")
    meridians = [step * 360.0 / chart.width - 180.0 for step in range(chart.width + 1)]
    for dot in chart.along([(sun.terminator_deg(each), each) for each in meridians], 2.0):
        canvas.dot(*dot, "line")
