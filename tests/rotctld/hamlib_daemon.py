"""Hamlib's own rotctld with its dummy rotator: what our replies are compared with."""

from __future__ import annotations

import shutil
import socket
import subprocess
import time
from contextlib import contextmanager, suppress

import pytest

LAST, TOLD_LAST = b"l AA00\n", b"-179.000000\n-89.500000\n"


@contextmanager
def hamlib_daemon():
    """Run the daemon, and give a function that says something on a connection of its own and returns all it answers."""
    program = shutil.which("rotctld")
    if program is None:
        pytest.skip("Hamlib's rotctld is not installed (libhamlib-utils)")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    daemon = subprocess.Popen(
        [program, "-m", "1", "-T", "127.0.0.1", "-t", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )

    def ask(said: bytes) -> bytes:
        for _ in range(5):  # it loses a connection now and then, as it begins or as it ends
            with suppress(OSError, EOFError):
                return _asked(port, said)
        raise EOFError(said)

    try:
        until = time.monotonic() + 10.0
        while True:
            try:
                socket.create_connection(("127.0.0.1", port), 1.0).close()
                break
            except OSError:
                assert daemon.poll() is None, "rotctld ended by itself"
                assert time.monotonic() < until, "rotctld does not listen"
                time.sleep(0.02)
        yield ask
    finally:
        daemon.terminate()
        daemon.wait(5.0)


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
