"""A simulated dish behind a TCP port of this machine, for `socket://127.0.0.1:PORT` or a scheme of its own."""

from __future__ import annotations

import contextlib
import socket

from birdcage.sim.channel import LONGEST_BACKLOG


class TcpChannel:
    """Listens on 127.0.0.1, on a port that the system chooses; a second client waits until the first has gone."""

    def __init__(self, scheme: str = "socket") -> None:
        self.path = ""
        self._scheme = scheme
        self._port = 0
        self._listener: socket.socket | None = None
        self._client: socket.socket | None = None
        self._left = bytearray()

    def open(self) -> None:
        """Listen; again on the same port after `close`."""
        self._listener = socket.create_server(("127.0.0.1", self._port), backlog=1)
        self._listener.setblocking(False)
        self._port = self._listener.getsockname()[1]
        self.path = f"{self._scheme}://127.0.0.1:{self._port}"

    def close(self) -> None:
        """Drop the client and stop listening."""
        self._drop()
        if self._listener is not None:
            self._listener.close()
            self._listener = None

    def descriptors(self) -> list[int]:
        """Return the client, or the listener while there is none."""
        live = self._client or self._listener
        return [live.fileno()] if live is not None else []

    def backlog(self) -> list[int]:
        """Return the client while output is left over."""
        return [self._client.fileno()] if self._client is not None and self._left else []

    def receive(self, descriptor: int) -> bytes:
        """Return what the client sent, or take the next client."""
        if self._client is None:
            if self._listener is not None and self._listener.fileno() == descriptor:
                with contextlib.suppress(BlockingIOError):
                    self._client = self._listener.accept()[0]
                    self._client.setblocking(False)
                    self._client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            return b""
        try:
            data = self._client.recv(4096)
        except BlockingIOError:
            return b""
        except ConnectionError:
            data = b""
        if not data:
            self._drop()
        return data

    def baud(self) -> int | None:
        """Return None: TCP has no rate."""
        return None

    def attend(self) -> bool:
        """Return False: a connection ends with its client."""
        return False

    def send(self, data: bytes) -> None:
        """Send as much as fits and keep the rest."""
        if self._client is None:
            return
        self._left += data
        try:
            del self._left[: self._client.send(self._left)]
        except BlockingIOError:
            del self._left[:-LONGEST_BACKLOG]
        except ConnectionError:
            self._drop()

    def _drop(self) -> None:
        self._left.clear()
        if self._client is not None:
            self._client.close()
            self._client = None
