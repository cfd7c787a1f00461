"""Reads what is watched besides the position: each feature at its own cost, within the budget of the wire.

`docs/decisions/0048-watched-features.md`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from birdcage.base.errors import CommandRefused, NoReply
from birdcage.rotator.feature import RSSI, Feature, Reading
from birdcage.station.parts import Parts
from birdcage.station.state import Activity
from birdcage.station.watches import EXCURSION_PERIOD_S, MENU_LINES, NONSENSE, RETRY_S, RSSI_READS, STEADY_RETRY_S

MOVES_ON = (Activity.SLEWING, Activity.FOLLOWING, Activity.MOVING_UNASKED, Activity.MOTOR_RUN)
"""What a dish does while a feature may be read that costs it nothing then; homing and stowing are left alone."""
STEADY_OTHER_S = 2.5
"""The least time between two readings of other features, while the signal is watched steadily."""
LINE_MOVING_S = 1.0
"""How long the line of a dish that moves is left to the motion after each line that read a feature."""


class FeatureWatch:
    """One excursion at a time; `due`, then `tick`. The station's thread, while nothing that ranks higher is due."""

    def __init__(self, parts: Parts) -> None:
        self._store, self._antenna, self._reader, self._watches = (
            parts.store, parts.antenna, parts.reader, parts.watches
        )  # fmt: skip
        self._moving_at = -math.inf
        """When a dish that moves may be asked again."""
        self._other_at = self._away_at = -math.inf
        """When a steadily watched signal may wait for another feature again: of its own menu, and elsewhere."""
        self._told: set[str] = set()
        """What was told since it was last forgotten."""

    @property
    def _features(self) -> Mapping[str, Feature]:
        dish = self._store.state.dish
        return {} if dish is None else dish.features

    def due(self, now: float) -> float | None:
        """Return when something is to be read, `now` for at once; None if nothing watched may be read as things are."""
        activity = self._store.state.activity
        if activity not in (Activity.IDLE, Activity.FOLLOWING):
            self._watches.end_excursion()  # what STOP or a motion has cut short is not taken up again
        if activity is Activity.IDLE:
            return self._due_at_rest(now)
        return self._due_moving() if activity in MOVES_ON else None

    def _due_at_rest(self, now: float) -> float | None:
        if self._is_steady:
            self._watches.end_excursion()
            return self._steadily(self._watches.periods_s(self._features))[0] if self._reader.may_leave else None
        excursion, periods = self._watches.excursion, self._watches.periods_s(self._features)
        if excursion is not None:
            if any(each in periods for each in excursion.todo):
                return excursion.next_at
            self._watches.end_excursion()  # whoever looked has looked away
        if not periods or not self._reader.may_leave:
            return None
        times = [self._due_of(name, period_s) for name, period_s in periods.items()]
        at = max(self._watches.next_excursion_at, now, min(times))
        return self._fits_at(at, self._plan(at, periods))

    def _due_of(self, name: str, period_s: float) -> float:
        """When a feature is due: by its watchers, and not before its machine may be asked for it again."""
        if name in self._told and name not in self._store.state.readings:
            self._told.discard(name)  # the dish may be another one
            self._watches.forget(name)
        last = self._store.state.readings.get(name)  # a survey, or a person, may have asked for it
        told_at = -math.inf if last is None or name == RSSI else last.at
        return max(self._watches.due(name, period_s), told_at + period_s, self._reader.not_before(name))

    def tick(self) -> None:
        """Read what is due now."""
        now, periods = self._store.clock.monotonic(), self._watches.periods_s(self._features)
        if self._store.state.activity in MOVES_ON:
            self._read_moving(now, periods)
            return
        if self._is_steady:
            self._read_steadily(now, periods)
            return
        if self._watches.excursion is None:
            self._begin(now, periods)
        excursion = self._watches.excursion
        while excursion is not None and excursion.todo:
            name = excursion.todo.popleft()
            if name in periods:  # else whoever looked at it has looked away
                self._read(name, periods[name], now)
                return
        self._watches.end_excursion()

    def _fits_at(self, at: float, todo: Sequence[Feature]) -> float:
        """Return when the budget allows to read these, `at` a time at the earliest."""
        if not todo or (all(each.id == RSSI for each in todo) and not self._watches.reads_others(at)):
            return at
        lines = sum(each.cost.lines for each in todo)
        return self._watches.fits_at(at, lines + (2 * MENU_LINES if todo[0].cost.menu else 0))

    def _plan(self, at: float, periods: Mapping[str, float]) -> list[Feature]:
        """Return what to read in an excursion at a time: what has waited longest, and what else is due in its menu."""
        due = [self._features[name] for name, period_s in periods.items() if self._due_of(name, period_s) <= at]
        # The signal goes first where several were never asked for: it is what somebody looks at.
        due.sort(key=lambda each: (self._watches.asked_at(each.id), each.id != RSSI))
        here = [each for each in due if each.cost.menu == due[0].cost.menu]
        signal = next((each for each in here if each.id == RSSI), None)
        signal_lines = 0 if signal is None else max(1, signal.cost.lines)
        left, todo = RSSI_READS, list[Feature]()
        for each in here:
            if each is not signal and (each.cost.lines <= left - signal_lines or each is due[0]):
                todo.append(each)
                left -= each.cost.lines
        if signal is not None:  # as often as there is room
            todo += [signal] * (max(left, 0) // signal_lines or int(signal is due[0]))
        return todo

    def _begin(self, now: float, periods: Mapping[str, float]) -> None:
        """Go where what has waited longest is read."""
        todo = self._plan(now, periods)
        if todo and self._fits_at(now, todo) <= now:
            self._watches.begin([each.id for each in todo], now, changes_menu=todo[0].cost.menu is not None)

    def _read(self, name: str, period_s: float, now: float, lines: int | None = None) -> None:
        """Read one feature. One that the dish refuses, or tells nonsense of, ends nothing but its own reading."""
        watches, lines = self._watches, self._features[name].cost.lines if lines is None else lines
        told: Mapping[str, Reading]
        try:
            told = self._reader.features([name])
        except CommandRefused as refused:
            if refused.trouble is not None:
                raise
            watches.has_failed(name, now, period_s)
            told = {}
        except NoReply as damaged:
            if damaged.reason not in NONSENSE or not self._reader.may_leave:
                raise
            retry_s = STEADY_RETRY_S if name == RSSI and self._is_steady else RETRY_S
            watches.has_failed(name, now, period_s, retry_s=retry_s)
            told = {}
        # What the same answer told of others need not be asked for, either.
        for other in set(told) - {name}:
            watches.was_told(other, now)
        self._told |= set(told)
        at = now if name == RSSI else self._store.clock.monotonic()
        watches.was_asked(name, at, lines=lines, not_before=self._reader.not_before(name))

    # While the signal is watched steadily: its menu is home, and the position is the excursion

    @property
    def _is_steady(self) -> bool:
        """Whether the signal is read one time after the other; each reading takes as long as the wire does."""
        return self._watches.steady_period_s is not None and RSSI in self._features

    def _steadily(self, periods: Mapping[str, float]) -> tuple[float, str]:
        """Return what is due next, and when: the signal, or at times what else has waited longest."""
        signal_s = self._watches.steady_period_s
        assert signal_s is not None, "it is watched steadily"
        times = [(self._due_of(RSSI, signal_s), RSSI)]
        for name, period_s in periods.items():
            if name != RSSI:
                pause_over_at = max(self._other_at, self._away_at if self._is_away(name) else -math.inf)
                times.append((max(self._due_of(name, period_s), pause_over_at), name))
        return min(times, key=lambda each: (each[0], self._watches.asked_at(each[1]), each[1]))

    def _is_away(self, name: str) -> bool:
        return self._features[name].cost.menu != self._features[RSSI].cost.menu

    def _read_steadily(self, now: float, periods: Mapping[str, float]) -> None:
        at, name = self._steadily(periods)
        if at > now:
            return
        if name != RSSI:
            self._other_at = now + STEADY_OTHER_S
            self._away_at = now + EXCURSION_PERIOD_S if self._is_away(name) else self._away_at
        self._read(name, periods[name], now, lines=0)  # its rate is its own, not the budget of a dish at rest

    # While it moves

    def _may_be_read_moving(self) -> dict[str, float]:
        motion, features = self._antenna.motion, self._features
        if self._watches.excursion is not None or (motion is not None and motion.silent):
            return {}  # any byte may end a silent slew
        periods = self._watches.periods_s(features)
        return {name: period_s for name, period_s in periods.items() if features[name].cost.while_moving}

    def _due_moving(self) -> float | None:
        times = [self._due_of(name, period_s) for name, period_s in self._may_be_read_moving().items()]
        return max(self._moving_at, min(times)) if times else None

    def _read_moving(self, now: float, periods: Mapping[str, float]) -> None:
        due = [name for name, period_s in self._may_be_read_moving().items() if self._due_of(name, period_s) <= now]
        if not due:
            return
        name = min(due, key=self._watches.asked_at)
        cost = self._features[name].cost
        self._moving_at = now + LINE_MOVING_S * cost.lines
        if cost.menu is None:
            self._read(name, periods[name], now)
            return
        self._moving_at = max(self._moving_at, now + EXCURSION_PERIOD_S)
        self._reader.elsewhere = True  # STOP has to come back to the motor menu first, and look
        self._read(name, periods[name], now)
        self._antenna.rotator.make_ready()
        self._reader.elsewhere = False
