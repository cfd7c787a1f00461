"""Runs a motor while its key is held: a terminal tells no release, so the repeats of the key say that it is held."""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import Future
from functools import partial

from birdcage.base.clock import Clock
from birdcage.rotator.feature import Feature
from birdcage.station.access import FaceStation
from birdcage.station.events import Event, TaskChanged
from birdcage.station.requests import Run
from birdcage.station.task_state import TaskPhase
from birdcage.station.tasks.held_key import HOLD_S
from birdcage.station.tasks.motor_run import FIRST_S, MotorRunTask

from birdcage_tui.shown.view import YOU


class MotorRunFeed:
    """For the app's thread. The station counts the time, and sends STOP by itself once no repeat comes."""

    def __init__(
        self, station: FaceStation, clock: Clock, soon: Callable[[Callable[[], None]], object],
        say: Callable[[str], object],
    ) -> None:  # fmt: skip
        """`say` hears how a run ended."""
        self._station, self._clock, self._soon, self._say = station, clock, soon, say
        self._key: tuple[str, bool] | None = None
        self._until = -math.inf
        """Until when the next press of the same key is a repeat of it."""
        self._end: Callable[[], None] | None = None

    def press(self, feature: Feature, value: float) -> None:
        """A key was pressed, or repeats; a person was told the hazard of the feature, and agreed."""
        now, key = self._clock.monotonic(), (feature.id, value > 0.0)
        renews = key == self._key and now <= self._until
        self._key, self._until = key, now + (HOLD_S if renews else FIRST_S)
        if self._end is None:
            self._end = self._station.subscribe(self._on_event, TaskChanged)
        future = self._station.submit(Run(feature.id, value, YOU, agreed=True, renews=renews))
        future.add_done_callback(self._asked)

    def _asked(self, done: Future[object]) -> None:
        error = None if done.cancelled() else done.exception()
        if error is not None:
            self._soon(lambda: self._tell(str(error)))

    def _tell(self, words: str) -> None:
        self._say(words)

    def _on_event(self, event: Event) -> None:
        """Hear how it ended, on the station's thread."""
        run = event.task if isinstance(event, TaskChanged) else None
        if run is not None and run.kind == MotorRunTask.kind and run.phase is TaskPhase.OVER:
            self._soon(partial(self._over, run.why))

    def _over(self, why: str) -> None:
        end, self._end = self._end, None
        if end is not None:
            end()
        self._say(why)
