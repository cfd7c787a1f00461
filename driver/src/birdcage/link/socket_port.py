"""`socket://host:port`: a serial server that speaks plain TCP.

Ours and not pyserial's, as that one throws away what arrives first, has no descriptor to select on, and sleeps for
0.3 s when it closes.
"""

from __future__ import annotations

import select
import socket

from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason

CONNECT_TIMEOUT_S = 3.0
WRITE_TIMEOUT_S = 0.2


class SocketPort:
    """A `Port` over one TCP connection."""

    demo = False

    def __init__(self, connected: socket.socket, name: str) -> None:
        self.name = name
        self._socket = connected
        connected.setblocking(False)
        connected.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def fileno(self) -> int | None:
        """Return the socket's descriptor."""
        descriptor = self._socket.fileno()
        return None if descriptor < 0 else descriptor

    def next_event(self) -> float | None:
        """Return None: when the dish will speak is unknown."""
        return None

    def pending(self) -> bool:
        """Return whether `read` will return bytes or tell that the connection is gone."""
        return bool(select.select([self._socket], [], [], 0)[0])

    def read(self) -> bytes:
        """Return what has arrived; ConnectionError when the other end has closed."""
        try:
            data = self._socket.recv(65536)
        except BlockingIOError:
            return b""
        if not data:
            raise ConnectionError("the other end closed the connection")
        return data

    def write(self, data: bytes) -> None:
        """Hand `data` to the system."""
        rest = memoryview(data)
        while rest:
            try:
                rest = rest[self._socket.send(rest) :]
            except BlockingIOError:
                if not select.select([], [self._socket], [], WRITE_TIMEOUT_S)[1]:
                    raise LinkError(
                        f"{self.name} takes no more bytes. The dish may have missed the last command: "
                        "check the network and the serial server, then reconnect.",
                        reason=Reason.FAILED,
                    ) from None

    def discard(self) -> None:
        """Throw away what was not read; what was sent cannot be called back."""
        while self.pending():
            self.read()

    def close(self) -> None:
        """Close the connection; a second time does nothing."""
        self._socket.close()


def connect(host: str, port: int, name: str) -> SocketPort:
    """Connect within 3 s; OSError without an answer."""
    return SocketPort(socket.create_connection((host, port), CONNECT_TIMEOUT_S), name)
