"""A pursuit desk, its station and a simulated dish in one thread on a virtual clock."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import Settings
from birdcage.base.config.sections import MotionSettings
from birdcage.base.paths import Paths
from birdcage.link.link import Link
from birdcage.pursuit.desk import PursuitDesk
from birdcage.pursuit.desk_setup import DeskSetup
from birdcage.pursuit.pass_log import PassLog
from birdcage.sim.port import SimPort, open_device
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.station.requests import Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings, rules_from
from birdcage.station.station import Station

from .pass_events import Story

NOW = datetime(2026, 11, 21, 12, tzinfo=UTC)
HERE = Observer(50.0, 10.0, 300.0, "here")
ORBITS = demo_orbits(NOW, HERE)
SHORT = MotionSettings(min_elevation_deg=50.0)
"""Leaves a minute of a pass within reach: the whole of one is then soon over."""


@dataclass
class DeskBench:
    """What the tests of the desk hold in their hands."""

    folder: Path
    settings: Settings = field(default_factory=lambda: Settings(motion=SHORT))
    observer: Observer | None = HERE
    address: str = "g2?seed=1"
    now: datetime = NOW
    orbits: tuple[ElementSet, ...] = ORBITS
    favourites: tuple[int, ...] = ()
    """Places in `orbits`."""
    port: str = "sim:test"
    options: dict = field(default_factory=dict)
    """Of `StationSettings`."""

    short = SHORT

    def __post_init__(self):
        self.paths = Paths.in_folder(self.folder)
        with Catalogue(self.paths.catalogue) as catalogue:
            catalogue.add(self.orbits)
            for index in self.favourites:
                catalogue.set_favourite(self.orbits[index].norad_id)
        self.clock = VirtualClock(self.now)
        self.device = open_device(self.address, clock=self.clock)
        self.start()

    def start(self):
        """Start the program: for the first time, or again after `kill`."""
        self.told, self.events = [], []
        self.opened = []
        rules = rules_from(self.settings)
        self.station = Station(self.clock, StationSettings(
            port=self.port, firmware=self.address.partition("?")[0], open_link=self._open,
            **{name: getattr(rules, name) for name in rules.__slots__}, **self.options,
        ))  # fmt: skip
        self.session = Session(self.clock, self.station)
        self.station.subscribe(self.events.append)
        setup = DeskSetup(
            self.paths.catalogue, lambda: self.settings, self.paths, self.observer, load=lambda: self.settings
        )
        self.desk = PursuitDesk(self.station, self.clock, setup, self.told.append, threads=False)
        self.station.submit(Watch("test", frozenset({"position"}), 1.0))
        self._desk_at = self.clock.monotonic()
        self.step(3.0)

    def kill(self, seconds):
        """Let the program vanish without a word, and some time pass."""
        for port in self.opened:
            port.close()
        self.clock.advance(seconds)

    def _open(self, port, baud):
        self.opened.append(SimPort(self.device, port, baud=baud))
        return Link(self.opened[-1], self.clock)

    def step(self, seconds, every=0.1):
        """Let time pass, the desk looking round as often as it wants to."""
        end = self.clock.monotonic() + seconds
        while self.clock.monotonic() < end:
            if self.clock.monotonic() >= self._desk_at:
                self._desk_at = self.clock.monotonic() + self.desk.step()
            self.session.step(min(every, end - self.clock.monotonic()))

    def do(self, seconds=0.3):
        """Let the desk carry out what was asked of it, and the station too."""
        self._desk_at = self.clock.monotonic()
        self.step(seconds)
        self._desk_at = self.clock.monotonic()
        self.step(0.1)
        return self.desk.now

    def until(self, what, seconds=900.0, every=0.5):
        """Step until something is so."""
        end = self.clock.monotonic() + seconds
        while not what():
            assert self.clock.monotonic() < end, (self.desk.now.problem, self.station.state.pursuit)
            self.step(every)
        return self.desk.now

    @property
    def pursuit(self):
        return self.station.state.pursuit

    def phase(self):
        return None if self.pursuit is None else self.pursuit.phase

    def moves(self):
        """Lines that move an axis, so far."""
        with self.device.lock:
            self.device.machine.run()
            return [line for _at, line in self.device.shell.received if line.startswith(("a ", "h ", "g "))]


@pytest.fixture
def bench(tmp_path):
    return DeskBench(tmp_path)


@pytest.fixture
def make(tmp_path):
    """Make a bench with other settings."""
    return lambda **options: DeskBench(tmp_path, **options)


@pytest.fixture
def paths(tmp_path):
    return Paths.in_folder(tmp_path)


@pytest.fixture
def log(paths):
    log = PassLog(paths.journal, paths.passes, site=lambda: "Home, 52.0 N 4.4 E")
    yield log
    log.close(2.0)


@pytest.fixture
def story(log):
    return Story(log)
