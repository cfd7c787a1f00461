"""A meter as a source: read on a thread of its own while somebody watches, and begun anew when it fails."""

from __future__ import annotations

import threading
from collections.abc import Callable
from datetime import timedelta

from birdcage.base.clock import Clock
from birdcage.signal.listeners import Listeners
from birdcage.signal.meter import Meter, MeterError, MeterReading
from birdcage.signal.source import MONITOR, Hear, SignalFacts, SignalReading
from birdcage.station.access import StationAccess

SLICE_S = 0.2
"""How long one read may wait: so soon the end of watching is seen."""
AGAIN_S, LONGEST_S = 0.5, 5.0
"""After a failure it is begun anew so soon, twice as late each time, and at last so late."""
CLOSE_S = 1.0


class MeterSource:
    """Any thread may call it; no call waits but `close`."""

    def __init__(self, facts: SignalFacts, meter: Meter, clock: Clock, station: StationAccess) -> None:
        self._facts, self._meter, self._clock, self._station = facts, meter, clock, station
        self._readings: Listeners[SignalReading] = Listeners()
        self._watchers: tuple[str, ...] = ()
        self._lock = threading.Lock()
        self._changed = threading.Event()
        self._thread: threading.Thread | None = None
        self._trouble = ""
        self._next: Meter | None = None
        """What is read once the conversation under way is over."""

    @property
    def facts(self) -> SignalFacts:
        """What its readings mean."""
        return self._facts

    @property
    def meter(self) -> Meter:
        """What is read, or will be next."""
        return self._next or self._meter

    def replace(self, meter: Meter) -> None:
        """Read by another one from now on."""
        with self._lock:
            self._next = meter
            self._changed.set()

    @property
    def trouble(self) -> str:
        """Why nothing is read now."""
        return self._trouble

    def subscribe(self, hear: Hear) -> Callable[[], None]:
        """Tell every reading, on the source's thread."""
        return self._readings.add(hear)

    def watch(self, watcher: str, *, steady: bool = False) -> None:  # noqa: ARG002 - it tells at a rate of its own
        """Begin with the first watcher."""
        with self._lock:
            self._watchers = (*(each for each in self._watchers if each != watcher), watcher)
            if self._thread is None:
                self._changed.clear()
                self._thread = threading.Thread(target=self._run, name=f"signal {self._facts.id}", daemon=True)
                self._thread.start()
        self._own()

    def unwatch(self, watcher: str) -> None:
        """End it after the last watcher."""
        with self._lock:
            self._watchers = tuple(each for each in self._watchers if each != watcher)
            if not self._watchers:
                self._changed.set()
        self._own()

    def close(self) -> None:
        """End it, and wait for that a short time."""
        with self._lock:
            self._watchers = ()
            self._changed.set()
            thread = self._thread
        if thread is not None:
            thread.join(CLOSE_S)

    def _run(self) -> None:
        again_s = AGAIN_S
        while self._goes_on():
            try:
                again_s = self._converse(again_s)
            except MeterError as error:
                self._trouble = str(error)
            except Exception as fault:  # noqa: BLE001 - a traceback from here would land in the middle of a screen
                self._trouble = f"Reading stopped, a bug in birdcage: {fault!r}"
            finally:
                self._meter.close()
            self._changed.wait(again_s)
            again_s = min(2.0 * again_s, LONGEST_S)

    def _converse(self, again_s: float) -> float:
        """Read until the last watcher has gone; MeterError once it is over."""
        facts, heard_at = self._facts, self._clock.monotonic()
        self._meter.open()
        while not self._changed.is_set():
            level = self._meter.read(SLICE_S)
            now = self._clock.monotonic()
            if level is not None:
                heard_at, again_s, self._trouble = now, AGAIN_S, ""
                self._tell(level, now)
            elif now > heard_at + 2.0 * facts.pause_s:
                raise MeterError(f"The {facts.label} has told nothing for {2.0 * facts.pause_s:.0f} s.")
        return again_s

    def _goes_on(self) -> bool:
        """Whether somebody watches; else the thread ends here."""
        with self._lock:
            if self._next is not None:
                self._meter, self._next = self._next, None
            if self._watchers:
                self._changed.clear()
                return True
            self._thread, self._trouble = None, ""
            return False

    def _tell(self, level: MeterReading, now: float) -> None:
        utc = self._clock.utc() - timedelta(seconds=(now - level.at) * self._clock.rate)
        facts = self._facts
        reading = SignalReading(
            level.value, facts.unit, level.at, utc, facts.id, level.dwell_s, level.spectrum, level.n, level.scatter
        )
        self._readings.tell(reading)

    def _own(self) -> None:
        watchers = self._watchers
        owner = next((each for each in watchers if each != MONITOR), MONITOR) if watchers else ""
        if owner != self._station.state.signal_owners.get(self._facts.id, ""):
            self._station.own_signal(self._facts.id, owner)
