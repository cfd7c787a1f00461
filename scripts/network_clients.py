"""Programs in the network that talk to the app's server, for a picture: real sockets, the dish's own time."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from birdcage.base.config import RotctldSettings
from birdcage.rotctld.listening import listen
from birdcage.rotctld.options import RotctldOptions
from birdcage.rotctld.recogniser import Recogniser
from birdcage.rotctld.server import RotctldService
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.propagate import track
from birdcage_tui.demo import DEMO_PLACE
from stage import HERE, START, Stage

ADDRESS = ("127.0.0.1", 4533)
PATIENCE_S = 5.0
"""How long an answer may take; real seconds."""


class Program:
    """One of them. Its own port is fixed, as the picture shows it."""

    def __init__(self, service: RotctldService, recogniser: Recogniser, port: int) -> None:
        self._service, self._recogniser = service, recogniser
        self._line = socket.socket()
        self._line.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self._line.bind((ADDRESS[0], port))
        self._line.connect(ADDRESS)
        self._line.setblocking(False)

    def ask(self, said: str) -> str:
        """Say a line, and return its answer."""
        self._line.sendall(said.encode() + b"\n")
        until = time.monotonic() + PATIENCE_S
        while time.monotonic() < until:
            self._service.step(0.0)
            self._recogniser.step()
            with suppress(BlockingIOError):
                return self._line.recv(4096).decode()
        raise SystemExit(f"no answer to {said!r}")

    def close(self) -> None:
        """Hang up."""
        self._line.close()


class Gpredict:
    """Follows the first satellite of the demo by steps of its threshold, as Gpredict does."""

    def __init__(self, program: Program, threshold_deg: float = 5.0) -> None:
        self._program, self._threshold_deg = program, threshold_deg
        self._here = Observer(DEMO_PLACE.latitude_deg, DEMO_PLACE.longitude_deg)
        self._satellite: ElementSet = demo_orbits(START, self._here)[0]
        self._told: tuple[float, float] | None = None

    def look(self, t_s: float) -> tuple[float, float]:
        """Return where the satellite stands."""
        seen = track(self._satellite, self._here, [t_s])
        return float(seen.az_deg[0]), float(seen.el_deg[0])

    def read(self) -> None:
        """Read where the dish is."""
        az_deg, el_deg = self._program.ask("p").split()
        self._told = float(az_deg), float(el_deg)

    def wish(self, t_s: float) -> None:
        """Wish for where the threshold will be reached again, if the dish is off by that."""
        here = self.look(t_s)
        if self._told is None or self._is_within(here, self._told):
            return
        there, ahead_s = here, 0.0
        while ahead_s < 120.0 and self._is_within(here, coming := self.look(t_s + ahead_s)):
            there, ahead_s = coming, ahead_s + 0.25
        self._program.ask(f"P {there[0]:.2f} {there[1]:.2f}")

    def _is_within(self, one: tuple[float, float], other: tuple[float, float]) -> bool:
        return max(abs(one[0] - other[0]), abs(one[1] - other[1])) <= self._threshold_deg


@contextmanager
def programs(on: Stage, *ports: int) -> Iterator[tuple[Program, ...]]:
    """Serve the dish of the stage, and connect so many programs."""
    station = on.app.station
    recogniser = Recogniser(on.app.session.clock, on.paths, lambda: HERE, threads=False)
    service = RotctldService(
        station, listen(*ADDRESS), RotctldSettings(), RotctldOptions(), show=station.show_network, recogniser=recogniser
    )
    found = tuple(Program(service, recogniser, port) for port in ports)
    try:
        yield found
    finally:
        for each in found:
            each.close()
        service.shutdown()
