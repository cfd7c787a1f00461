"""A simulated receiver in memory: what `sim:rig` opens."""

from __future__ import annotations

import math
import threading

from birdcage.sim.rig import SimReceiver

LONGEST_LINE = 4096


class RigLines:
    """Bytes in, bytes out: one client's conversation."""

    def __init__(self, rig: SimReceiver) -> None:
        self._rig = rig
        self._left = b""
        self.over = False
        """Whether the client has taken its leave, or talks no protocol."""

    def take(self, data: bytes) -> bytes:
        """Return what is answered to bytes that came."""
        *lines, self._left = (self._left + data).split(b"\n")
        self.over = len(self._left) > LONGEST_LINE
        out = ""
        for line in lines:
            text = line.decode("utf-8", "replace").strip()
            if text in ("q", "Q", "\\quit"):
                self.over = True
                out += "RPRT 0\n"  # Hamlib's own client waits for it
                break
            out += self._rig.answer(text)
        return out.encode()


class RigPort:
    """A `Port` to it; it answers at once. Methods may be called from different threads at the same time."""

    demo = True
    name = "sim:rig"

    def __init__(self, rig: SimReceiver) -> None:
        self.rig = rig
        self._lines = RigLines(rig)
        self._inbox = b""
        self._closed = False
        self._lock = threading.Lock()

    def fileno(self) -> int | None:
        """Return None: there is no descriptor, but a timetable."""
        return None

    def pending(self) -> bool:
        """Return whether `read` has something to say."""
        return bool(self._inbox) or self._closed

    def next_event(self) -> float | None:
        """Return inf: nothing comes by itself; -inf where there is something."""
        return -math.inf if self.pending() else math.inf

    def read(self) -> bytes:
        """Return what was answered. ConnectionError once it hung up."""
        with self._lock:
            if self._closed and not self._inbox:
                raise ConnectionError(f"{self.name}: hung up")
            data, self._inbox = self._inbox, b""
            return data

    def write(self, data: bytes) -> None:
        """Send to it. ConnectionError once it hung up."""
        with self._lock:
            if self._closed:
                raise ConnectionError(f"{self.name}: hung up")
            self._inbox += self._lines.take(data)
            self._closed = self._lines.over

    def discard(self) -> None:
        """Throw away what was not read."""
        with self._lock:
            self._inbox = b""

    def close(self) -> None:
        """Hang up; a second time does nothing."""
        self._closed = True
