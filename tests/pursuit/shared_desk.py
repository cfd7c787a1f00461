"""A desk on a virtual clock, in a program that others attach to."""

from __future__ import annotations

import threading
import time

from birdcage.base.paths import Paths
from birdcage.pursuit.desk_service import PURSUIT, DeskService
from birdcage.station.control_client import owners_folder
from birdcage.station.control_server import ControlServer
from birdcage.station.events import LinkChanged
from birdcage.station.services import Services

from .conftest import DeskBench


class SharedDesk(DeskBench):
    """A desk on a virtual clock, in a program that others attach to."""

    def serve(self) -> None:
        self.station._store.change(demo=False)  # of a dish inside this program others are not told
        services = Services()
        services.offer(PURSUIT, DeskService(self.desk))
        folder = owners_folder(Paths.default())
        self.server = ControlServer(self.station, folder, "birdcage station run", services=services)
        self.server._hear(LinkChanged(self.clock.monotonic(), self.clock.utc(), self.station.state.link))

    def end(self) -> None:
        """End as a program that is killed: no STOP, no word to the desk."""
        self.server.close()
        self.kill(2.0)

    def meanwhile(self, seen, seconds=600.0, every=0.5) -> None:
        """Let time pass for the dish until something is so for a face, which lives in real time."""
        end, real = self.clock.monotonic() + seconds, time.monotonic() + 40.0
        while not seen():
            assert self.clock.monotonic() < end, (self.desk.now.problem, self.pursuit)
            assert time.monotonic() < real, (self.desk.now.problem, self.pursuit)
            self.do(every)
            threading.Event().wait(0.005)
