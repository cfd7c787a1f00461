"""The setup over a real station and a simulated dish, all in one thread on a virtual clock."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import fields
from datetime import UTC, datetime

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import load
from birdcage.base.errors import LinkError
from birdcage.base.paths import Paths
from birdcage.gps.fix import NoFix
from birdcage.link.link import Link
from birdcage.setup.engine import Setup
from birdcage.signal.ear import SourceEar, own_tuner
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.sim.port import SimPort, open_device
from birdcage.station.known import PortInfo, SystemFacts
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings, rules_from
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station

NOON = datetime(2026, 3, 20, 18, 20, 0, tzinfo=UTC)
"""Around noon where the simulated dish stands."""
ADAPTER = PortInfo("/dev/ttyUSB0", None, "FT232R USB UART", "0403:6001", "A5", "1-1")


class House:
    """A dish in the garden, and a person who runs the setup on a laptop, maybe twice."""

    def __init__(self, folder, address="g2?seed=1", utc=NOON, firmware=None, port="/dev/ttyUSB0"):
        self.clock = VirtualClock(utc)
        self.firmware = firmware or address.partition("?")[0]
        self.device = open_device(address, clock=self.clock)
        self.paths = Paths.in_folder(folder)
        self.environ = {}
        self.plugged = [ADAPTER]
        self.first_port = port
        self.receivers, self.asked = {}, []
        self.beside = None
        """A `Planted` source that its tasks hear by; None: the dish's own tuner."""
        self.start()

    def start(self):
        """Start the program."""
        settings = load(self.paths.config_file, self.environ)
        self.opened = []
        rules = rules_from(settings)
        wanted = StationSettings(
            port=settings.dish.port or self.first_port, firmware=self.firmware, baud=settings.dish.baud,
            open_link=self._open,
            backup_folder=self.paths.backups, tasks=signal_tasks(self._ear),
            **{each.name: getattr(rules, each.name) for each in fields(rules)},
        )  # fmt: skip
        self.station = Station(self.clock, wanted)
        self.session = Session(self.clock, self.station)
        self.setup = Setup(self.session, settings, self.paths, environ=self.environ, ports=lambda: self.plugged,
                           system=SystemFacts, receiver=self._ask)  # fmt: skip
        return self

    def _ear(self, source):
        return own_tuner(source) if self.beside is None else SourceEar(self.beside, self.clock)

    def _ask(self, receiver, dish_port):
        """Answer as a receiver does, at once: with a fix, or with why there is none."""
        self.asked.append((receiver, dish_port))
        answer = Future()
        told = self.receivers.get(receiver, NoFix(f"No {receiver} here.", reason="no_gps"))
        (answer.set_exception if isinstance(told, Exception) else answer.set_result)(told)
        return answer

    def _open(self, port, baud):
        if port not in [each.device for each in self.plugged]:
            raise LinkError(f"{port} is not there.", reason="missing")
        try:
            sim = SimPort(self.device, port, baud=baud)
        except ConnectionError as error:
            raise LinkError(str(error), reason="missing") from error
        self.opened.append((port, baud))
        return Link(sim, self.clock)

    def run(self, seconds):
        end = self.clock.monotonic() + seconds
        while self.clock.monotonic() < end:
            if self.beside is not None:
                self.beside.tick(self)
            self.session.step(0.1)
            self.setup.tick()

    def until(self, what, seconds=60.0):
        """Run until something is so."""
        end = self.clock.monotonic() + seconds
        while not what():
            assert self.clock.monotonic() < end, (self.setup.current, self.view(self.setup.current), self.state)
            self.run(0.1)

    def up(self):
        self.until(
            lambda: (
                self.state.link.state is LinkNow.UP
                and self.state.readings
                and (self.state.homed is not None or self.state.dish.homing_s is None)
            )
        )
        return self

    def choose(self, step, choice, seconds=60.0, **values):
        """Answer, and wait until nothing is under way."""
        self.setup.choose(step, choice, values)
        self.until(lambda: not self.setup.busy, seconds)

    def view(self, name):
        return self.setup.step(name)

    def marks(self):
        return {each.name: each.mark.value for each in self.setup.steps()}

    @property
    def state(self):
        return self.station.state

    def file(self):
        return load(self.paths.config_file, {})

    def kill(self):
        """End the program without a word."""
        self.session.close()

    def lines(self):
        with self.device.lock:
            self.device.machine.run()
            return [line for _at, line in self.device.shell.received]

    def moves(self):
        return [line for line in self.lines() if line.startswith(("a ", "h ", "g "))]

    def looks_at(self):
        """Return where the dish truly looks: true azimuth and elevation."""
        truth = self.device.truth()
        return (truth.az_deg + self.device.settings.heading) % 360.0, truth.el_deg


@pytest.fixture
def house(tmp_path):
    """A dish that is up and homed."""
    return House(tmp_path).up()


@pytest.fixture
def build(tmp_path):
    """Make a house with another dish."""
    return lambda address="g2?seed=1", **more: House(tmp_path, address, **more)
