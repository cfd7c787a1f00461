"""Lets the sky pass: the dish rests where a source will be, hears it come and go, and tells how far off it looks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import fmean, stdev

from birdcage.base.geometry import shortest_turn
from birdcage.signal.beam_fit import BeamFit, HeardDirection
from birdcage.signal.ear import Ears, fit_heard, own_tuner
from birdcage.signal.listen import check_number
from birdcage.signal.peak_task import LOST
from birdcage.signal.source_path import SourcePath
from birdcage.station.task import ItemTask
from birdcage.station.task_state import TaskValue
from birdcage.tracking.steps import PointAt, Steps, Wait

WIDTHS = 3.0
"""So many widths of the beam pass by."""
POINTS = 120
SLOWEST_DEG_S = 0.02 / 60.0
"""What moves no faster stands still: a geostationary satellite."""
MOST_S = 6.0 * 3600.0
PASSED_BY = "No source went through the beam."


@dataclass
class DriftTask(ItemTask[float]):
    """Rests where `path` (rows as for `SourcePath`) is in the middle of its time, and listens to its end.

    `width_deg` is the width of the beam that is expected, 0 for an unknown one. `source` as for `PeakTask`.
    """

    kind = "drift"
    goes_on = False
    is_unattended = False
    cut_words = "The drift scan is not complete."
    holder: str
    path: tuple[tuple[float, ...], ...]
    width_deg: float = 0.0
    source: str = ""
    ears: Ears = field(default=own_tuner, repr=False)
    _line: list[tuple[float, tuple[float, ...]]] = field(default_factory=list, init=False)
    """How far the source had gone past the dish, in degrees, and the readings there."""
    _fit: BeamFit | None = field(default=None, init=False)

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no drift scan."""
        check_number("width_deg", self.width_deg, 0.0, 60.0)
        self._path = SourcePath.of(self.path)
        self._length_s = self._path.end_s - self._path.begin_s
        self._middle_s = (self._path.end_s + self._path.begin_s) / 2.0
        if not 1.0 <= self._length_s <= MOST_S:
            raise TypeError(f"the path is {self._length_s:.0f} s long. Give 1 to {MOST_S:.0f} s")
        if self._path.moves_deg_s(self._middle_s) < SLOWEST_DEG_S:
            raise TypeError("the source stands still on the sky: nothing passes the beam")
        self._ear = self.ears(self.source)

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Point ahead of the source, and have the signal read meanwhile."""
        yield PointAt(*self._path.at(self._middle_s))
        with self._ear.open():
            yield from super().steps(now_s, asked=asked)

    def items(self) -> Sequence[float]:
        """Return when to listen; POSIX seconds."""
        return [self._path.begin_s + self._length_s * index / (POINTS - 1) for index in range(POINTS)]

    def do(self, item: float) -> Steps:
        """Wait for that time, and read the signal; a time that has gone by is left out."""
        begun = yield Wait(item)
        if begun.now_s > item + 2.0 * self._length_s / POINTS:
            return
        values = yield from self._ear.values(self._ear.reads)
        ended = yield Wait(0.0)
        if values:
            middle_s = (begun.now_s + ended.now_s) / 2.0
            az_deg, el_deg = self._path.at(self._middle_s)
            self._line.append((self._path.ahead_deg(middle_s, az_deg, el_deg, self._middle_s), tuple(values)))

    def finish(self) -> Steps:
        """Fit a beam along the way that the source went."""
        heard = [HeardDirection(ahead_deg, 0.0, values) for ahead_deg, values in self._line]
        self._fit = fit_heard(heard, self._ear, self.width_deg or None, cut="az")
        yield from ()

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """`axis`, `line`: degrees past the dish, 0, mean, scatter, count; then what the fit tells.

        `along_deg`: how far past the dish's own direction the source is when it is heard best, with `sigma_deg`.
        """
        line = tuple(
            (ahead_deg, 0.0, fmean(values), stdev(values) if len(values) > 1 else 0.0, float(len(values)))
            for ahead_deg, values in self._line
        )
        fit = self._fit
        if fit is None:
            return {"axis": "path", "line": line}
        return {
            "axis": "path", "line": line, "along_deg": self._along(fit), "late_s": self._late_s(fit),
            "sigma_deg": fit.sigma_deg, "rise": fit.rise, "floor": fit.floor, "width_deg": fit.width_deg,
            "unit": fit.unit.strip() or "counts",
        }  # fmt: skip

    @staticmethod
    def _along(fit: BeamFit) -> float:
        return shortest_turn(0.0, fit.az_deg)

    def _late_s(self, fit: BeamFit) -> float:
        return self._along(fit) / self._path.moves_deg_s(self._middle_s)

    @property
    def end_words(self) -> str:
        """Say when the source was heard best, and what that means for the dish."""
        fit = self._fit
        if fit is None:
            return PASSED_BY if self._line else LOST
        late_s, along_deg = self._late_s(fit), self._along(fit)
        when = f"{abs(late_s):.0f} s {'after' if late_s >= 0.0 else 'before'} the prediction"
        return (
            f"The beam looks {abs(along_deg):.2f}° ±{fit.sigma_deg:.2f}° "
            f"{'ahead of' if along_deg >= 0.0 else 'behind'} the dish's direction, along the path: "
            f"heard best {when}. {fit.width_deg:.1f}° wide, {fit.rise_words}."
        )
