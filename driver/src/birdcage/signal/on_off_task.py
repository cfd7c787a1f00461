"""How much a source stands over the sky beside it: on it, and beside it on either side, in turn."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import fmean, stdev

from birdcage.base.geometry import wrap_360
from birdcage.signal.beam_fit import CUTS, Cut
from birdcage.signal.ear import Ears, own_tuner
from birdcage.signal.listen import check_number, listen_at
from birdcage.signal.peak_task import LOST
from birdcage.signal.source_path import SourcePath
from birdcage.station.task import ItemTask
from birdcage.station.task_state import TaskValue
from birdcage.tracking.steps import PointAt, Steps, Wait

BEAMS_AWAY = 3.0
"""How far beside the source one listens, in widths of the beam."""
MOST_CYCLES = 200
ON = 0.0
MIN_CYCLES = 2
"""One alone tells no error."""
CYCLE = (ON, -1.0, 1.0, ON)
"""A gain that drifts evenly cancels out of such a cycle."""
READS = 2
"""Times the readings of a peak: a difference is worth its time."""


@dataclass
class OnOffTask(ItemTask[float]):
    """Listens to a source, and `away_deg` to either side of it along `axis`, and ends on the source.

    `path`: rows of POSIX seconds, true azimuth and elevation, in degrees (`SourcePath`). Decibels are averaged as
    powers. A side beyond the dish's limits is left out. `source` as for `PeakTask`.
    """

    kind = "on-off"
    goes_on = False
    is_unattended = False
    cut_words = "The comparison is not complete."
    holder: str
    path: tuple[tuple[float, ...], ...]
    away_deg: float
    axis: Cut = "az"
    cycles: int = 3
    source: str = ""
    ears: Ears = field(default=own_tuner, repr=False)
    _heard: list[tuple[int, float, float]] = field(default_factory=list, init=False)
    """Cycle, side and level of each direction; levels of decibels as powers."""

    def __post_init__(self) -> None:
        """Raise TypeError, which refuses the task, for values that make no comparison."""
        if self.axis not in CUTS:
            raise TypeError(f"axis is {self.axis!r}. Give az or el")
        check_number("away_deg", self.away_deg, 0.1, 90.0)
        check_number("cycles", self.cycles, MIN_CYCLES, MOST_CYCLES)
        self._path = SourcePath.of(self.path)
        self._ear = self.ears(self.source)

    def steps(self, now_s: float, *, asked: bool) -> Steps:
        """Have the source of the signal read meanwhile."""
        with self._ear.open():
            yield from super().steps(now_s, asked=asked)

    def items(self) -> Sequence[float]:
        """Return the sides, in turn."""
        return CYCLE * int(self.cycles)

    def do(self, item: float) -> Steps:
        """Point there, as the source stands now, and read the signal."""
        now = yield Wait(0.0)
        az_deg, el_deg = self._path.at(now.now_s)
        if self.axis == "az":
            az_deg = wrap_360(az_deg + item * self.away_deg / math.cos(math.radians(el_deg)))
        else:
            el_deg += item * self.away_deg
        if abs(el_deg) > 90.0:
            return
        heard = yield from listen_at(
            self._ear, az_deg, el_deg, READS * self._ear.reads, optional=item != ON
        )  # fmt: skip
        if heard is not None:
            levels = [10.0 ** (value / 10.0) for value in heard.values] if self._ear.decibels else heard.values
            self._heard.append((self.done // len(CYCLE), item, fmean(levels)))

    def finish(self) -> Steps:
        """Go back to the source."""
        now = yield Wait(0.0)
        yield PointAt(*self._path.at(now.now_s))

    @property
    def found(self) -> Mapping[str, TaskValue]:
        """Difference, its standard error by the scatter of the cycles, and both levels; nothing before two cycles."""
        cycles = [pair for cycle in range(int(self.cycles)) if (pair := self._pair(cycle)) is not None]
        if len(cycles) < MIN_CYCLES:
            return {}
        differences = [self._told(on) - self._told(off) for on, off in cycles]
        return {
            "difference": fmean(differences),
            "sigma": stdev(differences) / math.sqrt(len(differences)),
            "on": self._told(fmean(on for on, _off in cycles)),
            "off": self._told(fmean(off for _on, off in cycles)),
            "cycles": len(cycles),
            "unit": "dB" if self._ear.decibels else "counts",
        }

    def _pair(self, cycle: int) -> tuple[float, float] | None:
        """Return both levels of a cycle that is complete, or lacks no more than one side."""
        on = [level for number, side, level in self._heard if number == cycle and side == ON]
        off = [level for number, side, level in self._heard if number == cycle and side != ON]
        whole = self.done >= (cycle + 1) * len(CYCLE)
        return (fmean(on), fmean(off)) if whole and on and off else None

    def _told(self, level: float) -> float:
        return 10.0 * math.log10(level) if self._ear.decibels else level

    @property
    def end_words(self) -> str:
        """Say how large the difference is, and how sure."""
        found = self.found
        if not found:
            return "Neither side is within the dish's limits. Nothing was compared." if self._heard else LOST
        unit, digits = found["unit"], 2 if self._ear.decibels else 1
        return (
            f"{found['difference']:+.{digits}f} ±{found['sigma']:.{digits}f} {unit} on the source against the sky "
            f"{self.away_deg:.1f}° beside it ({found['on']:.{digits}f} and {found['off']:.{digits}f})."
        )
