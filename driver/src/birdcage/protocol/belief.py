"""Whether a reading can be true: a digit that was lost or changed on its way makes a number as good as any other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.base.clock import Clock
from birdcage.base.errors import NoReply
from birdcage.base.geometry import shortest_turn
from birdcage.protocol.model import DishModel
from birdcage.protocol.types import Position

NEAR_DEG = 0.05
"""How far apart two readings of a dish at rest may lie."""
JITTER_S = 0.03
"""How much sooner or later than the one before a dish may take its reading."""
MOST_READS = 5


@dataclass(frozen=True, slots=True)
class _Seen:
    position: Position
    at: float
    rates: tuple[float, ...] = ()
    """Degrees a second of each axis."""


class Belief:
    """Takes a reading that goes on where the last ones ended; asks again for any other, until two agree.

    A dish at rest, or under way at an even speed, is so asked once; one that starts, turns or jumps, twice.
    """

    def __init__(self, model: DishModel) -> None:
        self._model = model
        self._last: _Seen | None = None

    def read(self, once: Callable[[], Position], clock: Clock) -> Position:
        """Return what `once` reads, or reads again. NoReply (`garbage`) when no two readings in a row agree."""
        now = clock.monotonic
        seen = _Seen(once(), now())
        if self._goes_on(seen):
            return self._take(seen)
        for _ in range(MOST_READS - 1):
            before, seen = seen, _Seen(once(), now())
            if self._agree(before, seen, clock.rate):
                return self._take(seen)
        self._last = None
        raise NoReply("The dish tells angles that do not fit together: bytes change on their way.", reason="garbage")

    def _goes_on(self, seen: _Seen) -> bool:
        last = self._last
        if last is None:
            return False
        ways = _ways(last.position, seen.position)
        if len(ways) != len(last.rates):
            return False
        past_s = seen.at - last.at
        return all(
            abs(way - rate * past_s) <= NEAR_DEG + abs(rate) * JITTER_S
            for way, rate in zip(ways, last.rates, strict=True)
        )

    def _agree(self, one: _Seen, other: _Seen, rate: float) -> bool:
        ways, past_s = _ways(one.position, other.position), other.at - one.at
        speeds = [axis.speed_deg_s * rate for axis in self._model.axes]
        same_axes = (one.position.skew is None) is (other.position.skew is None)
        return same_axes and all(
            abs(way) <= NEAR_DEG + speed * (past_s + JITTER_S) for way, speed in zip(ways, speeds, strict=False)
        )

    def _take(self, seen: _Seen) -> Position:
        last, rates = self._last, (0.0,) * len(_ways(seen.position, seen.position))
        if last is not None and seen.at > last.at:
            ways = _ways(last.position, seen.position)
            if len(ways) == len(rates):
                rates = tuple(way / (seen.at - last.at) for way in ways)
        self._last = _Seen(seen.position, seen.at, rates)
        return seen.position


def _ways(one: Position, other: Position) -> tuple[float, ...]:
    """Return how far each axis went from one to the other; the skew where both have it."""
    ways = shortest_turn(one.azimuth, other.azimuth), other.elevation - one.elevation
    return ways if one.skew is None or other.skew is None else (*ways, other.skew - one.skew)
