"""The bytes between here and a receiver: a TCP socket with deadlines."""

from __future__ import annotations

import select
import socket
from collections.abc import Callable
from typing import Protocol

from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.radio.errors import RadioLost

CONNECT_S = 2.0
HURRY_S = 0.2
"""The longest wait for an answer once the program is ending."""


class RadioWire(Protocol):
    """An open connection. RadioLost (reason `closed`) when the other end has gone."""

    def send(self, data: bytes) -> None:
        """Send all of it."""

    def receive(self, timeout_s: float) -> bytes:
        """Return what has come; nothing when the time is up."""

    def close(self) -> None:
        """Hang up."""


Connect = Callable[[str, int, float], RadioWire]
"""`connect(host, port, timeout_s)`. RadioLost (reason `missing`) when nothing listens there."""
Call = Callable[[float], RadioWire]
"""The same for one address: `call(timeout_s)`."""


def connector(hurry: Wake | None = None) -> Connect:
    """Return what opens sockets; once `hurry` is set none of them waits for long."""

    def connect(host: str, port: int, timeout_s: float) -> RadioWire:
        try:
            connection = socket.create_connection((host, port), timeout_s)
        except OSError as error:
            why = error.strerror or str(error) or "no answer"
            raise RadioLost(f"Nothing listens at {host}:{port} ({why}).", reason=Reason.MISSING) from error
        return SocketWire(connection, hurry)

    return connect


class SocketWire:
    """A socket."""

    def __init__(self, connection: socket.socket, hurry: Wake | None = None) -> None:
        self._socket, self._hurry = connection, hurry
        connection.settimeout(CONNECT_S)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def send(self, data: bytes) -> None:
        """Send all of it, for at most 2 s."""
        try:
            self._socket.sendall(data)
        except OSError as error:
            raise _closed(error) from error

    def receive(self, timeout_s: float) -> bytes:
        """Return what has come within the time, or less when the program is ending."""
        hurried = self._hurry is not None and self._hurry.is_set()
        watched = [self._socket.fileno()]
        if self._hurry is not None and not hurried:
            watched.append(self._hurry.fileno())
        longest_s = min(timeout_s, HURRY_S) if hurried else timeout_s
        readable, _, _ = select.select(watched, [], [], max(longest_s, 0.0))
        if self._socket.fileno() not in readable:
            # Woken to hurry: once more, with what little time that leaves.
            return self.receive(timeout_s) if readable else b""
        try:
            data = self._socket.recv(4096)
        except OSError as error:
            raise _closed(error) from error
        if not data:
            raise RadioLost("It closed the connection.", reason=Reason.CLOSED)
        return data

    def close(self) -> None:
        """Hang up."""
        self._socket.close()


def _closed(error: OSError) -> RadioLost:
    return RadioLost(f"The connection broke ({error.strerror or error}).", reason=Reason.CLOSED)
