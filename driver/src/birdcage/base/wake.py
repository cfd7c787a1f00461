"""A flag that ends a wait in another thread."""

from __future__ import annotations

import socket
import threading


class Wake:
    """Set by any thread, seen at once by the one that waits in `Clock.wait`.

    A socket pair and not a pipe, as `select` on Windows takes sockets only.
    """

    def __init__(self) -> None:
        self._receiver, self._sender = socket.socketpair()
        self._receiver.setblocking(False)
        # Reentrant: a signal handler may set it on top of the `set` that it interrupted.
        self._lock = threading.RLock()
        self._set = self._closed = False

    def fileno(self) -> int:
        """Return the descriptor that becomes readable when the flag is set."""
        return self._receiver.fileno()

    def is_set(self) -> bool:
        """Return whether the flag is set."""
        return self._set

    def set(self) -> None:
        """Raise the flag; a second time, or once no thread waits, does nothing."""
        with self._lock:
            if not self._set:
                self._set = True
                if not self._closed:
                    self._sender.send(b"\0")

    def clear(self) -> None:
        """Lower the flag."""
        with self._lock:
            if self._set:
                self._set = False
                if not self._closed:
                    self._receiver.recv(16)

    def close(self) -> None:
        """Give the descriptors back."""
        with self._lock:
            self._closed = True
            self._receiver.close()
            self._sender.close()
