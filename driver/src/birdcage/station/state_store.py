"""Where the station writes what it knows, and from where everybody reads it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from types import MappingProxyType
from typing import Unpack

from birdcage.base.clock import Clock
from birdcage.rotator.feature import Reading, Value
from birdcage.station.events import Event, ReadingRead
from birdcage.station.state import StationState
from birdcage.station.state_changes import StateChanges

Listener = Callable[[Event], None]
StateWatcher = Callable[[StationState], None]


class StateStore:
    """The present `StationState`, replaced as a whole, and the listeners to events."""

    def __init__(self, clock: Clock, state: StationState) -> None:
        self.clock = clock
        self.state = state
        """What is known now: immutable. Any thread reads it, the methods below alone replace it."""
        self._lock = threading.Lock()
        self._listeners: tuple[tuple[Listener, tuple[type[Event], ...]], ...] = ()
        self._watchers: tuple[StateWatcher, ...] = ()

    def stamp(self) -> tuple[float, datetime]:
        """Return the monotonic and UTC time of an event that happens now."""
        return self.clock.monotonic(), self.clock.utc()

    def change(self, **changes: Unpack[StateChanges]) -> None:
        """Replace fields of the state. Any thread."""
        with self._lock:
            self._replace(replace(self.state, **changes))

    def put(self, state: StationState) -> None:
        """Replace the whole state. Any thread."""
        with self._lock:
            self._replace(state)

    def warn(self, subject: str, sentence: str) -> None:
        """Set or drop one of the warnings. Any thread."""
        with self._lock:
            warnings = {name: words for name, words in self.state.warnings.items() if name != subject}
            if sentence:
                warnings[subject] = sentence
            self._replace(replace(self.state, warnings=MappingProxyType(warnings)))

    def own_signal(self, source: str, holder: str) -> None:
        """Note who owns a signal source; empty: it is free. Any thread."""
        with self._lock:
            owners = {name: owner for name, owner in self.state.signal_owners.items() if name != source}
            if holder:
                owners[source] = holder
            self._replace(replace(self.state, signal_owners=MappingProxyType(owners)))

    def watch(self, watcher: StateWatcher) -> Callable[[], None]:
        """Call `watcher` with each new state, at once with the present one; the result ends that. Any thread.

        It is called under the store's lock, on the thread that changed the state: note it, and return.
        """
        with self._lock:
            self._watchers += (watcher,)
            watcher(self.state)

        def end() -> None:
            with self._lock:
                self._watchers = tuple(other for other in self._watchers if other is not watcher)

        return end

    def _replace(self, state: StationState) -> None:
        """With the lock, so that watchers see states in their order."""
        self.state = state
        for watcher in self._watchers:
            watcher(state)

    def subscribe(self, listener: Listener, *kinds: type[Event]) -> Callable[[], None]:
        """Tell `listener` the events of these kinds, all by default, on the station's thread. Returns what ends it."""
        with self._lock:
            self._listeners += ((listener, kinds),)

        return lambda: self._drop(listener)

    def _drop(self, listener: Listener) -> None:
        with self._lock:
            self._listeners = tuple(other for other in self._listeners if other[0] is not listener)

    def tell(self, event: Event) -> None:
        """Tell all listeners. What one raises is raised; it is not told anything more."""
        for listener, kinds in self._listeners:
            if kinds and not isinstance(event, kinds):
                continue
            try:
                listener(event)
            except BaseException:
                self._drop(listener)
                raise

    def read(self, feature: str, value: Value, unit: str = "", stamp: tuple[float, datetime] | None = None) -> None:
        """Note a value that the dish has just told; `stamp` is when it was measured, if that was not now."""
        at, utc = stamp or self.stamp()
        readings = {**self.state.readings, feature: Reading(value, unit, at, utc)}
        self.change(readings=MappingProxyType(readings))
        self.tell(ReadingRead(at, utc, feature, value, unit))

    def forget_readings(self, prefix: str = "") -> None:
        """Drop the values whose name begins so, all by default: the dish may have changed."""
        kept = {name: value for name, value in self.state.readings.items() if not name.startswith(prefix)}
        self.change(readings=MappingProxyType(kept))
