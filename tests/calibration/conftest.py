"""A leaning simulated dish, a station, and the guide, all in one thread on a virtual clock."""

from __future__ import annotations

import math
from dataclasses import fields
from datetime import UTC, datetime
from pathlib import Path

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import load
from birdcage.base.geometry import separation, shortest_turn
from birdcage.base.paths import Paths
from birdcage.calibration.guide import Guide
from birdcage.link.link import Link
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.sim.port import SimPort, open_device
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings, rules_from
from birdcage.station.state import LinkPhase as LinkNow
from birdcage.station.station import Station

AFTERNOON = datetime(2026, 3, 20, 20, 30, 0, tzinfo=UTC)
"""The Sun stands in the south-west of the simulated dish, away from most of the arc."""
PLACE = "[place]\nlatitude_deg = 39.1\nlongitude_deg = -95.7\n"
LEANING = "g2?seed=1&overshoot=0&heading=25&tilt_north=1.2&tilt_east=-0.7&collimation=0.3"


class Garden:
    """The dish as it truly stands, and a person with a meter beside it."""

    def __init__(self, folder: Path, address: str = LEANING, config: str = PLACE, when: datetime = AFTERNOON) -> None:
        self.clock = VirtualClock(when)
        self.device = open_device(address, clock=self.clock)
        self.paths = Paths.in_folder(folder)
        folder.mkdir(parents=True, exist_ok=True)
        self.paths.config_file.write_text(config)
        settings = load(self.paths.config_file, {})
        rules = rules_from(settings)
        station = Station(
            self.clock,
            StationSettings(
                port="sim:test", firmware=address.partition("?")[0],
                open_link=lambda port, baud: Link(SimPort(self.device, port, baud=baud), self.clock),
                **{each.name: getattr(rules, each.name) for each in fields(rules)}, tasks=signal_tasks(),
            ),
        )  # fmt: skip
        self.session = Session(self.clock, station)
        self.guide = Guide(self.session, settings, self.paths, environ={})
        self.run(6.0)
        assert station.state.link.state is LinkNow.UP

    def run(self, seconds: float) -> None:
        end = self.clock.monotonic() + seconds
        while self.clock.monotonic() < end:
            self.session.step(0.1)
            self.guide.tick()

    def rest(self, seconds: float = 60.0) -> None:
        """Wait until what was asked for is done, and the dish has told where it is."""
        end = self.clock.monotonic() + seconds
        while self.guide.view().busy:
            assert self.clock.monotonic() < end, self.guide.view().busy
            self.run(0.1)
        assert not self.guide.view().failure, self.guide.view().failure
        self.run(2.0)

    def off_deg(self) -> float:
        """How far the beam truly is from the object."""
        truth, stands = self.device.truth(), self.guide.view().expected
        return separation(truth.beam_az_deg, truth.beam_el_deg, *stands)

    def peak_up(self) -> None:
        """Nudge until the beam is on the object, as a person does who watches the meter."""
        for _ in range(4):
            truth, stands = self.device.truth(), self.guide.view().expected
            if self.off_deg() < 0.03:
                break
            turn = shortest_turn(truth.beam_az_deg, stands[0])
            self.guide.nudge(turn * math.cos(math.radians(truth.beam_el_deg)), stands[1] - truth.beam_el_deg)
            self.rest()
        assert self.off_deg() < 0.06


@pytest.fixture
def garden(tmp_path):
    return Garden(tmp_path)


@pytest.fixture
def build(tmp_path):
    return lambda **more: Garden(tmp_path, **more)
