"""A pursuit as the station tells it, made by hand."""

from __future__ import annotations

import csv
from dataclasses import replace
from datetime import UTC, datetime, timedelta

import numpy as np
from birdcage.base.clock import RealClock
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import PassReach, Stretch
from birdcage.station.events import Followed, PursuitChanged, ReadingRead
from birdcage.station.pursuit_state import Phase, PointingSample, Pursuit, PursuitOptions
from birdcage.tracking.curve import Curve
from birdcage.tracking.plan import Forecast, Plan, PlanTarget

START = datetime(2026, 11, 21, 12, 0, tzinfo=UTC)


def wait_for(path, seconds=60.0):
    """Wait until a command of a hook has written something there: it runs in real time."""
    clock = RealClock()
    end = clock.monotonic() + seconds
    while not (path.exists() and path.read_text()):
        assert clock.monotonic() < end, f"{path} was never written"
        clock.wait(None, clock.monotonic() + 0.02)


def at(seconds):
    return START + timedelta(seconds=seconds)


def plan(name="ISS (ZARYA)", number=25544, passing=True, time_offset_s=0.0, start=0.0):
    """Return a plan whose reach is from `start` to 400 s later."""
    one = Pass(name, number or 0, at(start - 60), at(start + 200), at(start + 460), 10.0, 90.0, 170.0, 62.0)
    times = np.array([START.timestamp() + start, START.timestamp() + start + 400.0])
    curve = Curve(times, np.array([10.0, 170.0]), np.array([18.0, 18.0]))
    forecast = Forecast(times, np.array([0.01, 0.02]), None, 0.015, 0.02)
    reach = PassReach((Stretch(at(start), at(start + 400)),), (), 61.5)
    aim = PlanTarget(name, "satellite" if passing else "body", number, 1.7e9, time_offset_s)
    return Plan(aim, at(-600), one if passing else None, reach, curve, curve, (), None, (), forecast, ())


class Story:
    """Tells a log what a station would; monotonic time is the time since START."""

    def __init__(self, log, demo=False):
        self.log, self.demo = log, demo
        self.pursuit = Pursuit(1, "tracker", plan(), PursuitOptions(), Phase.WAITING, 0.0, "", controller="fast")

    def tell(self, event):
        self.log.hear(event, demo=self.demo)

    def phase(self, seconds, phase, why="", **changes):
        self.pursuit = replace(self.pursuit, phase=phase, why=why, **changes)
        self.tell(PursuitChanged(seconds, at(seconds), self.pursuit))

    def look(self, seconds, error=0.01, loss=0.1, number=None):
        sample = PointingSample(
            seconds, at(seconds), 100.0, 40.0, 100.0, 40.0, 100.1, 40.0, 100.0 + error, 40.0, error, loss, error
        )
        self.tell(Followed(seconds, at(seconds), number or self.pursuit.number, sample))

    def at_elevation(self, seconds, el_deg):
        sample = PointingSample(
            seconds, at(seconds), 100.0, el_deg, 100.0, el_deg, 100.0, el_deg, 100.0, el_deg, 0.01, 0.1, 0.01
        )
        self.tell(Followed(seconds, at(seconds), self.pursuit.number, sample))

    def snr(self, seconds, snr_db):
        self.tell(ReadingRead(seconds, at(seconds), "snr", snr_db, "dB"))

    def rssi(self, seconds, counts):
        self.tell(ReadingRead(seconds, at(seconds), "rssi", counts, "counts"))

    def whole_pass(self, errors=(0.01, 0.02, 0.03), why="The pass is over."):
        self.phase(-300, Phase.WAITING)
        self.phase(0, Phase.FOLLOWING)
        for second, error in enumerate(errors):
            self.look(float(second), error)
        self.phase(400, Phase.OVER, why)


def rows_of(path):
    """Return the samples of a file."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))
