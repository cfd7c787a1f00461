"""Takes what passes on the wire from the threads that read and write it, from the first byte on."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from datetime import datetime

from birdcage.base.errors import BirdcageError
from birdcage.station.raw import TranscriptEntry

KEPT = 5000
"""How many events wait at most for somebody who looks."""

OnWire = Callable[[Callable[[TranscriptEntry], None]], Callable[[], None]]
"""`FaceSession.on_wire`."""


class WireTap:
    """Keeps the newest events until they are taken, and counts all. `take_in` is for any thread, and quick."""

    def __init__(self, is_steering: Callable[[], bool], on_wire: OnWire) -> None:
        self._on_wire = on_wire
        self._begun = False
        self.problem = ""
        """Why nothing of the wire is heard, as a sentence."""
        self._lock = threading.Lock()
        self._is_steering = is_steering
        self._events: deque[tuple[TranscriptEntry, bool]] = deque(maxlen=KEPT)
        self._missed = 0
        self.bytes_in = 0
        self.bytes_out = 0
        self.since: datetime | None = None
        """When the first byte passed."""

    def begin(self) -> None:
        """Begin to hear the wire; a second time does nothing."""
        if self._begun:
            return
        self._begun = True
        try:
            self._on_wire(self.take_in)
        except BirdcageError as problem:
            self.problem = str(problem)

    def take_in(self, event: TranscriptEntry) -> None:
        """Take one event, and whether a pursuit has just sent it: later it would look like a STOP."""
        steering = event.direction == ">" and self._is_steering()
        with self._lock:
            if self.since is None:
                self.since = event.utc
            if event.direction == "<":
                self.bytes_in += len(event.data)
            elif event.direction == ">":
                self.bytes_out += len(event.data)
            if len(self._events) == KEPT:
                self._missed += 1
            self._events.append((event, steering))

    @property
    def waiting(self) -> bool:
        """Whether something has come that was not taken out."""
        return bool(self._events)

    def take_out(self) -> tuple[int, list[tuple[TranscriptEntry, bool]]]:
        """Return how many events were dropped before these, and these, each with whether a pursuit sent it."""
        with self._lock:
            missed, events = self._missed, list(self._events)
            self._missed = 0
            self._events.clear()
        return missed, events
