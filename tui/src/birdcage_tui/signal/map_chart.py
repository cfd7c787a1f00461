"""Where the directions of a map stand in its picture: degrees to columns and rows of cells, and back."""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.skymap.plan import MapFrame, MapPlan

MOST_STRETCH = {MapFrame.AZEL: 3.0, MapFrame.TARGET: 1.3}
"""How much longer a degree may be along one axis than along the other."""
NICE = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0)


@dataclass(frozen=True, slots=True)
class MapChart:
    """A picture of `width` columns and `height` rows of cells. `x` and `y` count cells from its top left corner."""

    plan: MapPlan
    width: int
    height: int

    @classmethod
    def within(cls, plan: MapPlan, width: int, height: int, aspect: float) -> MapChart:
        """Return the largest one that fits; `aspect`: how much taller than wide a cell is."""
        most = MOST_STRETCH[plan.frame]
        across, up = width / plan.columns, height * aspect / plan.rows
        wide, tall = min(across, up * most), min(up, across * most)
        return cls(plan, max(round(wide * plan.columns), 1), max(round(tall * plan.rows / aspect), 1))

    @property
    def left_deg(self) -> float:
        """The left edge, half a step before the first column."""
        return self.plan.x_low_deg - self.plan.step_deg / 2.0

    @property
    def low_deg(self) -> float:
        """The lower edge, half a step under the lowest row."""
        return self.plan.y_low_deg - self.plan.row_step_deg / 2.0

    @property
    def wide_deg(self) -> float:
        """From the left edge to the right one."""
        return self.plan.columns * self.plan.step_deg

    @property
    def tall_deg(self) -> float:
        """From the lower edge to the upper one."""
        return self.plan.rows * self.plan.row_step_deg

    def unrolled(self, az_deg: float) -> float:
        """Return an azimuth as the map counts it, which may be beyond 360: the nearest to its middle."""
        if self.plan.frame is MapFrame.TARGET:
            return az_deg
        middle = self.left_deg + self.wide_deg / 2.0
        return middle + (az_deg - middle + 180.0) % 360.0 - 180.0

    def x(self, deg: float) -> float:
        """Return the column of an angle along the first axis, as the map counts it."""
        return (deg - self.left_deg) / self.wide_deg * self.width

    def y(self, deg: float) -> float:
        """Return the row of an angle along the second axis."""
        return (1.0 - (deg - self.low_deg) / self.tall_deg) * self.height

    def spot(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return column and row of a direction."""
        return self.x(self.unrolled(az_deg)), self.y(el_deg)

    def holds(self, x: float, y: float) -> bool:
        """Return whether a spot lies in the picture."""
        return 0.0 <= x < self.width and 0.0 <= y < self.height

    def cell(self, x: float, y: float) -> int | None:
        """Return the map's cell at a spot; None outside."""
        if not self.holds(x, y):
            return None
        column = min(int(x / self.width * self.plan.columns), self.plan.columns - 1)
        row = min(int((1.0 - y / self.height) * self.plan.rows), self.plan.rows - 1)
        return row * self.plan.columns + column

    def spot_of(self, cell: int) -> tuple[float, float]:
        """Return the middle of a cell of the map."""
        x_deg, y_deg = self.plan.at(cell)
        return self.x(x_deg), self.y(y_deg)

    def x_ticks(self, apart: int) -> list[float]:
        """Return round angles along the first axis, at least so many columns apart."""
        return _ticks(self.left_deg, self.left_deg + self.wide_deg, self.width / max(apart, 1))

    def y_ticks(self, apart: int) -> list[float]:
        """Return round angles along the second axis, at least so many rows apart."""
        return _ticks(self.low_deg, self.low_deg + self.tall_deg, self.height / max(apart, 1))

    def x_text(self, deg: float) -> str:
        """Return how an angle along the first axis is written."""
        return _offset(deg) if self.plan.frame is MapFrame.TARGET else f"{round(deg % 360.0, 6):g}°"

    def y_text(self, deg: float) -> str:
        """Return how an angle along the second axis is written."""
        return _offset(deg) if self.plan.frame is MapFrame.TARGET else f"{round(deg, 6):g}°"


def _offset(deg: float) -> str:
    return f"{deg:+g}°" if deg else "0°"


def _ticks(low: float, high: float, most: float) -> list[float]:
    step = next((each for each in NICE if (high - low) / each <= most), 180.0)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [round(index * step, 6) for index in range(first, last + 1)]
