"""The command line, in this process or in one of its own, and a simulated dish on a real pty."""

from __future__ import annotations

import json
import socket
import subprocess
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path

import pytest
from birdcage.base.clock import ScaledClock
from birdcage.base.wake import Wake
from birdcage.cli.app import cli
from birdcage.sim.port import open_device
from birdcage.sim.pty import PtyChannel
from birdcage.sim.server import Server
from click.testing import CliRunner

# A test may itself run in the background of a shell, which then ignores SIGINT for all its children.
FRESH = """
import signal
for name in ("SIGTERM", "SIGHUP"):
    signal.signal(getattr(signal, name), signal.SIG_DFL)
signal.signal(signal.SIGINT, signal.default_int_handler)
from birdcage.cli import main
main()
"""


class PtyDish:
    """A simulated dish, served to any program that opens `path`."""

    def __init__(self, options: str = "seed=1", firmware: str = "g2", speed: float = 1.0) -> None:
        self.device = open_device(f"{firmware}?{options}", clock=ScaledClock(speed))
        self._server = Server(self.device, PtyChannel(None), f"sim:{firmware}")
        self.path = self._server.channel.path
        self._stop = Wake()
        self._thread = threading.Thread(target=self._server.serve, args=(self._stop,), daemon=True)
        self._thread.start()

    def close(self) -> None:
        self._stop.set()
        self._thread.join(5)
        self._server.close()
        self._stop.close()

    def unplug(self) -> None:
        """Pull the adapter out, from the thread of the test."""
        with socket.socket(socket.AF_UNIX) as control:
            control.connect(self._server.control.path)
            control.sendall(b'{"do": "unplug"}\n')
            control.recv(1000)

    def is_open_in(self, pid: int) -> bool:
        """Whether a process has the port open."""
        for each in Path(f"/proc/{pid}/fd").iterdir():
            with suppress(FileNotFoundError):  # closed since it was listed
                if str(each.readlink()) == self.path:
                    return True
        return False

    def lines(self, after: float = 0.0) -> list[str]:
        """Lines that the dish began to carry out after the monotonic time `after`."""
        with self.device.lock:
            self.device.machine.run()
            return [line for at, line in self.device.shell.received if at > after]

    def moves(self, after: float = 0.0) -> list[str]:
        return [line for line in self.lines(after) if line.startswith(("a ", "h ", "g "))]

    def wait_for(self, what, seconds=10.0) -> None:
        end = time.monotonic() + seconds
        while not what(self.device.truth()):
            assert time.monotonic() < end, self.device.truth()
            threading.Event().wait(0.02)

    def wait_for_motion(self) -> None:
        self.wait_for(lambda truth: truth.moving)


@pytest.fixture
def pty_dish(request):
    """A dish on a pty; `parametrize` it indirectly with options of the simulator."""
    dish = PtyDish(getattr(request, "param", "seed=1"))
    yield dish
    dish.close()


@pytest.fixture
def pty_travler(request):
    """The same with a Trav'ler; or with how much faster it is than a real one, and options."""
    speed, options = getattr(request, "param", (1.0, "seed=1"))
    dish = PtyDish(options, "hal205", speed)
    yield dish
    dish.close()


@pytest.fixture
def run():
    """Run `birdcage` in this process, on a G2 unless told otherwise."""

    def run(*words, port="sim:g2", firmware="g2", env=None, **more):
        before = threading.enumerate()
        env = {"BIRDCAGE_PORT": port, "BIRDCAGE_FIRMWARE": firmware, **(env or {})}
        result = CliRunner().invoke(cli, [str(word) for word in words], env=env, prog_name="birdcage", **more)
        # The end of a process closes its port; here a station may still be leaving the dish's menu.
        for thread in threading.enumerate():
            if thread.name == "station" and thread not in before:
                thread.join(5)
        return result

    return run


@pytest.fixture
def start():
    """Start `birdcage` in a process of its own."""
    started = []

    def start(*words):
        process = subprocess.Popen(
            [sys.executable, "-c", FRESH, *map(str, words)],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        started.append(process)
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.fixture
def as_json():
    return lambda result: json.loads(result.stdout)
