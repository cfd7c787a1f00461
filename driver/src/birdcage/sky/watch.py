"""Watches the sky for a face: what is up now, once a second, and what comes over, in a thread of its own.

The heavy libraries are loaded by that thread, which a face starts after its first paint; the search for passes is in a
process of its own where STOP must not wait for it. On a virtual clock there is no thread: a test calls `step`.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.clock import Clock
from birdcage.base.errors import StoreError
from birdcage.base.store import fingerprint
from birdcage.base.wake import Wake
from birdcage.sky.observer import Observer
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.search_job import SearchJob
from birdcage.sky.search_process import SearchFailed, SearchProcess
from birdcage.sky.watch_model import SkyNow, UpNow
from birdcage.sky.watch_source import Watched, frozen_set, read_catalogue

if TYPE_CHECKING:
    from birdcage.sky.propagate import Fleet

LOOK_S = 1.0
PUBLISH_S = 0.25
"""While a search goes on, what it found is published this often."""
LOOK_AT_FILE_S = 5.0
"""How often the file is looked at, which another program may have changed."""
BREATH_S = 0.002
"""Between two bites of work, so that who waits for the processor or the GIL gets it."""
ROLL_HOURS = 6.0
"""A search is done again when it is this old."""
MOST_FAILURES = 3
"""So many times a process that searches is replaced by another one."""


@dataclass(slots=True)
class _Orders:
    """What was asked for and not yet taken in. Written by any thread, under the lock."""

    observer: Observer | None
    limits: ReachLimits
    view: tuple[datetime, float, float] | None = None
    """A view time: from when on it runs (UTC, monotonic seconds), and how fast."""
    reload: bool = True


class SkyWatch:
    """Owns the reading of the catalogue, the look angles and the search. All methods but `step` return at once.

    `publish` is called on the watch's thread, with an immutable `SkyNow`.
    """

    def __init__(
        self, catalogue: Path, publish: Callable[[SkyNow], None], clock: Clock, *,
        observer: Observer | None = None, limits: ReachLimits | None = None, apart: bool = False,
    ) -> None:  # fmt: skip
        """Watch the satellites of the file `catalogue`. `apart`: search for passes in a process of its own."""
        self._path, self._publish, self._clock = catalogue, publish, clock
        self._orders = _Orders(observer, limits or ReachLimits())
        self._lock, self._wake = threading.Lock(), Wake()
        self._process = SearchProcess(catalogue, self._wake.set) if apart else None
        self._failures = 0
        self._thread: threading.Thread | None = None
        self._closing = False
        self.crash: BaseException | None = None
        """What ended the thread, if a fault of birdcage did."""
        # From here on for the watch's thread only.
        self._observer, self._limits = observer, self._orders.limits
        self._view: tuple[datetime, float, float] | None = None
        self._watched: Watched | None = None
        self._fleet: Fleet | None = None
        self._search: SearchJob | None = None
        self._next_search: SearchJob | None = None
        """One that replaces `_search` once it is done: the list keeps standing meanwhile."""
        self._seen: tuple[object, ...] = ()
        self._up: tuple[UpNow, ...] = ()
        self._look_at = self._publish_at = self._file_at = -math.inf
        self._untold = False
        """Whether something was found since the last publication."""

    # --- for any thread

    def start(self) -> None:
        """Begin to watch, in a daemon thread."""
        with self._lock:  # else `close` might join a thread that was not started yet
            self._thread = threading.Thread(target=self._run, name="sky", daemon=True)
            self._thread.start()

    def close(self, timeout_s: float = 0.1) -> None:
        """End the watch. A thread in the middle of a bite dies with the program if it takes longer."""
        self._closing = True
        self._wake.set()
        with self._lock:
            thread = self._thread
        if thread is not None:
            thread.join(timeout_s)
        if self._process is not None:
            self._process.close()
        if thread is None or not thread.is_alive():
            self._wake.close()

    def set_observer(self, observer: Observer | None) -> None:
        """Look from another place: the search under way is given up, its passes go."""
        with self._lock:
            self._orders.observer = observer
        self._wake.set()

    def set_limits(self, limits: ReachLimits) -> None:
        """Work out reach with other limits; passes stay."""
        with self._lock:
            self._orders.limits = limits
        self._wake.set()

    def set_view_time(self, when: datetime | None, rate: float = 1.0) -> None:
        """Look at another time, which runs at `rate` from now on (0 stands still); None for the clock's.

        The clock itself is not touched: nothing but what is published changes.
        """
        with self._lock:
            self._orders.view = None if when is None else (when, self._clock.monotonic(), rate)
        self._wake.set()

    def refresh(self) -> None:
        """Read the catalogue again."""
        with self._lock:
            self._orders.reload = True
        self._wake.set()

    # --- for the watch's thread

    def step(self) -> float:
        """Do one bite of work; return until when (monotonic seconds) there is nothing to do: now or earlier for more.

        Takes some 10 ms at most, but for the first one and those after a change of the catalogue.
        """
        try:
            return self._step()
        except SearchFailed:
            if self._process is None or self._closing or self._failures >= MOST_FAILURES:
                raise
            self._failures += 1
            self._process.close()
            self._search = self._next_search = None  # with the next step another one begins
            return self._clock.monotonic()

    def _step(self) -> float:
        self._take_in()
        now, monotonic = self._now(), self._clock.monotonic()
        if monotonic >= self._look_at:
            self._up = self._looks(now)
            self._look_at = monotonic + LOOK_S
            self._tell(now, monotonic)
            return monotonic
        if self._work(now):
            self._untold = True
            if monotonic >= self._publish_at:
                self._tell(now, monotonic)
            return monotonic
        if self._untold:
            self._tell(now, monotonic)
        current = self._next_search or self._search
        if current is not None and not current.idle:  # another process searches: look what it has found
            return min(self._look_at, monotonic + PUBLISH_S)
        return self._look_at

    def _run(self) -> None:
        try:
            while not self._closing:
                self._wake.clear()
                until = self.step()
                if not self._closing:
                    self._clock.wait(None, max(until, self._clock.monotonic() + BREATH_S), self._wake)
        except BaseException as crash:  # noqa: BLE001 - a face without a sky still drives its dish
            if self._closing:
                return
            # Kept for the face to tell: a traceback from this thread would land in the middle of its screen.
            self.crash = crash
            self._publish(SkyNow(self._clock.utc(), live=True, observer=None, note=f"The sky stopped: {crash!r}"))

    def _take_in(self) -> None:
        with self._lock:
            observer, limits, reload = self._orders.observer, self._orders.limits, self._orders.reload
            view, self._orders.reload = self._orders.view, False
        monotonic = self._clock.monotonic()
        if not reload and monotonic >= self._file_at:
            self._file_at = monotonic + LOOK_AT_FILE_S
            reload = fingerprint(self._path) != self._seen
        moved = observer != self._observer
        if moved:
            self._observer, self._search, self._next_search = observer, None, None
        if limits != self._limits:
            self._limits = limits
            for search in (self._search, self._next_search):
                if search is not None:
                    search.set_limits(limits)
        if reload:
            self._load()
        if reload or moved or view != self._view:
            self._view, self._look_at = view, monotonic
        self._keep_hunting(self._now(), anew=reload)

    def _load(self) -> None:
        from birdcage.sky.propagate import Fleet

        try:
            self._watched = read_catalogue(self._path)
        except StoreError as error:
            if self._watched is not None:
                self._watched = replace(self._watched, note=f"{error} Showing the elements read before.")
            else:
                self._watched = replace(frozen_set(), note=f"{error} Showing the elements that ship with birdcage.")
        self._seen = fingerprint(self._path)
        self._fleet = Fleet(self._watched.elements)

    def _keep_hunting(self, now: datetime, *, anew: bool) -> None:
        """Begin a search where there is none, or the one that is there no longer covers the time looked at."""
        if self._observer is None or self._watched is None:
            return
        latest = self._next_search or self._search
        stale = latest is None or not latest.start <= now < latest.start + timedelta(hours=ROLL_HOURS)
        if not (anew or stale):
            return
        search = self._begin_search(self._watched, self._observer, now)
        if self._search is None or not self._search.start <= now < self._search.ends():
            self._search, self._next_search = search, None
        else:
            self._next_search = search

    def _begin_search(self, watched: Watched, observer: Observer, now: datetime) -> SearchJob:
        # Passes that are under way shall be found whole: none of a low orbit lasts longer than half an hour.
        start = now - timedelta(minutes=30)
        if self._process is not None:
            return self._process.begin(observer, self._limits, start, now)
        from birdcage.sky.pass_search_job import PassSearchJob

        return PassSearchJob(watched, observer, self._limits, start)

    def _work(self, now: datetime) -> bool:
        if self._next_search is not None:
            worked = self._next_search.work(now)
            if self._next_search.idle:
                self._search, self._next_search = self._next_search, None
                return True
            return worked
        return self._search is not None and self._search.work(now)

    def _looks(self, now: datetime) -> tuple[UpNow, ...]:
        """Return everything above the horizon, highest first."""
        import numpy as np

        from birdcage.sky.illumination import sunlit

        if self._observer is None or self._fleet is None or self._watched is None:
            return ()
        looks = self._fleet.look(self._observer, now, self._watched.time_offsets)
        up = np.flatnonzero(looks.el_deg > 0.0)
        up = up[np.argsort(-looks.el_deg[up], kind="stable")]
        values = (looks.az_deg[up], looks.el_deg[up], looks.range_km[up])
        lit = sunlit(self._observer, np.array([now.timestamp()]), *values)
        favourites = self._watched.favourites
        columns = (value.tolist() for value in (*values, looks.range_rate_km_s[up], lit))
        return tuple(
            UpNow(one.name, one.norad_id, az, el, far, rate, shines, index in favourites, one)
            for index, one, az, el, far, rate, shines in zip(
                up.tolist(), (self._fleet[index] for index in up.tolist()), *columns, strict=True
            )
        )

    def _now(self) -> datetime:
        if self._view is None:
            return self._clock.utc()
        when, since, rate = self._view
        return when + timedelta(seconds=(self._clock.monotonic() - since) * rate)

    def _tell(self, now: datetime, monotonic: float) -> None:
        if self._closing:
            return
        self._publish_at, self._untold = monotonic + PUBLISH_S, False
        current = self._next_search or self._search
        self._publish(
            SkyNow(
                utc=now,
                live=self._view is None,
                observer=self._observer,
                up=self._up,
                passes=() if self._search is None else self._search.rows(now),
                searching=None if current is None else current.progress,
                satellites=0 if self._watched is None else len(self._watched.elements),
                note="" if self._watched is None else self._watched.note,
            )
        )
