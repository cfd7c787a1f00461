"""Reads lines from a socket within a time: a peer that trickles keeps no thread for longer than it may."""

from __future__ import annotations

import socket
import time

CHUNK = 65536


class LineReader:
    """The lines of one socket."""

    def __init__(self, line: socket.socket) -> None:
        self._line = line
        self._ahead = b""

    @property
    def ahead(self) -> bytes:
        """What came after the last line that was read."""
        return self._ahead

    def read(self, longest: int, within_s: float | None) -> bytes:
        """Return the next line with its end; what came before the peer hung up, without one; empty after that.

        TimeoutError when the whole line takes longer than `within_s` (None: for ever). ValueError for one of more than
        `longest` bytes.
        """
        until = None if within_s is None else time.monotonic() + within_s
        got = bytearray(self._ahead)
        searched = 0
        while (end := got.find(b"\n", searched)) < 0 and len(got) <= longest:
            searched = len(got)
            if until is not None and until <= time.monotonic():
                raise TimeoutError
            self._line.settimeout(None if until is None else max(until - time.monotonic(), 0.001))
            chunk = self._line.recv(CHUNK)
            if not chunk:
                break
            got += chunk
        if (end < 0 and len(got) > longest) or end >= longest:
            raise ValueError(f"more than {longest} bytes")
        self._ahead = b"" if end < 0 else bytes(got[end + 1 :])
        return bytes(got) if end < 0 else bytes(got[: end + 1])
