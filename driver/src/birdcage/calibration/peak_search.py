"""A peak that the station finds by the signal (`birdcage.signal.peak_task`), as a measurement of the calibration."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.calibration.peak import LEAST_SIGMA_DEG, MeasuredPeak
from birdcage.calibration.work import observer_of, peak_at
from birdcage.signal.acquired import dish_angles, number_of
from birdcage.signal.beam_fit import ASSUMED_WIDTH_DEG
from birdcage.signal.peak_task import PeakTask
from birdcage.signal.slots_heard import patterns_near, seen_from
from birdcage.station.events import Event, TaskChanged
from birdcage.station.requests import BeginTask
from birdcage.station.task_state import TaskPhase, TaskState, TaskValue

if TYPE_CHECKING:
    from birdcage.base.beam import Beam
    from birdcage.base.config import Settings
    from birdcage.sky.targets.model import Target
    from birdcage.station.access import StationAccess
    from birdcage.station.state import Pointing

SETTLES_S = 5.0
"""So long after its end the dish has told where it rests, or the peak is lost."""


class PeakSearch:
    """One search, from the moment before it is asked for: what is told of it, and how it ended.

    Made on any thread; events come on the station's, and only fill a table.
    """

    def __init__(self, station: StationAccess) -> None:
        self._told: dict[int, TaskState] = {}
        """By number: another program may have a task of this kind, and this one may be over before its is known."""
        self._unsubscribe = station.subscribe(self._hear, TaskChanged)
        self.number: int | None = None
        self.ended_at: float | None = None
        """When it was seen to be over, in monotonic seconds."""

    def _hear(self, event: Event) -> None:
        if isinstance(event, TaskChanged) and event.task.kind == PeakTask.kind:
            self._told[event.task.number] = event.task

    @property
    def _task(self) -> TaskState | None:
        return None if self.number is None else self._told.get(self.number)

    @property
    def ended(self) -> TaskState | None:
        """How it ended; None before."""
        task = self._task
        return task if task is not None and task.phase is TaskPhase.OVER else None

    @property
    def words(self) -> str:
        """Say how far it is."""
        task = self._task
        return "finding the peak" if task is None or not task.done else f"finding the peak: {task.done} of {task.of}"

    def close(self) -> None:
        """Hear no more."""
        self._unsubscribe()


def search_for(
    settings: Settings, stands: tuple[float, float], position: Pointing, beam: Beam | None, holder: str, source: str
) -> BeginTask:
    """Return what has the station find the peak around where the dish points.

    `stands` is the true direction of the object: the satellites of the arc beside it are fitted together with it.
    `source` is what it hears by, empty for the feed's own.
    """
    slots = seen_from(observer_of(settings), settings.tracking.refraction)
    values: dict[str, TaskValue] = {
        "az_deg": position.az_deg, "el_deg": position.el_deg, "width_deg": 0.0 if beam is None else beam.mean_deg,
        "patterns": patterns_near(*stands, slots, ASSUMED_WIDTH_DEG if beam is None else beam.mean_deg),
        "source": source,
    }  # fmt: skip
    return BeginTask(PeakTask.kind, values, holder)


def peak_found(
    settings: Settings, target: Target, position: Pointing, found: Mapping[str, TaskValue], beam: Beam | None = None
) -> MeasuredPeak:
    """Return what was found as a peak on a target: as the dish read, and where the target was, while it listened.

    `position` is the dish at rest after that. No better than `LEAST_SIGMA_DEG`, however strong the signal.
    """
    az_deg, el_deg, sigma_deg, utc_s = (number_of(found, name) for name in ("az_deg", "el_deg", "sigma_deg", "utc_s"))
    dish_az_deg, dish_el_deg = dish_angles(position, az_deg, el_deg)
    middle = replace(
        position, dish_az_deg=dish_az_deg, dish_el_deg=dish_el_deg, utc=datetime.fromtimestamp(utc_s, UTC)
    )  # fmt: skip
    return replace(peak_at(settings, target, middle, max(sigma_deg, LEAST_SIGMA_DEG), beam), found="rssi")
