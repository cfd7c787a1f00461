from __future__ import annotations

import shutil
import socket
import subprocess
import time

import pytest
from birdcage.base.clock import VirtualClock

from .scripted import Server


@pytest.fixture
def clock():
    return VirtualClock()


@pytest.fixture
def server():
    """Start scripted servers; they end with the test."""
    started = []

    def start(answer):
        started.append(Server(answer))
        return started[-1]

    yield start
    for each in started:
        each.close()


@pytest.fixture
def rigctld():
    """Run Hamlib's own daemon with its dummy radio, and return its port."""
    program = shutil.which("rigctld")
    if program is None:
        pytest.skip("Hamlib's rigctld is not installed (libhamlib-utils)")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    daemon = subprocess.Popen(
        [program, "-m", "1", "-T", "127.0.0.1", "-t", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    try:
        until = time.monotonic() + 10.0
        while True:
            try:
                socket.create_connection(("127.0.0.1", port), 1.0).close()
                break
            except OSError:
                assert daemon.poll() is None, "rigctld ended by itself"
                assert time.monotonic() < until, "rigctld does not listen"
                time.sleep(0.02)
        yield port
    finally:
        daemon.terminate()
        daemon.wait(5.0)
