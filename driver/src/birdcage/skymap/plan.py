"""Which directions a map has, and in which order the dish goes through them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

MOST_CELLS = 300_000
STRIDES = (8, 4, 2, 1)
"""From coarse to fine: a pass goes through every so many-th column and row that no pass before it has had."""
FEWEST_ACROSS = 4
"""A pass has at least so many columns or rows, else it would be no picture."""
EDGE = 1e-6
"""Part of a step by which the last column may lie beyond the end, as decimal fractions have no exact binary ones."""


class MapFrame(StrEnum):
    """What the two axes of a map are."""

    AZEL = "azel"
    """True azimuth, which may go on beyond 360 or below 0, and elevation."""
    TARGET = "target"
    """Degrees on the sky right of a moving target, and above it."""


class MapOrder(StrEnum):
    """In which order the directions come."""

    COARSE = "coarse"
    """From coarse to fine: wherever it ends, the whole region has been heard."""
    ROWS = "rows"
    """Along azimuth and back, from the lowest elevation upward."""
    COLUMNS = "columns"
    """Along elevation and back, from left to right."""
    SPIRAL = "spiral"
    """From the middle outward."""


@dataclass(frozen=True)
class MapPlan:
    """A grid of directions in equal steps of degrees. Cell 0 is the lowest and leftmost, the next one right of it."""

    x_low_deg: float
    x_high_deg: float
    y_low_deg: float
    y_high_deg: float
    step_deg: float
    order: MapOrder = MapOrder.COARSE
    frame: MapFrame = MapFrame.AZEL
    y_step_deg: float | None = None
    """From row to row, where that differs from the step between columns: other programs' maps have such."""

    def __post_init__(self) -> None:
        """Raise ValueError, with a sentence, for what is no region, or one with too many directions."""
        if not all(map(math.isfinite, (self.x_low_deg, self.x_high_deg, self.y_low_deg, self.y_high_deg))):
            raise ValueError("The region has no ends. Give two angles for each axis: 160:220.")
        for step_deg in (self.step_deg, self.row_step_deg):
            if not 0.0 < step_deg <= 90.0:
                raise ValueError(f"The step is {step_deg:g}°. Give more than 0, and at most 90.")
        if self.x_high_deg < self.x_low_deg or self.y_high_deg < self.y_low_deg:
            raise ValueError("The region ends before it begins. Give the lower angle first: 160:220.")
        if self.x_high_deg - self.x_low_deg > 360.0:
            raise ValueError("The region is wider than 360°.")
        if self.frame is MapFrame.AZEL and not (self.y_low_deg >= -5.0 and self.y_high_deg <= 90.0):
            raise ValueError("Elevation goes from -5 to 90°.")
        if self.cells > MOST_CELLS:
            raise ValueError(f"That makes {self.cells} directions. At most {MOST_CELLS} fit: give a longer step.")

    @property
    def row_step_deg(self) -> float:
        """From row to row."""
        return self.step_deg if self.y_step_deg is None else self.y_step_deg

    @property
    def columns(self) -> int:
        """How many directions lie side by side."""
        return math.floor((self.x_high_deg - self.x_low_deg) / self.step_deg + EDGE) + 1

    @property
    def rows(self) -> int:
        """How many lie above one another."""
        return math.floor((self.y_high_deg - self.y_low_deg) / self.row_step_deg + EDGE) + 1

    @property
    def cells(self) -> int:
        """How many there are."""
        return self.columns * self.rows

    def at(self, cell: int) -> tuple[float, float]:
        """Return where a cell is, in degrees along both axes."""
        row, column = divmod(cell, self.columns)
        return round(self.x_low_deg + column * self.step_deg, 9), round(self.y_low_deg + row * self.row_step_deg, 9)

    @cached_property
    def sequence(self) -> tuple[int, ...]:
        """Every cell once, in the order in which the dish goes through them."""
        return tuple(self._cells())

    def _cells(self) -> Iterator[int]:
        rows, columns = range(self.rows), range(self.columns)
        match self.order:
            case MapOrder.ROWS:
                yield from (row * self.columns + column for row, column in _there_and_back(rows, columns))
            case MapOrder.COLUMNS:
                yield from (row * self.columns + column for column, row in _there_and_back(columns, rows))
            case MapOrder.SPIRAL:
                yield from self._spiral()
            case MapOrder.COARSE:
                yield from self._coarse_to_fine()

    def _coarse_to_fine(self) -> Iterator[int]:
        had: set[int] = set()
        across = max(self.columns, self.rows)
        for stride in STRIDES:
            if stride > 1 and across < FEWEST_ACROSS * stride:
                continue
            for row, column in _there_and_back(range(0, self.rows, stride), range(0, self.columns, stride)):
                cell = row * self.columns + column
                if cell not in had:
                    had.add(cell)
                    yield cell

    def _spiral(self) -> Iterator[int]:
        """Go round square rings, the innermost first, each from its right side on and upward."""
        middle = (self.rows - 1) // 2, (self.columns - 1) // 2

        def place(cell: int) -> tuple[int, float]:
            row, column = divmod(cell, self.columns)
            up, right = row - middle[0], column - middle[1]
            return max(abs(up), abs(right)), math.atan2(up, right) % math.tau

        yield from sorted(range(self.cells), key=place)

    def values(self) -> dict[str, float | str]:
        """Return all by name, as a file keeps it."""
        return {
            "x_low_deg": self.x_low_deg, "x_high_deg": self.x_high_deg, "y_low_deg": self.y_low_deg,
            "y_high_deg": self.y_high_deg, "step_deg": self.step_deg, "order": self.order.value,
            "frame": self.frame.value, **({} if self.y_step_deg is None else {"y_step_deg": self.y_step_deg}),
        }  # fmt: skip

    @classmethod
    def of(cls, values: dict[str, object]) -> MapPlan:
        """Return the plan that `values` told. ValueError for anything else."""
        try:
            numbers = {name: float(str(value)) for name, value in values.items() if name.endswith("_deg")}
            return cls(**numbers, order=MapOrder(str(values["order"])), frame=MapFrame(str(values["frame"])))
        except (KeyError, TypeError) as error:
            raise ValueError(f"It tells no region: {error}.") from error


def _there_and_back(outer: range, inner: range) -> Iterator[tuple[int, int]]:
    for turn, one in enumerate(outer):
        yield from ((one, other) for other in (inner if turn % 2 == 0 else reversed(inner)))
