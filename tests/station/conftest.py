"""A station, its link and a simulated dish in one thread on a virtual clock."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest
from birdcage.base.clock import VirtualClock, WaitOutcome
from birdcage.base.errors import LinkError
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.station.requests import Watch
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station

from .attached_bench import callers, served


@pytest.fixture
def owner(tmp_path):
    """A station that attached programs see (`OwnerStandIn`)."""
    with served(tmp_path) as owner:
        yield owner


@pytest.fixture
def attach(owner):
    """What attaches programs to it that say what a test wants."""
    with callers(owner) as attach:
        yield attach


class RunningClock(VirtualClock):
    """Goes on between two looks at it, as a real one does: what is due at a later look is not due at an earlier."""

    looks = 0

    def monotonic(self):
        self.looks += 1
        self.advance(2e-5)
        return super().monotonic()


@dataclass
class Bench:
    """What the tests of the station hold in their hands."""

    address: str = "g2?seed=1"
    options: dict = field(default_factory=dict)
    firmware: str = "g2"
    clock: VirtualClock = field(default_factory=lambda: VirtualClock())

    def __post_init__(self):
        self.device = open_device(self.address, clock=self.clock)
        self.opened = []
        settings = StationSettings(port="sim:test", firmware=self.firmware, open_link=self._open, **self.options)
        self.station = Station(self.clock, settings)
        self.session = Session(self.clock, self.station)
        self.events = []
        self.station.subscribe(self.events.append)

    def _open(self, port, baud):
        try:
            sim = SimPort(self.device, port, baud=baud)
        except ConnectionError as error:
            raise LinkError(str(error), reason="missing") from error
        self.opened.append(sim)
        self.written, write = bytearray(), sim.write

        def writing(data):
            self.written += data
            write(data)

        sim.write = writing
        return Link(sim, self.clock)

    @property
    def sim(self):
        """The port that is open now."""
        return self.opened[-1]

    def received(self):
        """Lines that the dish has begun to carry out, with the time of each."""
        with self.device.lock:
            self.device.machine.run()
            return list(self.device.shell.received)

    @property
    def state(self):
        return self.station.state

    def step(self, seconds):
        self.session.step(seconds)

    def connect(self, seconds=3.0):
        self.step(seconds)
        assert self.state.link.state is LinkNow.UP, self.state.link
        return self

    def later(self, seconds, call):
        """Have another thread's call come at a moment, in the middle of whatever waits then."""
        wait, at, calls = self.clock.wait, self.clock.monotonic() + seconds, [call]

        def waiting(endpoint, until, wake):
            if calls and until >= at:
                outcome = wait(endpoint, at, wake)
                if outcome is not WaitOutcome.TIMEOUT:
                    return outcome
                calls.pop()()
            return wait(endpoint, until, wake)

        self.clock.wait = waiting

    def watch(self, *features, rate_hz=10.0):
        self.station.submit(Watch("test", frozenset(features), rate_hz))

    def do(self, request, seconds=30.0):
        """Submit, step until it is done, and return its result or raise its error."""
        future = self.station.submit(request)
        end = self.clock.monotonic() + seconds
        while not future.done() and self.clock.monotonic() < end:
            self.step(0.1)
        assert future.done(), f"{request} was not done within {seconds} s"
        return future.result(0)

    def lines(self):
        """All complete lines that the dish received, oldest first."""
        return [line for _time, line in self.received()]

    def moves_since(self, time):
        """Lines that move an axis, received after `time`."""
        return [
            line for at, line in self.received()
            if at > time and line.startswith(("a ", "h ", "g "))
        ]  # fmt: skip

    def kinds(self):
        return [type(event).__name__ for event in self.events]


@pytest.fixture
def bench():
    return Bench().connect()
