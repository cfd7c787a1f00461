"""The app over a simulated dish with a catalogue and a real pursuit desk, all in one thread on a virtual clock."""

from __future__ import annotations

import asyncio
from dataclasses import replace

import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.sky.demo_orbits import demo_orbits
from birdcage.sky.observer import Observer
from birdcage.station.build import open_session
from birdcage.station.requests import Home
from birdcage_tui.feeds.sky_feed import make_sky
from birdcage_tui.feeds.track_source import make_track
from birdcage_tui.run import _app_settings
from birdcage_tui.shell.birdcage_app import BirdcageApp

PLACE = "[place]\nlatitude_deg = 39.1\nlongitude_deg = -95.7\n"
NAMES = (("ISS (ZARYA)", 25544), ("ISS (NAUKA)", 49044), ("RADFXSAT (FOX-1B)", 43017), ("METEOR-M2 3", 57166),
         ("NOAA 19", 33591), ("NOAA 20 (JPSS-1)", 43013), ("FUNCUBE-1 (AO-73)", 39444))  # fmt: skip


class House:
    """The app over a simulated dish, with a catalogue and a desk; all in one thread on a virtual clock."""

    def __init__(self, folder, port="sim:g2"):
        self.clock = VirtualClock()
        paths = Paths.in_folder(folder)
        paths.config_file.write_text(PLACE)
        orbits = demo_orbits(self.clock.utc(), Observer(39.1, -95.7))
        with Catalogue(paths.catalogue) as catalogue:
            catalogue.add(replace(orbits[0], name=name, norad_id=number) for name, number in NAMES)
        settings = load(paths.config_file, environ={})
        self.session = open_session(
            port=port, firmware="g2", baud=None, settings=settings, paths=paths, clock=self.clock
        )
        self.session.start = lambda: None
        self.app = BirdcageApp(
            self.session,
            replace(
                _app_settings(settings, paths, demo=False),
                sky=make_sky(settings, paths, self.clock, demo=False, threads=False),
                track=make_track(self.session, settings, lambda: settings, paths, demo=False, threads=False),
            ),
        )
        self.asked = []
        ask = self.session.station.submit
        self.session.station.submit = lambda request: (self.asked.append(request), ask(request))[1]
        self.pilot = None

    async def home(self):
        """Home the dish, let the search for passes end, and forget what was asked for."""
        self.session.station.submit(Home("you"))
        self.session.step(60.0)
        for _ in range(8):
            await self.look(1.0)
        self.asked.clear()

    async def press(self, *keys):
        for key in keys:
            await self.pilot.press(key)
            await self.pilot.pause()

    async def look(self, seconds=0.5):
        self.session.step(seconds)
        for source in (self.app.sky.source, self.app.track.source):
            if source is not None:
                source.step()
        await self.pilot.pause()
        self.app.paint()
        await self.pilot.pause()
        return " ".join(stand_in.text_of(self.app).split())

    async def type(self, text):
        self.app.screen.focused.value = text
        await self.pilot.pause()
        return await self.look()


def play(folder, story, size=(80, 24), port="sim:g2"):
    async def body():
        house = House(folder, port)
        async with house.app.run_test(size=size) as house.pilot:
            await house.pilot.pause()
            for _ in range(6):
                await house.look(1.0)
            house.asked.clear()
            try:
                return await story(house)
            finally:
                house.session.close()

    return asyncio.run(body())
