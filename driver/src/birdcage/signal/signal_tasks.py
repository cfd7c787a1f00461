"""The tasks that find a source by its signal, by their kinds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from birdcage.signal.acquire_task import AcquireTask
from birdcage.signal.drift_task import DriftTask
from birdcage.signal.ear import Ears, own_tuner
from birdcage.signal.firmware_sweep_task import FirmwareSweepTask
from birdcage.signal.on_off_task import OnOffTask
from birdcage.signal.peak_task import PeakTask
from birdcage.signal.sidereal_memory import SiderealMemory
from birdcage.signal.step_track_task import StepTrackTask
from birdcage.signal.sweep_task import SweepTask
from birdcage.station.task import Task


def signal_tasks(ears: Ears = own_tuner, memory: Path | None = None) -> Mapping[str, Callable[..., Task]]:
    """Return what a station is given, so that faces may ask for it (`BeginTask`).

    `ears`: what it may hear by. `memory`: the file of what step-track remembers; None: this session only.
    """
    kinds = (PeakTask, SweepTask, FirmwareSweepTask, AcquireTask, OnOffTask, DriftTask)
    return {
        **{task.kind: partial(task, ears=ears) for task in kinds},
        StepTrackTask.kind: partial(StepTrackTask, ears=ears, memory=SiderealMemory(memory)),
    }
