"""Finds the middle of a source by the signal: a grid of directions, a beam fitted to all of them, and then there."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import fmean

from birdcage.base.geometry import wrap_360
from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG, BeamFit, HeardDirection
from birdcage.signal.ear import Ears, fit_heard, own_tuner
from birdcage.signal.listen import check_number, check_patterns, listen_at, neighbours_in
from birdcage.station.task import ItemTask
from birdcage.station.task_state import TaskValue
from birdcage.tracking.steps import PointAt, Steps, Wait

SIDE = 5
"""Directions in a row of the grid, and rows."""
SPACING = 0.35
"""From one to the next, in widths of the beam: all of them together reach 0.7 widths to each side."""
NO_PEAK = "No source stands out of the floor here. The dish is back in the middle of the grid."
LOST = "The signal could not be read."


@dataclass
class PeakTask(ItemTask[tuple[float, float]]):
    """Goes through a grid about a true direction, row by row, and ends in the middle of the source, or of the grid.

    Angles in degrees; `width_deg` is the width of the beam that is expected, 0 for an unknown one. `patterns` are
    the sources that may be heard beside this one: how far right of it and above it on the sky, one after the other in a
    row; several rows where it is not known which source this is. `partial`: directions
    beyond the limits are left out; else they end it. `source` is the id of what it hears by, empty for the feed's own.
    """

    kind = "peak"
    goes_on = False
    is_unattended = False
    cut_words = "The peak was not found."
    holder: str
    az_deg: float
    el_deg: float
    width_deg: float = 0.0
    patterns: tuple[tuple[float, ...], ...] = ((),)
    partial: bool = False
    source: str = ""
    ears: Ears = field(default=own_tuner, repr=False)
    _heard: list[HeardDirection] = field(default_factory=list, init=False)
    _heard_s: list[float] = field(default_factory=list, init=False)
    """When each direction was heard, POSIX seconds."""
    _fit: BeamFit | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no grid: they may come from another program."""
        check_number("az_deg", self.az_deg, -720.0, 720.0)
        check_number("el_deg", self.el_deg, -85.0, 85.0)
        check_number("width_deg", self.width_deg, 0.0, 60.0)
        check_patterns(self.patterns)
        self._ear = self.ears(self.source)

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Have the source read meanwhile."""
        with self._ear.open():
            yield from super().steps(now_s, asked=asked)

    def items(self) -> Sequence[tuple[float, float]]:
        """Return the directions."""
        return grid_about(self.az_deg, self.el_deg, SIDE, SPACING * (self.width_deg or ASSUMED_WIDTH_DEG))

    def do(self, item: tuple[float, float]) -> Steps:
        """Point there, and read the signal."""
        heard = yield from listen_at(self._ear, *item, optional=self.partial)
        if heard is not None:
            self._heard.append(heard)
            self._heard_s.append((yield Wait(0.0)).now_s)

    def finish(self) -> Steps:
        """Fit, and go to the middle of the source; to that of the grid if there is none."""
        patterns = [neighbours_in(row) for row in self.patterns]
        self._fit = fit_heard(self._heard, self._ear, self.width_deg or None, patterns)
        if self._fit is None:
            yield PointAt(self.az_deg, self.el_deg)
        else:
            yield PointAt(self._fit.az_deg, self._fit.el_deg)

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """The middle of the source, with its standard deviation on the sky, its rise over the floor, and that.

        `utc_s`: the middle of the time of listening, POSIX seconds: the Sun was there then.
        """
        return {} if self._fit is None else {**self._fit.values(), "utc_s": fmean(self._heard_s)}

    @property
    def end_words(self) -> str:
        """Say where the middle is, or that there is none."""
        if self._fit is None:
            return NO_PEAK if self._heard else LOST
        return self._fit.words

    def result(self) -> BeamFit | None:
        """Return the fit; None where there is no source."""
        return self._fit


def grid_about(az_deg: float, el_deg: float, side: int, step_deg: float) -> list[tuple[float, float]]:
    """Return `side` by `side` directions about one: to and fro, so that each is next to the one before."""
    across = step_deg / math.cos(math.radians(el_deg))
    offsets = [each - (side - 1) / 2 for each in range(side)]
    return [
        (wrap_360(az_deg + x * across), el_deg + y * step_deg)
        for row, y in enumerate(offsets)
        for x in (offsets if row % 2 == 0 else reversed(offsets))
    ]
