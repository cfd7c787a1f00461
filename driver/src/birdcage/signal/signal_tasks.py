"""The tasks that find a source by its signal, by their kinds."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.signal.acquire_task import AcquireTask
from birdcage.signal.peak_task import PeakTask
from birdcage.signal.sweep_task import SweepTask
from birdcage.station.task import Task

SIGNAL_TASKS: Mapping[str, type[Task]] = {task.kind: task for task in (PeakTask, SweepTask, AcquireTask)}
"""What a station is given so that faces may ask for it (`BeginTask`)."""
