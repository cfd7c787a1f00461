"""Reads features where a short move leads the dish: the way to their menu is gone while the dish still turns."""

from __future__ import annotations

from collections.abc import Mapping

from birdcage.rotator.feature import Reading
from birdcage.station.dish_exchanges import DishExchanges
from birdcage.station.mover import Job
from birdcage.station.parts import Parts
from birdcage.station.watches import MENU_LINES
from birdcage.tracking.steps import ReadFeatures

SHORTEST_S, FORGETS = 0.02, 1.02
"""So long an exchange takes at least, before any was timed. The shortest of late counts for a little more with each
move that follows: a line may have become slower."""


class ArrivalHearing:
    """One move at a time: `begin` it, `read` when that is `due`, take the `answer` once the mover has seen it there.

    What was read counts only where the first look afterwards shows the dish on its target. It had to rest by then, by
    its speeds, before the line that reads went out. Else it is read once more, at rest.
    """

    def __init__(self, parts: Parts, exchanges: DishExchanges) -> None:
        self._antenna, self._mover, self._exchanges = parts.antenna, parts.mover, exchanges
        self._job: Job | None = None
        self._readings: Mapping[str, Reading] | None = None
        self._shortest_s = SHORTEST_S
        """The shortest exchange of late: the way to another menu takes at least so many of them."""

    def begin(self, job: Job) -> None:
        """A move is about to begin."""
        self._note_exchange()
        self._job, self._readings = job, None

    def forget(self) -> None:
        """There is no such move any more."""
        self._job = self._readings = None

    def due(self) -> float | None:
        """Return when to go to the menu and read, in monotonic seconds; None for not before the dish is seen there."""
        job = self._job
        if job is None or self._readings is not None or job.looks:
            return None
        rests_by = self._mover.rests_by(job)
        return None if rests_by is None else rests_by - MENU_LINES * self._shortest_s

    def read(self, ids: tuple[str, ...]) -> None:
        """Go there and read."""
        self._readings = self._exchanges.features(ReadFeatures(ids))

    def answer(self, ids: tuple[str, ...]) -> Mapping[str, Reading]:
        """Return what was read on arrival; read it now, at rest, if the dish came later than it had to."""
        job, readings = self._job, self._readings
        self.forget()
        if readings is None or job is None or job.looks > 1:
            return self._exchanges.features(ReadFeatures(ids))
        return readings

    def _note_exchange(self) -> None:
        last_s = self._antenna.rotator.line.round_trip_s
        if last_s is not None:
            self._shortest_s = min(self._shortest_s * FORGETS, last_s)
