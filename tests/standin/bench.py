"""A station on the stand-in dish, in one thread on a virtual clock."""

from __future__ import annotations

from birdcage.base.clock import VirtualClock
from birdcage.link.link import Link
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station

from .dish import StandIn
from .habits import Habits
from .ports import MemoryPort


class Bench:
    """`Bench(second_other="block")`: a dish with that habit, and a station that drives it."""

    def __init__(self, *, firmware: str = "g2", settings: dict | None = None, **habits: object) -> None:
        self.clock = VirtualClock()
        self.dish = StandIn(self.clock.monotonic, Habits(**habits))
        self.station = Station(
            self.clock, StationSettings(port="standin", firmware=firmware, open_link=self._open, **(settings or {}))
        )
        self.session = Session(self.clock, self.station)
        self.events: list[object] = []
        self.station.subscribe(self.events.append)

    def _open(self, port: str, baud: int) -> Link:
        return Link(MemoryPort(self.dish, port, baud), self.clock)

    @property
    def state(self):
        return self.station.state

    def step(self, seconds: float) -> None:
        self.session.step(seconds)

    def until(self, true, seconds: float = 60.0) -> bool:
        """Let time pass until something holds; return whether it came to that."""
        end = self.clock.monotonic() + seconds
        while not true() and self.clock.monotonic() < end:
            self.step(0.1)
        return true()

    def connect(self, seconds: float = 20.0) -> Bench:
        assert self.until(lambda: self.state.link.state is LinkNow.UP, seconds), self.state.link
        return self

    def do(self, request, seconds: float = 60.0):
        """Ask for something and wait for it; return what came of it, an error included."""
        future = self.station.submit(request)
        if not self.until(future.done, seconds):
            return TimeoutError(f"{request} was not done within {seconds:g} s")
        return future.exception(0) or future.result(0)
