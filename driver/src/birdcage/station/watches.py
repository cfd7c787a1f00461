"""What somebody looks at, and how often the dish may be asked for it while it rests.

The budget (`docs/decisions/0005-what-is-asked-at-rest.md`): at most 3 commands a second over 10 s, at most one
excursion from the motor menu every 5 s. An excursion costs 6 lines of menu changes and 4 of `rssi`; with one position a
second in the motor menu that makes at most 14 lines in 5 s.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.station.requests import Watch

POSITION_PERIOD_S = 1.0
EXCURSION_PERIOD_S = 5.2
"""A little more than 5 s, as the lines of an excursion take their time on the wire."""
RSSI_PERIOD_S = 0.4
RSSI_READS = 4


@dataclass(slots=True)
class Excursion:
    """A visit to the tuner's menu: so many reads left, the next one at."""

    reads_left: int
    next_at: float


class Watches:
    """The watchers, and when each feature is due."""

    def __init__(self) -> None:
        self._watchers: dict[str, Watch] = {}
        self._position_at = 0.0
        self._excursion_at = 0.0
        self.excursion: Excursion | None = None

    def add(self, watch: Watch) -> None:
        """Somebody looks; a second time replaces the first."""
        self._watchers[watch.watcher] = watch

    def remove(self, watcher: str) -> None:
        """Somebody looks away."""
        self._watchers.pop(watcher, None)

    def period_s(self, feature: str, shortest_s: float) -> float | None:
        """Return the shortest period at which a feature is watched, at least `shortest_s`; None without a watcher."""
        rates = [watch.rate_hz for watch in self._watchers.values() if feature in watch.features]
        return max(shortest_s, 1.0 / max(rates)) if rates and max(rates) > 0 else None

    def looked_at(self, feature: str) -> bool:
        """Return whether anybody watches the feature."""
        return any(feature in watch.features for watch in self._watchers.values())

    def position_due(self, *, for_any: bool) -> float | None:
        """Return when to read the position next, while at rest; None without a watcher (`for_any` feature)."""
        period_s = self.period_s("position", POSITION_PERIOD_S)
        if period_s is None and for_any and self._watchers:
            period_s = POSITION_PERIOD_S
        return None if period_s is None else self._position_at + period_s

    def position_was_read(self, at: float) -> None:
        """Note that the position was read, for whatever reason."""
        self._position_at = at

    def rssi_due(self) -> float | None:
        """Return when to read the signal next, or to go and read it; None without a watcher."""
        if not self.looked_at("rssi"):
            self.excursion = None
            return None
        return self.excursion.next_at if self.excursion else self._excursion_at

    def may_begin(self, now: float) -> bool:
        """Return whether another excursion is within the budget, at a monotonic time."""
        return self.excursion is None and now >= self._excursion_at

    def rssi_was_read(self, at: float, not_before: float = -math.inf) -> None:
        """Note that the signal was read once, and that it may not be read again before a time."""
        if self.excursion is None:
            self.excursion = Excursion(RSSI_READS, at)
            self._excursion_at = at + EXCURSION_PERIOD_S
        self._excursion_at = max(self._excursion_at, not_before)
        self.excursion.reads_left -= 1
        self.excursion.next_at = max(at + RSSI_PERIOD_S, not_before)
        if self.excursion.reads_left <= 0:
            self.end_excursion()

    def end_excursion(self) -> None:
        """The dish is needed in the motor menu."""
        if self.excursion is not None:
            self._position_at = 0.0
        self.excursion = None
