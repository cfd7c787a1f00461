"""A simulated dish on a real pty, served from this process to any program that opens it."""

from __future__ import annotations

import os
import socket
import threading
import time
from contextlib import suppress
from pathlib import Path

from birdcage.base.clock import ScaledClock
from birdcage.base.wake import Wake
from birdcage.sim.port import open_device
from birdcage.sim.pty import PtyChannel
from birdcage.sim.server import Server


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

    def is_held_open(self) -> bool:
        """Whether any process but this one has the port open."""
        others = (int(each.name) for each in Path("/proc").iterdir() if each.name.isdigit())
        found = False
        for pid in others:
            with suppress(OSError):
                found = found or (pid != os.getpid() and self.is_open_in(pid))
        return found

    def lines(self, after: float = 0.0) -> list[str]:
        """Lines that the dish began to carry out after the monotonic time `after`."""
        with self.device.lock:
            self.device.machine.run()
            return [line for at, line in self.device.shell.received if at > after]

    def moves(self, after: float = 0.0) -> list[str]:
        return [line for line in self.lines(after) if line.startswith(("a ", "h ", "g "))]

    def wait_for(self, what, seconds=60.0) -> None:
        end = time.monotonic() + seconds
        while not what(self.device.truth()):
            assert time.monotonic() < end, self.device.truth()
            threading.Event().wait(0.02)

    def wait_for_motion(self) -> None:
        self.wait_for(lambda truth: truth.moving)
