"""The map that is shown: what was heard of it so far, by the station's word at once and by the file in full."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from birdcage.skymap.map_request import KIND
from birdcage.skymap.plan import MapPlan
from birdcage.skymap.sky_map import MapSample, SkyMap
from birdcage.station.task_state import TaskPhase, TaskState

from birdcage_tui.shown.options import SitePlace

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

SAME_PLACE_DEG = 0.002
"""Two places no further apart are one: some 200 m, more than a receiver of GPS is off."""


@dataclass(frozen=True, slots=True, eq=False)
class MapRead:
    """A map as it was read from the file, with what takes a while to make of it: not on the app's thread."""

    sky: SkyMap
    grid: NDArray[np.float64]
    samples: Mapping[int, MapSample]
    """By their cells."""
    sequence: NDArray[np.int64]
    """The cells in the order in which the dish goes through them."""

    @classmethod
    def of(cls, sky: SkyMap) -> MapRead:
        """Make it."""
        import numpy as np

        samples = {each.cell: each for each in sky.samples if each.cell is not None}
        return cls(sky, sky.grid(), samples, np.array(sky.plan.sequence))


@dataclass(frozen=True, slots=True, eq=False)
class MapShown:
    """A map as it is known now."""

    key: str
    file: MapRead
    """As it was read from the file last."""
    grid: NDArray[np.float64]
    """Values in rows of rising elevation and columns of rising azimuth, NaN where nothing was heard. Never changed."""
    heard: int
    """How many directions."""
    span: tuple[float, float] | None
    """Least and greatest value; None before the first."""
    loudest: int | None
    """The cell with the greatest value; None before the first."""
    next_cell: int | None
    """The direction that comes next; None once all were heard, or are out of reach."""

    @property
    def sky(self) -> SkyMap:
        """As the file has told it."""
        return self.file.sky

    @property
    def samples(self) -> Mapping[int, MapSample]:
        """What the file tells of a cell."""
        return self.file.samples

    @property
    def plan(self) -> MapPlan:
        """Its grid."""
        return self.file.sky.plan

    @property
    def is_complete(self) -> bool:
        """Whether every direction was heard that the dish can go to."""
        return self.sky.ended is not None or self.heard >= self.plan.cells

    def is_elsewhere(self, place: SitePlace | None) -> bool:
        """Return whether it was made at another place, so that other trees stood around it; False where unknown."""
        made = self.sky.place()
        if made is None or place is None:
            return False
        return max(abs(made[0] - place.latitude_deg), abs(made[1] - place.longitude_deg)) > SAME_PLACE_DEG

    @property
    def heard_cells(self) -> frozenset[int]:
        """Which were heard."""
        import numpy as np

        return frozenset(np.flatnonzero(~np.isnan(self.grid)).tolist())

    def value(self, cell: int) -> float | None:
        """Return what was heard in a cell; None for nothing."""
        row, column = divmod(cell, self.plan.columns)
        value = float(self.grid[row, column])
        return value if value == value else None


@dataclass
class MapBook:
    """For the app's thread. `shown` is a new one after each change."""

    shown: MapShown | None = None
    begun: int = 0
    """Counts the maps that were seen to begin, or that were under way as the app came: the page shows a new one."""
    chosen: str = ""
    """The key of a map that a person has opened: it stays until another one begins."""
    _tasks: set[int] = field(default_factory=set)
    _rows: dict[str, dict[int, float]] = field(default_factory=dict)
    """What the station has told of a map, by its key and cell."""
    _aims: dict[str, tuple[int | None, int | None]] = field(default_factory=dict)
    """The direction under way, as its task tells it, and the last that was heard; by the map's key."""

    def take(self, task: TaskState) -> str | None:
        """Take what a task tells. Return the key of a map that the file has to tell more of."""
        key = str(task.found.get("map", ""))
        if task.kind != KIND or not key:
            return None
        if task.number not in self._tasks:
            self._tasks.add(task.number)
            if task.phase is not TaskPhase.OVER:
                self.begun += 1
                self.chosen = ""
        rows, told = _rows_of(task), task.found.get("next")
        newest = next(reversed(rows), None)
        self._aims[key] = (int(told) if isinstance(told, int | float) else None, newest)
        self._rows.setdefault(key, {}).update(rows)
        if self.chosen not in ("", key):
            return None
        if self.shown is None or self.shown.key != key:
            return key
        self._keep(self.shown.file, key, rows)
        lacks = task.done is not None and self.shown.heard != task.done
        return key if lacks or task.phase is TaskPhase.OVER else None

    def read(self, key: str, file: MapRead) -> None:
        """Take what the file tells. What the station has told since stays."""
        self._keep(file, key, self._rows.get(key, {}))

    def _next(self, key: str, file: MapRead, missing: NDArray[np.bool_]) -> int | None:
        """Return the direction under way: by the task's own word, else the next that is `missing` of the sequence.

        What was left out before the newest one is out of reach.
        """
        import numpy as np

        told, newest = self._aims.get(key, (None, None))
        if told is not None and told in file.sequence:
            return told
        left = np.flatnonzero(missing)
        if newest is not None:
            left = left[left > int(np.argmax(file.sequence == newest))]
        return int(file.sequence[left[0]]) if len(left) else None

    def _keep(self, file: MapRead, key: str, rows: Mapping[int, float]) -> None:
        import numpy as np

        before = self.shown if self.shown is not None and self.shown.key == key else None
        grid = (file.grid if before is None or before.file is not file else before.grid).copy()
        flat = grid.reshape(-1)
        for cell, value in rows.items():
            if 0 <= cell < flat.size:
                flat[cell] = value
        heard = int(np.count_nonzero(~np.isnan(flat)))
        span = (float(np.nanmin(flat)), float(np.nanmax(flat))) if heard else None
        loudest = int(np.nanargmax(flat)) if heard else None
        missing = np.isnan(flat[file.sequence])
        next_cell = self._next(key, file, missing)
        self.shown = MapShown(key, file, grid, heard, span, loudest, next_cell)


def _rows_of(task: TaskState) -> dict[int, float]:
    """Return what a task tells of its newest directions, by cell."""
    rows = task.found.get("newest", ())
    return {int(row[0]): float(row[3]) for row in rows} if isinstance(rows, tuple) else {}


def map_task(tasks: Sequence[TaskState], key: str = "") -> TaskState | None:
    """Return the newest task that makes a map; with a key, only that map's."""
    found = [each for each in tasks if each.kind == KIND and (not key or each.found.get("map") == key)]
    return max(found, key=lambda each: each.number, default=None)
