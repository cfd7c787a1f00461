"""A cut through the sky along one axis: the level in each direction, a beam fitted to them, and to its middle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import stdev

from birdcage.base.geometry import wrap_360
from birdcage.signal.beam_fit import CUTS, BeamFit, Cut, HeardDirection
from birdcage.signal.ear import Ears, fit_heard, own_tuner
from birdcage.signal.listen import check_number, check_patterns, listen_at, neighbours_in
from birdcage.signal.peak_task import LOST
from birdcage.station.task import ItemTask
from birdcage.station.task_state import TaskValue
from birdcage.tracking.steps import PointAt, Steps

MOST_POINTS = 1000
NO_SOURCE = "No source stands out of the floor on this line."


@dataclass
class SweepTask(ItemTask[tuple[float, float]]):
    """Goes along an axis (`az` or `el`) through a true direction, from one end to the other.

    Angles in degrees, those of azimuth as the dish turns. `go`: it ends in the middle of the source; else, and where
    there is none, in the middle of the line. `width_deg`, `patterns` and `source` as for `PeakTask`.
    What lies beyond the limits is left out.
    """

    kind = "sweep"
    goes_on = False
    is_unattended = False
    cut_words = "The sweep is not complete."
    holder: str
    axis: Cut
    az_deg: float
    el_deg: float
    span_deg: float
    step_deg: float
    width_deg: float = 0.0
    go: bool = False
    patterns: tuple[tuple[float, ...], ...] = ((),)
    source: str = ""
    ears: Ears = field(default=own_tuner, repr=False)
    _heard: list[HeardDirection] = field(default_factory=list, init=False)
    _fit: BeamFit | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no line: they may come from another program."""
        if self.axis not in CUTS:
            raise TypeError(f"axis is {self.axis!r}. Give az or el")
        check_number("az_deg", self.az_deg, -720.0, 720.0)
        check_number("el_deg", self.el_deg, -85.0, 85.0)
        check_number("span_deg", self.span_deg, 0.1, 360.0)
        check_number("step_deg", self.step_deg, 0.05, 90.0)
        check_number("width_deg", self.width_deg, 0.0, 60.0)
        check_patterns(self.patterns)
        if self.span_deg / self.step_deg >= MOST_POINTS:
            raise TypeError(f"a sweep has at most {MOST_POINTS} directions. Give a longer step")
        self._ear = self.ears(self.source)

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Have the source read meanwhile."""
        with self._ear.open():
            yield from super().steps(now_s, asked=asked)

    def items(self) -> Sequence[tuple[float, float]]:
        """Return the directions."""
        steps = round(self.span_deg / self.step_deg)
        ways = [(index - steps / 2) * self.step_deg for index in range(steps + 1)]
        if self.axis == "az":
            return [(wrap_360(self.az_deg + way), self.el_deg) for way in ways]
        return [(self.az_deg, el) for way in ways if abs(el := self.el_deg + way) <= 90.0]

    def do(self, item: tuple[float, float]) -> Steps:
        """Point there, and read the signal."""
        heard = yield from listen_at(self._ear, *item, optional=True)
        if heard is not None:
            self._heard.append(heard)

    def finish(self) -> Steps:
        """Fit, and go to the middle of the source or of the line."""
        self._fit = self._fitted()
        if self._fit is not None and self.go:
            yield PointAt(self._fit.az_deg, self._fit.el_deg)
        else:
            yield PointAt(self.az_deg, self.el_deg, optional=True)

    def _fitted(self) -> BeamFit | None:
        patterns = [neighbours_in(row) for row in self.patterns]
        return fit_heard(self._heard, self._ear, self.width_deg or None, patterns, self.axis)

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """`axis`; `line`: azimuth, elevation, mean, scatter and count of the readings in each direction; then the fit.

        The scatter of a single reading is 0.
        """
        line = tuple(
            (each.az_deg, each.el_deg, each.mean, stdev(each.values) if len(each.values) > 1 else 0.0, len(each.values))
            for each in self._heard
        )
        return {"axis": self.axis, "line": line, **({} if self._fit is None else self._fit.values())}

    @property
    def end_words(self) -> str:
        """Say where the middle is on the line, or that there is none."""
        fit = self._fit
        if fit is None:
            return NO_SOURCE if self._heard else LOST
        axis, deg = ("azimuth", fit.az_deg) if self.axis == "az" else ("elevation", fit.el_deg)
        return (
            f"Peak at {axis} {deg:.2f}° ±{fit.sigma_deg:.2f}°, "
            f"{fit.rise_words} of {fit.floor:.{1 if fit.unit else 0}f}{fit.unit}, {fit.width_deg:.1f}° wide."
        )

    def result(self) -> BeamFit | None:
        """Return the fit; None where there is no source."""
        return self._fit
