"""How long STOP waits: for an answer, for the dish to rest, and for readings that prove it."""

from __future__ import annotations

from birdcage.antenna.antenna import BirdcageAntenna
from birdcage.base.clock import Clock
from birdcage.rotator.ladder import StopMeans
from birdcage.station.state import Pointing
from birdcage.station.stop_pending import PendingStop

MOST_REPEATS = 5
ANSWER_S = 0.3
READINGS = 4
"""So many exchanges it takes at most until two positions that can be believed agree."""


class StopTimes:
    """Of one antenna, on the clock of its station."""

    def __init__(self, antenna: BirdcageAntenna, clock: Clock) -> None:
        self._antenna, self._clock = antenna, clock

    def lasts_s(self, means: StopMeans, *, slowest: bool) -> float:
        """Return how long the dish may take to rest, and to be seen at rest by readings that take their time."""
        rotator, strategy = self._antenna.rotator, self._antenna.strategy
        round_trip_s = rotator.line.round_trip_s if rotator.is_open else None
        reading_s = max(round_trip_s or 0.0, rotator.facts.least_look_interval_s or 0.0)
        lasts_s = strategy.lasts_s(means, self._clock) + strategy.still_s(slowest=slowest)
        return lasts_s / self._clock.rate + READINGS * reading_s

    def answer_s(self, pending: PendingStop) -> float:
        """Return how long the answer is waited for before what was sent is sent again."""
        rotator, motion = self._antenna.rotator, self._antenna.motion
        if pending.sent < MOST_REPEATS:
            return ANSWER_S
        within_s: float = rotator.line.delay_s
        if pending.report.means is StopMeans.LOOK and motion is not None:
            # It may be waiting for a motor before it reads on.
            within_s += max(0.0, motion.over_by(self._clock.rate) - self._clock.monotonic())
        return within_s

    def proof_at(self, pending: PendingStop, still_from: Pointing) -> float:
        """Return when a reading must be asked for that proves rest, if it agrees with an earlier one.

        The earlier one was made before it came, and the last after it was asked for.
        """
        strategy = self._antenna.strategy
        still_s = strategy.still_s(slowest=pending.slowest)
        return still_from.at + max(still_s, strategy.turns_s(still_from.dish)) / self._clock.rate
