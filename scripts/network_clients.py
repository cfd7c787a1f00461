"""Programs in the network that talk to the app's server, for a picture: real sockets, the dish's own time."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from birdcage.base.config import RotctldSettings
from birdcage.rotctld.listening import listen
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.server import RotctldService
from stage import Stage

ADDRESS = ("127.0.0.1", 4533)
PATIENCE_S = 5.0
"""How long an answer may take; real seconds."""


class Program:
    """One of them. Its own port is fixed, as the picture shows it."""

    def __init__(self, service: RotctldService, port: int) -> None:
        self._service = service
        self._line = socket.socket()
        self._line.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self._line.bind((ADDRESS[0], port))
        self._line.connect(ADDRESS)
        self._line.setblocking(False)

    def ask(self, said: str) -> None:
        """Say a line, and wait for its answer."""
        self._line.sendall(said.encode() + b"\n")
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            self._service.step(0.0)
            with suppress(BlockingIOError):
                self._line.recv(4096)
                return
        raise SystemExit(f"no answer to {said!r}")

    def close(self) -> None:
        """Hang up."""
        self._line.close()


@contextmanager
def programs(on: Stage, *ports: int) -> Iterator[tuple[Program, ...]]:
    """Serve the dish of the stage, and connect so many programs."""
    station = on.app.station
    service = RotctldService(
        station, listen(*ADDRESS), RotctldSettings(), RotctldOptions(), show=station.show_network
    )  # fmt: skip
    found = tuple(Program(service, port) for port in ports)
    try:
        yield found
    finally:
        for each in found:
            each.close()
        service.shutdown()
