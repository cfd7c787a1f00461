"""One of Hamlib's own daemons with its dummy machine: what our replies and questions are held against."""

from __future__ import annotations

import shutil
import socket
import subprocess
import time
from contextlib import contextmanager

import pytest

START_S, END_S = 10.0, 5.0


def free_port():
    """Return a port of this machine that the system has just found free."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        return free.getsockname()[1]


def start_hamlib(name, port):
    """Start `rigctld` or `rotctld` at a port; return its process, and a connection to it that is its first client."""
    program = shutil.which(name)
    if program is None:
        pytest.skip(f"Hamlib's {name} is not installed (libhamlib-utils)")
    daemon = subprocess.Popen(
        [program, "-m", "1", "-T", "127.0.0.1", "-t", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    until = time.monotonic() + START_S
    while True:
        try:
            return daemon, socket.create_connection(("127.0.0.1", port), 1.0)
        except OSError:
            assert daemon.poll() is None, f"{name} ended by itself"
            assert time.monotonic() < until, f"{name} does not listen"
            time.sleep(0.02)


@contextmanager
def hamlib_program(name):
    """Run `rigctld` or `rotctld` on a free port of this machine until the end; give the port."""
    port = free_port()
    daemon, first = start_hamlib(name, port)
    try:
        # It stays: as its last client leaves, rigctld closes the radio, under one that comes at that moment, too.
        with first:
            yield port
    finally:
        daemon.terminate()
        daemon.wait(END_S)
