"""Lines both ways over one socket: one thread reads and waits, any thread sends."""

from __future__ import annotations

import contextlib
import selectors
import socket
import threading
import time

from birdcage.base.wake import Wake
from birdcage.station.json_lines import CHUNK


class DuplexLines:
    """The lines of one peer. What the system does not take at once is sent by the thread that waits."""

    def __init__(self, line: socket.socket, longest: int, ahead: bytes = b"") -> None:
        """Take over an open socket; `longest` bytes make a line, `ahead` is what was read of it already."""
        self._line, self._longest = line, longest
        self._got = bytearray(ahead)
        self._searched = 0
        self._out = bytearray()
        self._lock = threading.Lock()
        self._wake = Wake()
        self.gone = False
        """Whether the peer has hung up, or can't be reached."""
        self._selector = selectors.DefaultSelector()
        self._selector.register(line, selectors.EVENT_READ)
        self._selector.register(self._wake, selectors.EVENT_READ)
        line.setblocking(False)
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def send(self, data: bytes) -> None:
        """Send: what the system takes now is out when this returns, and the rest follows. Any thread."""
        with self._lock:
            if not self._out:
                data = data[self._put(data) :]
            self._out += data
        if data:
            self._wake.set()

    @property
    def unsent(self) -> int:
        """How many bytes wait."""
        return len(self._out)

    def wake(self) -> None:
        """Make `wait` return soon. Any thread."""
        self._wake.set()

    def wait(self, timeout_s: float | None) -> None:
        """Wait for bytes, for room to send, for `wake`, or for so long; read what has come, send what waits."""
        if self.gone or self._has_line():
            timeout_s = 0.0
        events = selectors.EVENT_READ | (selectors.EVENT_WRITE if self._out else 0)
        self._selector.modify(self._line, events)
        ready = {key.fileobj: mask for key, mask in self._selector.select(timeout_s)}
        if self._wake in ready:
            self._wake.clear()
        if ready.get(self._line, 0) & selectors.EVENT_WRITE:
            with self._lock:
                del self._out[: self._put(bytes(self._out))]
        if ready.get(self._line, 0) & selectors.EVENT_READ and not self.gone:
            self._take_in()

    def _take_in(self) -> None:
        try:
            chunk = self._line.recv(CHUNK)
        except BlockingIOError:
            return
        except OSError:
            chunk = b""
        self.gone = not chunk
        self._got += chunk

    def next_line(self) -> bytes | None:
        """Return the next whole line that has come; None if there is none. ValueError for one that is too long."""
        if not self._has_line():
            if len(self._got) > self._longest:
                raise ValueError(f"more than {self._longest} bytes")
            return None
        end = self._searched
        if end >= self._longest:
            raise ValueError(f"more than {self._longest} bytes")
        taken = bytes(self._got[: end + 1])
        del self._got[: end + 1]
        self._searched = 0
        return taken

    def finish(self, within_s: float) -> None:
        """Hang up so that the peer reads all that was sent: closing with something unread here could take it back.

        On the thread that waits. Waits for the peer to hang up, too, for so long at most.
        """
        until, told = time.monotonic() + within_s, False
        while not self.gone and (left_s := until - time.monotonic()) > 0.0:
            if not self._out and not told:
                told = True
                with contextlib.suppress(OSError):
                    self._line.shutdown(socket.SHUT_WR)
            self._got.clear()
            self._searched = 0
            self.wait(left_s)
        self.close()

    def close(self) -> None:
        """Hang up. On the thread that waits."""
        self._selector.close()
        with self._lock:
            self.gone = True
            self._out.clear()
            with contextlib.suppress(OSError):
                self._line.shutdown(socket.SHUT_RDWR)
            self._line.close()
        self._wake.close()

    def _has_line(self) -> bool:
        end = self._got.find(b"\n", self._searched)
        self._searched = len(self._got) if end < 0 else end
        return end >= 0

    def _put(self, data: bytes) -> int:
        """Hand bytes to the system, with the lock; return how many it took."""
        if self.gone:
            return len(data)
        try:
            return self._line.send(data)
        except BlockingIOError:
            return 0
        except OSError:
            self.gone = True
            return len(data)
