"""What passes on the wire, for one attached program: while it wants that, and after all that matters more."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable

from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.station.attach_messages import WirePiece, wire_to_json
from birdcage.station.control_messages import as_line
from birdcage.station.raw import TranscriptEntry
from birdcage.station.station import Station

KEPT = 2000
"""Pieces that wait for one caller: a minute of a dish that is followed. The oldest are dropped, counted and told."""
AT_ONCE = 100
"""Pieces in one line: an answer or an event that comes meanwhile waits for no more."""
OnWire = Callable[[Callable[[TranscriptEntry], None]], Callable[[], None]]
"""`Session.on_wire`."""


class WireStream:
    """`next_line` is for the thread that sends; what is heard comes on whichever thread read or wrote."""

    def __init__(self, station: Station, on_wire: OnWire | None, wake: Callable[[], None]) -> None:
        self._station, self._on_wire, self._wake = station, on_wire, wake
        self._lock = threading.Lock()
        self._pieces: deque[WirePiece] = deque(maxlen=KEPT)
        self._missed = 0
        self._end: Callable[[], None] | None = None

    def hear(self, *, on: bool) -> None:
        """Begin to hear the wire, or end that. CommandRefused where this program can't hear its own."""
        if not on:
            self.close()
        elif self._on_wire is None:
            raise CommandRefused("This program does not pass on its wire.", reason=Reason.UNSUPPORTED)
        elif self._end is None:
            self._end = self._on_wire(self._take)

    def close(self) -> None:
        """Hear no more."""
        if self._end is not None:
            self._end()
            self._end = None
        with self._lock:
            self._pieces.clear()
            self._missed = 0

    def next_line(self) -> bytes:
        """Return the next line to send; empty if nothing waits."""
        if not self._pieces:
            return b""
        with self._lock:
            pieces = [self._pieces.popleft() for _ in range(min(AT_ONCE, len(self._pieces)))]
            missed, self._missed = self._missed, 0
        return as_line(wire_to_json(pieces, missed))

    def _take(self, entry: TranscriptEntry) -> None:
        """Keep a piece, and whether a pursuit has just sent it: later it would look like a STOP."""
        piece = WirePiece(entry, entry.direction == ">" and self._station.is_steering())
        with self._lock:
            self._missed += len(self._pieces) == KEPT
            self._pieces.append(piece)
        self._wake()
