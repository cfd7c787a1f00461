"""A search for passes in small bites, so that whoever waits for the same processor or the GIL waits for milliseconds.

SGP4 over many satellites holds the GIL: a STOP key that is pressed meanwhile would wait for a whole catalogue.
"""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime, timedelta

import numpy as np

from birdcage.sky.observer import Observer
from birdcage.sky.pass_row import PassRow, rows_of
from birdcage.sky.passes.search import search
from birdcage.sky.passes.table import PassTable
from birdcage.sky.propagate import Fleet
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.search_job import FAVOURITES_HOURS, MOST_OTHERS, OTHERS_HOURS
from birdcage.sky.watch_source import Watched

_AT_ONCE = 32
"""Satellites to a bite of the search: some 5 ms."""
_ROWS = 4
"""Rows to a bite: about as long."""
_ROWS_EACH = 12
"""Rows that are worked out between two bites of the search."""

_Key = tuple[int, int]


class PassSearchJob:
    """A `SearchJob` that the caller's own thread does."""

    def __init__(self, watched: Watched, observer: Observer, limits: ReachLimits, start: datetime) -> None:
        self.start = start
        self.idle = False
        self._observer, self._limits = observer, limits
        favourites = sorted(watched.favourites)
        others = [index for index in range(len(watched.elements)) if index not in watched.favourites]
        self._jobs = [(part, FAVOURITES_HOURS) for part in _parts(favourites)]
        self._jobs += [(part, OTHERS_HOURS) for part in _parts(others)]
        self._watched = watched
        self._all, self._done, self._between = len(self._jobs), 0, 0
        self._found: list[tuple[Watched, PassTable]] = []
        self._rows: dict[_Key, PassRow] = {}
        self._fresh: list[PassRow] = []
        self._times = np.empty((0, 2))
        """AOS and LOS of every pass found, in order of AOS; the two below go with it."""
        self._keys = np.empty((0, 2), dtype=np.int64)
        self._favourite = np.empty(0, dtype=np.bool_)
        self._wanted: tuple[int, list[_Key]] | None = None

    @property
    def progress(self) -> float | None:
        """How much of the catalogue was searched; None when all of it was."""
        return None if self._done == self._all else self._done / self._all

    def ends(self) -> datetime:
        """Return up to when passes of all satellites are searched for."""
        return self.start + timedelta(hours=OTHERS_HOURS)

    def set_limits(self, limits: ReachLimits) -> None:
        """Take other limits: reach is worked out anew, passes stay."""
        self._limits, self.idle = limits, False
        self._rows.clear()
        self._fresh.clear()

    def work(self, now: datetime) -> bool:
        """Do one bite; False if there was nothing to do."""
        missing = [key for key in self._order(now) if key not in self._rows]
        if self._done < self._all and (not missing or self._between >= _ROWS_EACH):
            self._search()
            self._between = 0
            return True
        for number, index in missing[:_ROWS]:
            watched, table = self._found[number]
            (row,) = rows_of(table, watched, self._observer, self._limits, [index])
            self._rows[number, index] = row
            self._fresh.append(row)
        self._between += _ROWS
        self.idle = not missing
        return bool(missing)

    def fresh(self) -> list[PassRow]:
        """Return the rows that were worked out since the last call."""
        fresh, self._fresh = self._fresh, []
        return fresh

    def rows(self, now: datetime) -> tuple[PassRow, ...]:
        """Return the rows so far of passes that are not over, in order of AOS."""
        return tuple(self._rows[key] for key in self._order(now) if key in self._rows)

    def _search(self) -> None:
        part, hours = self._jobs[self._done]
        watched = self._watched.part(part)
        table = search(Fleet(watched.elements), self._observer, self.start, hours, 0.0, watched.time_offsets)
        number = len(self._found)
        self._found.append((watched, table))
        self._done += 1
        times = np.concatenate([self._times, np.stack([table.aos_s, table.los_s], axis=1)])
        keys = np.stack([np.full(len(table), number), np.arange(len(table))], axis=1)
        favourite = np.full(len(table), hours == FAVOURITES_HOURS)
        order = np.argsort(times[:, 0], kind="stable")
        self._times = times[order]
        self._keys = np.concatenate([self._keys, keys])[order]
        self._favourite = np.concatenate([self._favourite, favourite])[order]
        self._wanted = None

    def _order(self, now: datetime) -> list[_Key]:
        """Return which passes are wanted, in order of AOS; looked up once a second."""
        second = int(now.timestamp())
        if self._wanted is None or self._wanted[0] != second:
            coming = self._times[:, 1] > second
            others = coming & ~self._favourite
            wanted = (coming & self._favourite) | (others & (np.cumsum(others) <= MOST_OTHERS))
            self._wanted = second, [(int(number), int(index)) for number, index in self._keys[wanted]]
        return self._wanted[1]


def _parts(indices: list[int]) -> Iterable[list[int]]:
    return (indices[begin : begin + _AT_ONCE] for begin in range(0, len(indices), _AT_ONCE))
