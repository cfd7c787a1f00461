"""Who looks at what, and how often the dish may be asked for it while it rests.

The budget (`docs/decisions/0005-what-is-asked-at-rest.md`): at most 3 commands a second over 10 s, at most one
excursion from the motor menu every 5 s. An excursion costs 6 lines of menu changes and 4 of reading; with one position
a second in the motor menu that makes at most 14 lines in 5 s.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from birdcage.base.reason import Reason
from birdcage.rotator.feature import HEALTH, POSITION, RSSI, Feature
from birdcage.station.requests import Watch

POSITION_PERIOD_S = 1.0
EXCURSION_PERIOD_S = 5.2
"""A little more than 5 s, as the lines of an excursion take their time on the wire."""
RSSI_PERIOD_S = 0.4
"""The least time between two readings in one excursion."""
RSSI_READS = 4
"""How many lines one excursion reads; a feature that takes more is read alone."""
NONSENSE = (Reason.GARBAGE, Reason.NO_ROW)
"""Reasons for which one answer is of no use: where the line is settled all the same, the dish itself answers."""
BUDGET_LINES, BUDGET_S = 30, 10.4
"""At most so many lines in any stretch of so many seconds: a little more than 10 s, as above."""
MENU_LINES = 3
"""What a change of the menu takes: a bare Enter, `q` and a name."""
MOST_LINES = 13
"""A feature that takes more lines never fits, with a position a second: a watch does not read it, `Read` does."""
RETRY_S, STEADY_RETRY_S = 30.0, 1.0
"""How long a feature that was refused, or told nonsense, is left alone at least; a signal that is watched steadily and
whose answer was damaged."""


@dataclass(slots=True)
class Excursion:
    """A visit to one menu: what is still to be read there, and when the next of it may be."""

    todo: deque[str]
    next_at: float
    menu_lines: int
    """What it takes to leave it."""
    only_signal: bool


class Watches:
    """The watchers, and when each feature is due."""

    def __init__(self) -> None:
        self._watchers: dict[str, Watch] = {}
        self._position_at = 0.0
        self._excursion_at = 0.0
        self._asked_at: dict[str, float] = {}
        """When each feature was asked for last, whether it was told or not."""
        self._not_before: dict[str, float] = {}
        """Until when a feature that failed is left alone."""
        self._lines: deque[tuple[float, int]] = deque()
        """How many lines were sent when, as long as that counts."""
        self._periods: Mapping[str, float] = {}
        self._periods_of: Mapping[str, Feature] | None = None
        """Of which features the periods are; None: to be worked out."""
        self._other_at = -math.inf
        """When anything but position and signal was read last."""
        self.excursion: Excursion | None = None
        self.is_away = False
        """Whether an excursion for others than the signal has left the motor menu, and no position was read since."""

    def add(self, watch: Watch) -> None:
        """Somebody looks; a second time replaces the first."""
        self._watchers[watch.watcher] = watch
        self._periods_of = None

    def remove(self, watcher: str) -> None:
        """Somebody looks away."""
        self._watchers.pop(watcher, None)
        self._periods_of = None

    @property
    def steady_period_s(self) -> float | None:
        """How often the signal is to be read while the console stays in its menu; None where no watch is steady."""
        rates = [watch.rate_hz for watch in self._watchers.values() if watch.steady and RSSI in watch.features]
        return 1.0 / max(rates) if rates and max(rates) > 0 else None

    def period_s(self, feature: str, shortest_s: float) -> float | None:
        """Return the shortest period at which a feature is watched, at least `shortest_s`; None without a watcher."""
        rates = [watch.rate_hz for watch in self._watchers.values() if feature in watch.features]
        return max(shortest_s, 1.0 / max(rates)) if rates and max(rates) > 0 else None

    def periods_s(self, features: Mapping[str, Feature]) -> Mapping[str, float]:
        """Return what a machine with these features is asked for, with the period of each in seconds.

        The signal has the period of its readings within one excursion, at whatever rate it is watched.
        """
        if self._periods_of is not features:
            periods = {each.id: self._period_s(each) for each in features.values() if each.is_readable}
            self._periods = {name: period_s for name, period_s in periods.items() if period_s is not None}
            self._periods_of = features
        return self._periods

    def _period_s(self, feature: Feature) -> float | None:
        if feature.id == RSSI:
            return RSSI_PERIOD_S if any(RSSI in watch.features for watch in self._watchers.values()) else None
        if feature.cost.lines > MOST_LINES or (feature.read_hazard and not self._is_agreed(feature.id)):
            return None
        asked = [self.period_s(feature.id, feature.cost.min_interval_s)]
        if feature.health is not None:
            asked.append(self.period_s(HEALTH, max(feature.health.every_s, feature.cost.min_interval_s)))
        return min((period_s for period_s in asked if period_s is not None), default=None)

    def _is_agreed(self, feature: str) -> bool:
        """Whether somebody who watches a feature has agreed to what reading it does."""
        return any(feature in watch.features and watch.agreed for watch in self._watchers.values())

    def due(self, feature: str, period_s: float) -> float:
        """Return when a feature is to be asked for next, as far as its own period goes; minus infinite at first."""
        asked_at = self._asked_at.get(feature, -math.inf)
        return max(asked_at + period_s, self._not_before.get(feature, -math.inf))

    def asked_at(self, feature: str) -> float:
        """Return when a feature was asked for last; minus infinite if it never was."""
        return self._asked_at.get(feature, -math.inf)

    def position_due(self, *, for_any: bool) -> float | None:
        """Return when to read the position next, while at rest; None without a watcher (`for_any` feature)."""
        period_s = self.period_s(POSITION, POSITION_PERIOD_S)
        if period_s is None and for_any and self._watchers:
            period_s = POSITION_PERIOD_S
        return None if period_s is None else self._position_at + period_s

    def position_was_read(self, at: float) -> None:
        """Note that the position was read, for whatever reason."""
        self._position_at = at
        self.is_away = False
        self._spend(at, 1)

    @property
    def next_excursion_at(self) -> float:
        """When the budget allows another excursion."""
        return self._excursion_at

    def may_begin(self, now: float) -> bool:
        """Return whether another excursion is within the budget, at a monotonic time."""
        return self.excursion is None and now >= self._excursion_at

    def _spend(self, at: float, lines: int) -> None:
        self._lines.append((at, lines))
        while self._lines[0][0] <= at - BUDGET_S:
            self._lines.popleft()

    def reads_others(self, at: float) -> bool:
        """Return whether what was read of other features than the signal still counts in the budget at a time.

        Without that the periods of position and signal keep the budget by themselves.
        """
        return at < self._other_at + BUDGET_S

    def fits_at(self, at: float, lines: int) -> float:
        """Return from when on, `at` a time at the earliest, an excursion of so many lines keeps the budget.

        With a position a second from then on, in every stretch of `BUDGET_S`; its lines are taken to go out at once.
        """
        times = [at, *(then + BUDGET_S for then, _lines in self._lines if then + BUDGET_S > at)]
        return next((each for each in times if self._fits(each, lines)), times[-1])

    def _fits(self, at: float, lines: int) -> bool:
        """Return whether no stretch from a line that was sent to a position to come holds too many lines."""
        past = [(then, count) for then, count in self._lines if then > at - BUDGET_S]
        sent = sum(count for _then, count in past)
        for then, count in past:
            if sent + lines + 1 + math.floor(then - (at - BUDGET_S)) > BUDGET_LINES:
                return False
            sent -= count
        return True

    def begin(self, todo: Sequence[str], at: float, *, changes_menu: bool = True) -> None:
        """Begin an excursion at a monotonic time, to read these in turn."""
        lines = MENU_LINES if changes_menu else 0
        self.excursion = Excursion(deque(todo), at, lines, all(each == RSSI for each in todo))
        self._excursion_at = at + EXCURSION_PERIOD_S
        self.is_away = changes_menu and not self.excursion.only_signal
        self._spend(at, lines)

    def was_asked(self, feature: str, at: float, *, lines: int = 1, not_before: float = -math.inf) -> None:
        """Note that a feature was asked for at a monotonic time; `not_before`: when it may be again."""
        self._asked_at[feature] = at
        self._spend(at, lines)
        if feature != RSSI:
            self._other_at = at
        self._not_before[feature] = max(not_before, self._not_before.get(feature, -math.inf))
        excursion = self.excursion
        if excursion is None:
            return
        excursion.next_at = at + RSSI_PERIOD_S
        if feature == RSSI:
            excursion.next_at = max(excursion.next_at, not_before)
            self._excursion_at = max(self._excursion_at, not_before)
        if not excursion.todo:
            self.end_excursion()

    def was_told(self, feature: str, at: float) -> None:
        """Note that an answer told of a feature that was not asked for: it need not be, so soon."""
        self._asked_at[feature] = at
        if self.excursion is not None:
            self.excursion.todo = deque(each for each in self.excursion.todo if each != feature)

    def forget(self, feature: str) -> None:
        """What was read of a feature no longer counts: it is due as if it had never been asked for."""
        self._asked_at.pop(feature, None)

    def has_failed(self, feature: str, at: float, period_s: float, *, retry_s: float = RETRY_S) -> None:
        """Note that a feature was refused, or told nonsense: the others go on, and this one waits for its time."""
        if self.excursion is not None:
            self.excursion.todo = deque(each for each in self.excursion.todo if each != feature)
        self._not_before[feature] = at + max(period_s, retry_s)

    def end_excursion(self) -> None:
        """The dish is needed in the motor menu, or all was read."""
        if self.excursion is not None:
            self._position_at = 0.0
            if self._lines:
                self._spend(self._lines[-1][0], self.excursion.menu_lines)
        self.excursion = None
