"""The timetable of a simulated dish: what happens when, in order, computed when somebody looks."""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Callable

from birdcage.base.clock import Clock


class Machine:
    """A queue of events on the clock's monotonic scale. Not thread-safe: its device holds the lock."""

    def __init__(self, clock: Clock) -> None:
        self.clock = clock
        self.now = clock.monotonic()
        self._events: list[tuple[float, int, Callable[[], None]]] = []
        self._order = itertools.count()
        self._running = False

    @property
    def dish_s(self) -> float:
        """Seconds of dish time: they run `clock.rate` times faster than the wire's."""
        return self.now * self.clock.rate

    def at_dish(self, dish_s: float, action: Callable[[], None]) -> None:
        """Have `action` done when dish time reaches `dish_s`."""
        self.at(dish_s / self.clock.rate, action)

    def at(self, time_s: float, action: Callable[[], None]) -> None:
        """Have `action` done at `time_s` on the monotonic scale."""
        heapq.heappush(self._events, (time_s, next(self._order), action))

    def next_event(self) -> float:
        """Return when the next thing happens by itself; inf for never."""
        return self._events[0][0] if self._events else math.inf

    def run(self) -> None:
        """Do everything that is due. Called by an action that this runs, it does nothing: `now` is the action's."""
        if self._running:
            return
        self._running = True
        try:
            until = self.clock.monotonic()
            while self._events and self._events[0][0] <= until:
                time_s, _, action = heapq.heappop(self._events)
                self.now = max(self.now, time_s)
                action()
            self.now = max(self.now, until)
        finally:
            self._running = False
