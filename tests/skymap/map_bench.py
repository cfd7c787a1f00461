"""A simulated dish whose station makes maps, on a virtual clock."""

from __future__ import annotations

from birdcage.base.config import Settings
from birdcage.signal.source_set import SourceSet
from birdcage.skymap.map_file import list_maps, read_map
from birdcage.skymap.map_keeper import MapKeeper
from birdcage.skymap.map_request import MapRequest
from birdcage.skymap.map_task import map_tasks
from birdcage.skymap.plan import MapPlan
from birdcage.station.events import TaskChanged
from birdcage.station.requests import BeginTask

from tests.station.conftest import Bench

SMALL = MapPlan(178.0, 183.0, 38.0, 41.0, 1.0)
QUICK = "g2?seed=1"


class MapBench(Bench):
    """`path` is the file of recordings; a second bench with the same one is the next program."""

    def __init__(self, path, address=QUICK, battery=lambda: None, settings=None, station=None, **other):
        self.path = path
        settings = settings or Settings()
        self.keeper = None
        options = {"tasks": {}, **(station or {})}
        super().__init__(address, options, **other)
        self.sources = SourceSet(settings, self.clock, threads=False)
        self.keeper = MapKeeper(self.sources, path, settings, battery)
        options["tasks"].update({**self.sources.tasks, **map_tasks(self.keeper)})
        self.sources.attach(self.station)
        self.keeper.attach(self.station)

    def begin(self, plan=SMALL, key="k1", **values):
        return self.do(BeginTask("map", MapRequest(plan, key, **values).values(), "you"))

    def run(self, most_s=3000.0, until=lambda _task: False):
        """Go on until the map is over, or `until` its state says so; return its last state."""
        end = self.clock.monotonic() + most_s
        while self.state.tasks and self.clock.monotonic() < end and not until(self.task):
            self.step(0.2)
        return self.task

    @property
    def task(self):
        told = [event.task for event in self.events if isinstance(event, TaskChanged) and event.task.kind == "map"]
        return told[-1]

    def read(self, number=1):
        return read_map(self.path, number)

    def heard(self):
        return [(head.number, head.heard, head.ended is not None) for head in list_maps(self.path)]

    def end(self):
        """As a program that ends in order."""
        self.session.close()


def made(tmp_path, address=QUICK, **other):
    return MapBench(tmp_path / "signal.sqlite", address, **other).connect(6.0)
