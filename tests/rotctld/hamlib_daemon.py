"""Hamlib's own rotctld with its dummy rotator: what our replies are compared with."""

from __future__ import annotations

import socket
from contextlib import contextmanager, suppress

from hamlib_program import hamlib_program

LAST, TOLD_LAST = b"l AA00\n", b"-179.000000\n-89.500000\n"


@contextmanager
def hamlib_daemon():
    """Run the daemon, and give a function that says something on a connection of its own and returns all it answers."""
    with hamlib_program("rotctld") as port:

        def ask(said: bytes) -> bytes:
            for _ in range(5):  # it loses a connection now and then, as it begins or as it ends
                with suppress(OSError, EOFError):
                    return _asked(port, said)
            raise EOFError(said)

        yield ask


def _asked(port: int, said: bytes) -> bytes:
    """Say it, and something behind it whose answer is known: when that comes, all is told.

    EOFError if it hangs up before, but for `q`.
    """
    with socket.create_connection(("127.0.0.1", port), 10.0) as connection:
        connection.sendall(said + LAST)
        told = b""
        while not told.endswith(TOLD_LAST):
            if not (piece := connection.recv(65536)):
                if any(token.lower() in (b"q", b"+q", b";q", b"|q") for token in said.split()):
                    return told
                raise EOFError
            told += piece
        return told.removesuffix(TOLD_LAST)
