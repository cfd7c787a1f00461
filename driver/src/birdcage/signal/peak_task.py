"""Finds the middle of a source by the signal: a grid of directions, a beam fitted to all of them, and then there."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from birdcage.base.geometry import wrap_360
from birdcage.rotator.feature import RSSI, Value
from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG, BeamFit, BeamPoint, HeardDirection, beam_points, fit_beam
from birdcage.station.task import ItemTask
from birdcage.tracking.steps import PointAt, ReadFeatures, Steps

SIDE = 5
"""Directions in a row of the grid, and rows."""
SPACING = 0.35
"""From one to the next, in widths of the beam: all of them together reach 0.7 widths to each side."""
READS = 4
"""Readings of the signal in one direction."""
NO_PEAK = "No source stands out of the floor here. The dish is back in the middle of the grid."
LOST = "The signal could not be read."


@dataclass
class PeakTask(ItemTask[tuple[float, float]]):
    """Goes through a grid about a true direction, row by row, and ends in the middle of the source, or of the grid.

    Angles in degrees; `width_deg` is the width of the beam that is expected, 0 for an unknown one.
    """

    kind = "peak"
    goes_on = False
    is_unattended = False
    cut_words = "The peak was not found."
    holder: str
    az_deg: float
    el_deg: float
    width_deg: float = 0.0
    _heard: list[HeardDirection] = field(default_factory=list, init=False)
    _fit: BeamFit | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no grid: they may come from another program."""
        for name, low, high in (("az_deg", -720.0, 720.0), ("el_deg", -85.0, 85.0), ("width_deg", 0.0, 60.0)):
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
                raise TypeError(f"{name} is {value!r}. Give a number from {low:g} to {high:g}")

    def items(self) -> Sequence[tuple[float, float]]:
        """Return the directions: to and fro, so that each is next to the one before."""
        step = SPACING * (self.width_deg or ASSUMED_WIDTH_DEG)
        across = step / math.cos(math.radians(self.el_deg))
        offsets = [each - (SIDE - 1) / 2 for each in range(SIDE)]
        return [
            (wrap_360(self.az_deg + x * across), self.el_deg + y * step)
            for row, y in enumerate(offsets)
            for x in (offsets if row % 2 == 0 else reversed(offsets))
        ]

    def do(self, item: tuple[float, float]) -> Steps:
        """Point there, and read the signal."""
        there = yield PointAt(*item)
        values = []
        for _ in range(READS):
            told = (yield ReadFeatures((RSSI,))).readings.get(RSSI)
            if told is not None:
                values.append(float(told.value))
        if values and there.true_az_deg is not None and there.true_el_deg is not None:
            self._heard.append(HeardDirection(there.true_az_deg, there.true_el_deg, tuple(values)))

    def finish(self) -> Steps:
        """Fit, and go to the middle of the source; to that of the grid if there is none."""
        self._fit = fit_beam(self._points(), self.width_deg or None)
        if self._fit is None:
            yield PointAt(self.az_deg, self.el_deg)
        else:
            yield PointAt(self._fit.az_deg, self._fit.el_deg)

    def _points(self) -> list[BeamPoint]:
        squares = [(value - each.mean) ** 2 for each in self._heard for value in each.values]
        free = len(squares) - len(self._heard)
        return beam_points(self._heard, math.sqrt(sum(squares) / free) if free > 0 else 0.0)

    @property
    def found(self) -> Mapping[str, Value]:
        """The middle of the source, with its standard deviation on the sky, its rise over the floor, and that."""
        fit = self._fit
        if fit is None:
            return {}
        return {
            "az_deg": fit.az_deg, "el_deg": fit.el_deg, "sigma_deg": fit.sigma_deg, "rise": fit.rise,
            "floor": fit.floor, "width_deg": fit.width_deg, "points": fit.points,
        }  # fmt: skip

    @property
    def end_words(self) -> str:
        """Say where the middle is, or that there is none."""
        if self._fit is None:
            return NO_PEAK if self._heard else LOST
        fit = self._fit
        return f"Peak at {fit.az_deg:.2f}°/{fit.el_deg:.2f}° ±{fit.sigma_deg:.2f}°, {fit.rise:.0f} over the floor."

    def result(self) -> BeamFit | None:
        """Return the fit; None where there is no source."""
        return self._fit


SIGNAL_TASKS: Mapping[str, type[ItemTask[tuple[float, float]]]] = {PeakTask.kind: PeakTask}
"""What a station is given so that faces may ask for it (`BeginTask`)."""
