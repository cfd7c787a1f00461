"""The events of a station for one caller in another process.

The station's thread appends to a queue and goes on; the caller's thread sends. A caller that does not read fast enough
fills its own queue, is told that it has missed some, and is dropped.
"""

from __future__ import annotations

import contextlib
import logging
import selectors
import socket
import threading
import time
from collections import deque

from birdcage.base.errors import BadMessage
from birdcage.base.wake import Wake
from birdcage.station.control_messages import ENDS, EndOfEvents, as_line
from birdcage.station.events import Event
from birdcage.station.json_form import to_json
from birdcage.station.station import Station

LONGEST_QUEUE = 500
"""Events that wait for one caller: a minute or more of a dish that is followed."""
KERNEL_BYTES = 65536
"""What the system keeps for one caller, beside the queue."""
LAST_LINE_S = 10.0
"""How long a caller that was slow, or that a program takes leave of, may take to read the last line."""

log = logging.getLogger(__name__)


class EventStream:
    """Begins with what happens after it was made. Use it in a `with`; `send` runs until either side ends it."""

    def __init__(self, station: Station) -> None:
        self._queue: deque[Event] = deque()
        self._lock = threading.Lock()
        self._ended: EndOfEvents | None = None
        self._wake = Wake()
        self._unsubscribe = station.subscribe(self._hear)

    def __enter__(self) -> EventStream:
        return self

    def __exit__(self, *_: object) -> None:
        self._unsubscribe()
        self._wake.close()

    def end(self, why: EndOfEvents) -> None:
        """Send what waits, then a last line. Any thread."""
        with self._lock:
            self._ended = self._ended or why
        self._wake.set()

    def _hear(self, event: Event) -> None:
        """Queue an event. On the station's thread: nothing here waits for a caller."""
        with self._lock:
            if self._ended is None:
                self._queue.append(event)
                if len(self._queue) > LONGEST_QUEUE:
                    self._queue.clear()
                    self._ended = EndOfEvents.SLOW
        self._wake.set()

    def send(self, line: socket.socket) -> None:
        """Send events until the caller hangs up, or the stream ends. OSError when the caller is gone."""
        line.setblocking(False)
        line.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, KERNEL_BYTES)
        until: float | None = None
        with selectors.DefaultSelector() as selector:
            selector.register(self._wake, selectors.EVENT_READ)
            selector.register(line, selectors.EVENT_READ)
            rest, is_last = self._next()
            while until is None or time.monotonic() < until:
                selector.modify(line, selectors.EVENT_READ | (selectors.EVENT_WRITE if rest else 0))
                ready = {key.fileobj: mask for key, mask in selector.select(until and until - time.monotonic())}
                if self._wake in ready:
                    self._wake.clear()
                if until is None and self._ended is not None:
                    until = time.monotonic() + LAST_LINE_S
                with contextlib.suppress(BlockingIOError):
                    if ready.get(line, 0) & selectors.EVENT_READ and not line.recv(4096):
                        return  # the caller has hung up
                    if ready.get(line, 0) & selectors.EVENT_WRITE:
                        rest = rest[line.send(rest) :]
                if not rest:
                    if is_last:
                        return
                    rest, is_last = self._next()

    def _next(self) -> tuple[bytes, bool]:
        """Return the next line to send, and whether it is the last one; nothing if none waits."""
        while True:
            with self._lock:
                event = self._queue.popleft() if self._queue else None
                why = self._ended
            if event is None:
                return (b"", False) if why is None else (as_line(to_json(ENDS[why])), True)
            try:
                return as_line(to_json(event)), False
            except BadMessage as error:
                log.warning("an event is not told to other programs: %s", error)
