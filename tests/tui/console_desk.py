"""The app with the console open on a stand-in station, and hands on it."""

import asyncio
from dataclasses import replace

import stand_in
from birdcage.base.held import HeldReason
from birdcage.station.raw import TranscriptEntry
from birdcage.station.requests import Raw
from birdcage.station.state import HeldState
from birdcage_tui.console.entry import ConsoleInput
from birdcage_tui.console.log import LogView

KEYS = {" ": "space", "?": "question_mark", "*": "asterisk", "+": "plus", "-": "minus", ".": "full_stop"}


class Desk:
    """The app with the console open, and hands on it."""

    def __init__(self, app, pilot):
        self.app, self.pilot, self.clock = app, pilot, app.session.clock

    @property
    def log(self):
        return self.app.query_one(LogView)

    @property
    def line(self):
        return self.app.query_one(ConsoleInput)

    async def press(self, *keys):
        await self.pilot.press(*keys)
        await self.pilot.pause()

    async def type(self, text):
        if not self.line.has_focus:
            await self.press("i")
        await self.press(*[KEYS.get(letter, letter) for letter in text])

    def wire(self, direction, *lines):
        for line in lines:
            self.app.session.wire(TranscriptEntry(self.clock.utc(), direction, line))

    async def look(self):
        self.app.paint()
        await self.pilot.pause()
        return stand_in.text_of(self.app)

    def latch(self):
        """Let STOP be latched, as it is before its first byte."""
        self.state(held=HeldState("you", self.clock.monotonic(), self.clock.utc(), HeldReason.STOP))

    def state(self, **changes):
        self.app.station.state = replace(self.app.station.state, **changes)

    def raw(self):
        return [(each.line, each.confirmed) for each in self.app.station.asked_for(Raw)]

    def words(self):
        """The text of the screen in which wrapped sentences stand in one piece."""
        return " ".join(stand_in.text_of(self.app).replace("│", " ").split())


def desk(test, name="idle", size=(80, 24), **options):
    async def body():
        app = stand_in.app_in(name, **options)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            await pilot.press("f5")
            await pilot.pause()
            await pilot.pause()
            at = Desk(app, pilot)
            await at.look()
            return await test(at)

    return asyncio.run(body())


def numbered(count, first=0):
    return [b"line %d\r\n" % number for number in range(first, first + count)]
