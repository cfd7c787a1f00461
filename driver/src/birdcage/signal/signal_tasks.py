"""The tasks that find a source by its signal, by their kinds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from birdcage.signal.acquire_task import AcquireTask
from birdcage.signal.ear import Ears, own_tuner
from birdcage.signal.peak_task import PeakTask
from birdcage.signal.sweep_task import SweepTask
from birdcage.station.task import Task


def signal_tasks(ears: Ears = own_tuner) -> Mapping[str, Callable[..., Task]]:
    """Return what a station is given, so that faces may ask for it (`BeginTask`); `ears`: what it may hear by."""
    return {task.kind: partial(task, ears=ears) for task in (PeakTask, SweepTask, AcquireTask)}
