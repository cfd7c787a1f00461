"""How a task hears: by the dish's own tuner, which the station asks, or by a source with a thread of its own."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import Protocol

from birdcage.base.clock import Clock
from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.rotator.feature import RSSI
from birdcage.signal.beam_fit import BeamFit, Cut, HeardDirection, Pattern, beam_points, fit_beam, noise_of
from birdcage.signal.source import Scale, SignalReading, SignalSource
from birdcage.tracking.steps import ReadFeatures, Step, StepResult, Wait

READS = 4
"""Readings of the dish's own tuner in one direction."""
READS_S, FEWEST, MOST = 1.0, 2, 8
"""Another source is heard for about so long in one direction, at least and at most so many readings."""
SETTLE_S = 0.3
"""A reading whose dwell is not known counts so long after the dish came to rest."""
LOOK_S = 0.1
LATE = 3.0
"""A source is given up when it is quiet for so many of its longest usual pauses, and `LATE_S` at least."""
LATE_S = 5.0
KEPT = 256

Values = Generator[Step, StepResult, list[float]]


class TaskEar(Protocol):
    """One source of the signal, as a task hears it at rest."""

    decibels: bool
    """Whether equal steps are equal ratios of power."""
    reads: int
    """How many readings one direction gets."""

    def open(self) -> AbstractContextManager[None]:
        """Have it read meanwhile."""

    def values(self, reads: int) -> Values:
        """Hear what is measured from now on. NoReply where the source tells nothing any more."""


Ears = Callable[[str], TaskEar]
"""The ear of a source by its id, empty for the feed's. TypeError, which refuses a task, for an unknown one."""


class TunerEar:
    """The dish's own tuner: the station asks it, between its other exchanges. What it does not tell is left out."""

    decibels = False
    reads = READS

    def open(self) -> AbstractContextManager[None]:
        """Nothing has to be begun."""
        return nullcontext()

    def values(self, reads: int) -> Values:
        """Ask so many times."""
        values = []
        for _ in range(reads):
            told = (yield ReadFeatures((RSSI,))).readings.get(RSSI)
            if told is not None:
                values.append(float(told.value))
        return values


class SourceEar:
    """Any other source: readings that were measured wholly after the dish came to rest count."""

    def __init__(self, source: SignalSource, clock: Clock, watcher: str = "task") -> None:
        self._source, self._clock, self._watcher = source, clock, watcher
        facts = source.facts
        self.decibels = facts.scale is Scale.LOG
        self.reads = min(max(round(facts.rate_hz * READS_S), FEWEST), MOST)
        self._lock = threading.Lock()
        self._told: deque[SignalReading] = deque(maxlen=KEPT)
        self._users = 0

    @contextmanager
    def open(self) -> Iterator[None]:
        """Have it read steadily; whoever opens it within does that no second time."""
        self._users += 1
        if self._users > 1:
            yield
            self._users -= 1
            return
        unsubscribe = self._source.subscribe(self._take)
        self._source.watch(self._watcher, steady=True)
        try:
            yield
        finally:
            self._users = 0
            self._source.unwatch(self._watcher)
            unsubscribe()

    def values(self, reads: int) -> Values:
        """Wait for so many."""
        facts = self._source.facts
        since = self._clock.monotonic() + (0.0 if facts.dwell_s is not None else SETTLE_S)
        late_s = max(LATE_S, LATE * facts.pause_s) / self._clock.rate
        heard_at, values = since, list[float]()
        while len(values) < reads:
            for reading in self._taken():
                if reading.source == facts.id and reading.at - reading.dwell_s / 2.0 >= since:
                    values.append(reading.value)
                    heard_at = self._clock.monotonic()
            if self._clock.monotonic() > heard_at + late_s:
                words = self._source.trouble or f"The {facts.label} has told nothing for {late_s:.0f} s."
                raise NoReply(f"The signal is lost. {words}", reason=Reason.SILENT)
            if len(values) < reads:
                yield Wait(self._clock.utc().timestamp() + LOOK_S)
        return values[:reads]

    def _take(self, reading: SignalReading) -> None:
        with self._lock:
            self._told.append(reading)

    def _taken(self) -> Sequence[SignalReading]:
        with self._lock:
            told = tuple(self._told)
            self._told.clear()
        return told


def own_tuner(source: str) -> TaskEar:
    """Return the dish's own tuner: where there is no other source."""
    if source not in ("", "tuner"):
        raise TypeError(f"there is no signal source called {source}")
    return TunerEar()


def fit_heard(
    heard: Sequence[HeardDirection], ear: TaskEar, width_deg: float | None, patterns: Sequence[Pattern] = ((),),
    cut: Cut | None = None,
) -> BeamFit | None:  # fmt: skip
    """Fit a beam to what was heard; decibels are fitted as powers, which add up, and told in decibels again."""
    points = beam_points(heard, noise_of(heard), decibels=ear.decibels)
    fit = fit_beam(points, width_deg, patterns, cut)
    if fit is None or not ear.decibels:
        return fit
    return fit.in_decibels(max(each.mean for each in heard))
