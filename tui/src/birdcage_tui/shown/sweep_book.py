"""The sweeps of this session, as they come: those of the app, of a command and of other programs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from birdcage.base.geometry import shortest_turn
from birdcage.signal.drift_task import DriftTask
from birdcage.signal.firmware_sweep_task import FirmwareSweepTask
from birdcage.signal.sweep_task import SweepTask
from birdcage.station.task_state import TaskPhase, TaskState, TaskValue

KEPT = 4
"""The newest one, and those that lie under it."""
KINDS = (SweepTask.kind, FirmwareSweepTask.kind, DriftTask.kind)
FALL = 4.0 * math.log(2.0)


@dataclass(frozen=True, slots=True)
class SweepPoint:
    """One direction of a sweep."""

    deg: float
    """Along the axis: an azimuth goes on beyond 360 where the sweep goes through north."""
    level: float
    sigma: float
    """Standard deviation of that level."""


@dataclass(frozen=True, slots=True)
class SweepFit:
    """The beam that fits a sweep."""

    deg: float
    sigma_deg: float
    rise: float
    floor: float
    width_deg: float
    decibels: bool
    stretch: float
    """Degrees of the axis to a degree on the sky."""

    def level(self, deg: float) -> float:
        """Return the level that it has there."""
        far = (deg - self.deg) / self.stretch / self.width_deg
        part = math.exp(-FALL * far * far)
        if not self.decibels:
            return self.floor + self.rise * part
        return self.floor + 10.0 * math.log10(1.0 + (math.pow(10.0, self.rise / 10.0) - 1.0) * part)


@dataclass(frozen=True, slots=True)
class SweepShown:
    """One sweep."""

    number: int
    axis: str
    """`az`, `el`, or `path`: along the way of what drifts through the beam."""
    done: int
    of: int
    points: Sequence[SweepPoint] = ()
    fit: SweepFit | None = None
    is_over: bool = False
    why: str = ""
    """How it ended."""


@dataclass
class SweepBook:
    """For the app's thread."""

    shown: tuple[SweepShown, ...] = field(default=())
    """The newest last."""

    def take(self, task: TaskState) -> None:
        """Take what a task has found so far, if it is a sweep or a drift scan."""
        if task.kind not in KINDS:
            return
        sweep = _sweep_of(task)
        others = tuple(each for each in self.shown if each.number != sweep.number)
        self.shown = (*others, sweep)[-KEPT:]


def _sweep_of(task: TaskState) -> SweepShown:
    axis, rows = str(task.found.get("axis", "az")), task.found.get("line", ())
    points: list[SweepPoint] = []
    for row in rows if isinstance(rows, tuple) else ():
        az_deg, el_deg, level, scatter, count = row
        deg = {"el": el_deg, "path": az_deg}.get(axis, _unrolled(az_deg, points))
        points.append(SweepPoint(deg, level, scatter / math.sqrt(max(count, 1))))
    fit = _fit_of(task.found, axis, points) if points and "rise" in task.found else None
    over = task.phase is TaskPhase.OVER
    return SweepShown(task.number, axis, task.done or 0, task.of or 0, points, fit, over, task.why if over else "")


def _unrolled(az_deg: float, before: Sequence[SweepPoint]) -> float:
    return az_deg if not before else before[-1].deg + shortest_turn(before[-1].deg, az_deg)


def _fit_of(found: Mapping[str, TaskValue], axis: str, points: Sequence[SweepPoint]) -> SweepFit:
    def number(name: str) -> float:
        return float(found[name])  # type: ignore[arg-type]

    sigma_deg, rise, floor, width_deg = (number(name) for name in ("sigma_deg", "rise", "floor", "width_deg"))
    deg, stretch = 0.0, 1.0
    if axis == "path":
        deg = number("along_deg")
    elif axis == "el":
        deg = number("el_deg")
    else:
        middle = points[len(points) // 2].deg
        deg = middle + shortest_turn(middle, number("az_deg"))
        stretch = 1.0 / max(math.cos(math.radians(number("el_deg"))), 0.01)
    return SweepFit(deg, sigma_deg, rise, floor, width_deg, found.get("unit") == "dB", stretch)
