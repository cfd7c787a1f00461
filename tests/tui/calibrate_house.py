"""The app on a real station and a dish that leans, with the guide behind it: all in one thread on a virtual clock."""

from __future__ import annotations

import math
from dataclasses import fields
from datetime import UTC, datetime

from birdcage.base.clock import VirtualClock
from birdcage.base.config import load
from birdcage.base.geometry import separation, shortest_turn
from birdcage.base.paths import Paths
from birdcage.link.link import Link
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.sim.port import SimPort, open_device
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings, rules_from
from birdcage.station.station import Station
from birdcage_tui.feeds.calibrate_source import make_calibrate
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace

AFTERNOON = datetime(2026, 3, 20, 20, 30, tzinfo=UTC)
"""The Sun stands in the south-west, away from most of the arc."""
LEANING = "g2?seed=1&overshoot=0&heading=5&tilt_north=1.2&tilt_east=-0.7&collimation=0.3"
PLACE = "[place]\nlatitude_deg = 39.1\nlongitude_deg = -95.7\n"


class Stepped(Session):
    """Begins without a thread: the test steps it."""

    def start(self):
        return


class House:
    def __init__(self, folder, address=LEANING, config=PLACE, **app):
        self.clock = VirtualClock(AFTERNOON)
        self.device = open_device(address, clock=self.clock)
        self.paths = Paths.in_folder(folder)
        folder.mkdir(parents=True, exist_ok=True)
        self.paths.config_file.write_text(config)
        rules = rules_from(self.settings())
        self.station = Station(
            self.clock,
            StationSettings(
                port="sim:test", firmware=address.partition("?")[0],
                open_link=lambda port, baud: Link(SimPort(self.device, port, baud=baud), self.clock),
                **{each.name: getattr(rules, each.name) for each in fields(rules)}, tasks=signal_tasks(),
            ),
        )  # fmt: skip
        self.session = Stepped(self.clock, self.station)
        self.app = BirdcageApp(self.session, AppOptions(
            place=SitePlace(39.1, -95.7),
            calibrate=make_calibrate(self.session, self.settings, self.paths, environ={}, threads=False),
            **app,
        ))  # fmt: skip
        self.pilot = None

    def settings(self):
        return load(self.paths.config_file, {})

    async def step(self, seconds):
        end = self.clock.monotonic() + seconds
        while self.clock.monotonic() < end - 1e-6:
            self.session.step(0.1)
            if self.app.calibrate.source is not None:
                self.app.calibrate.source.step()
        await self.pilot.pause()
        self.app.paint()
        await self.pilot.pause()

    async def press(self, *keys):
        for key in keys:
            await self.pilot.press(key)
        await self.step(0.2)

    async def rest(self, seconds=90.0):
        """Wait until nothing is under way any more, and the dish has told where it is."""
        end = self.clock.monotonic() + seconds
        while self.app.motions.under_way or self.guide.busy:
            assert self.clock.monotonic() < end, self.text()
            await self.step(0.5)
        await self.step(2.0)

    @property
    def now(self):
        return self.app.calibrate.now

    @property
    def guide(self):
        return self.now.guide

    def text(self):
        strips = self.app.screen._compositor.render_strips()
        return "\n".join("".join(segment.text for segment in strip) for strip in strips)

    def off(self):
        """How far the object truly is right of and above the beam: what a person's meter tells in the end."""
        truth, stands = self.device.truth(), self.guide.expected
        turn = shortest_turn(truth.beam_az_deg, stands[0])
        return turn * math.cos(math.radians(truth.beam_el_deg)), stands[1] - truth.beam_el_deg

    async def peak_up(self):
        """Nudge with the arrows, in steps that grow smaller, until the beam is on the object."""
        for step_deg in (5.0, 1.0, 0.2, 0.05):
            while self.app.motions.step_deg > step_deg:
                await self.pilot.press("minus")
            while self.app.motions.step_deg < step_deg:
                await self.pilot.press("plus")
            for _ in range(12):
                right, up = self.off()
                keys = ["right" if right > 0 else "left"] * (abs(right) > 0.6 * step_deg)
                keys += ["up" if up > 0 else "down"] * (abs(up) > 0.6 * step_deg)
                if not keys:
                    break
                for key in keys:
                    await self.pilot.press(key)
                    await self.rest()
        assert math.hypot(*self.off()) < 0.1

    async def open(self):
        await self.step(6.0)
        await self.pilot.press("f8")
        await self.step(1.0)
        await self.pilot.press("C")
        await self.pilot.pause()
        await self.step(2.0)

    async def take_one(self):
        await self.press("n", "enter")
        await self.rest()
        await self.peak_up()
        await self.press("enter")
        await self.step(1.0)

    def beam_error(self, az, el):
        truth = self.device.truth()
        return separation(truth.beam_az_deg, truth.beam_el_deg, az, el)
