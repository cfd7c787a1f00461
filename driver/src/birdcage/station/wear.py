"""Counts the wear of a station's dish, and hands it on now and then."""

from __future__ import annotations

import math

from birdcage.antenna.odometer import AxisWay
from birdcage.base.wear import Wear, WearBook
from birdcage.station.station import Station

EVERY_S = 10.0
"""How often it is written while the dish moves: a stream has several commands a second."""
DEMO = " (demo)"
WEAR = "wear"
"""Under which subject a station warns that wear is not being kept."""


def dish_key(name: str, *, demo: bool) -> str:
    """Return under which name the wear of a dish is kept: a simulated one wears nothing real."""
    return f"{name}{DEMO}" if demo else name


def is_demo(key: str) -> bool:
    """Return whether a `dish_key` is of a simulated dish."""
    return key.endswith(DEMO)


class WearTally:
    """Adds up on the station's thread."""

    def __init__(self, station: Station, book: WearBook) -> None:
        self._station, self._book = station, book
        self._sums: dict[int, list[float]] = {}
        self._direction: dict[int, float] = {}
        self._written_at = -math.inf
        self._problem: str | None = None

    def take(self, way: AxisWay) -> None:
        """Take in that an axis was sent on; nothing counts that is no longer than half a step."""
        model = self._station.state.dish
        if model is None or abs(way.deg) < model.numbered[way.axis].step_deg / 2:
            return
        direction, before = math.copysign(1.0, way.deg), self._direction.get(way.axis)
        self._direction[way.axis] = direction
        sums = self._sums.setdefault(way.axis, [0.0, 0.0, 0.0])
        sums[0] += 1
        sums[1] += abs(way.deg)
        sums[2] += before is not None and direction != before
        now = self._station.clock.monotonic()
        if now >= self._written_at + EVERY_S:
            self._written_at = now
            self.write()

    def write(self) -> None:
        """Hand on what was counted since, and warn where what was handed on before could not be kept."""
        if self._book.problem != self._problem:
            self._problem = self._book.problem
            self._station.warn(WEAR, self._problem or "")
        state = self._station.state
        if state.dish is None:
            return
        key, day = dish_key(state.dish.name, demo=state.demo), self._station.clock.utc().date()
        for axis, (moves, degrees, reversals) in self._sums.items():
            self._book.add(key, Wear(axis, int(moves), degrees, int(reversals)), day)
        self._sums.clear()


def keep_wear(station: Station, book: WearBook) -> WearTally:
    """Count from now on; `WearTally.write` hands on the rest at the end."""
    tally = WearTally(station, book)
    station.on_way(tally.take)
    return tally
