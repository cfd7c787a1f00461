"""The end of a command over several dishes: each is barred before the first is closed, and closed once."""

from __future__ import annotations

import threading
from contextlib import ExitStack
from types import SimpleNamespace

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import BirdcageError, StoreError
from birdcage.cli import dish as ends
from birdcage.cli.station_command import StationCommand
from birdcage.station.state import StationState


class NotedDish(StationCommand):
    """Notes what is done to it."""

    def __init__(self, name, noted, *, fails=False):
        station = SimpleNamespace(
            clock=VirtualClock(), state=StationState(port=name), subscribe=lambda *_given: lambda: None
        )
        self.name, self.noted, self.fails = name, noted, fails
        super().__init__(station, moves=True)

    def on_signal(self, number):
        self.noted.append(("signal", self.name))

    def call_stop(self, by, *, leaving=False):
        self.noted.append(("stop", self.name))

    def show_network(self, network):
        raise AssertionError

    def bar(self):
        self.noted.append(("bar", self.name))

    def let_go(self):
        self.noted.append(("close", self.name))
        if self.fails:
            raise StoreError("The journal is full.")
        return f"{self.name} is where it is."


@pytest.fixture
def _no_held(monkeypatch):
    monkeypatch.setattr(ends, "find_held", lambda _paths, _port: None)


@pytest.mark.usefixtures("_no_held")
def test_an_error_bars_all_and_closes_each_although_one_close_fails():
    noted, error = [], BirdcageError("It did not answer.")
    dishes = [NotedDish("north", noted, fails=True), NotedDish("south", noted)]
    wants = [SimpleNamespace(paths=None, port=dish.name) for dish in dishes]
    with pytest.raises(StoreError, match="journal is full"):
        ends._leave_all(dishes, (0.0, 0.0), error, wants)
    assert noted == [("bar", "north"), ("bar", "south"), ("close", "north"), ("close", "south")]


def test_the_last_work_closes_each_dish_once(monkeypatch):
    noted, told = [], []

    class Heard:
        def tell(self, hear, last):
            told.append(last)

        def start(self):
            pass

        close = start

    monkeypatch.setattr(ends, "SignalListener", Heard)
    dishes = [NotedDish("north", noted), NotedDish("south", noted)]
    with ExitStack() as stack:
        ends.take_signals(stack, *dishes)
        reached, let_go = threading.Event(), dishes[1].let_go
        dishes[0].let_go = lambda: noted.append(("close", "north")) or reached.wait(0.05)
        dishes[1].let_go = lambda: reached.set() or let_go()
        told[0]()
    assert noted == [("close", "north"), ("close", "south")]
