"""The app on a dish that shares no code with our simulator: keys in, and the dish's own record."""

import asyncio
import random
import re

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import STOCK_FEED
from birdcage.link.link import Link
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.station import Station
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace

from tests.shared.night import by_night
from tests.standin.covering import HEALTHY, STRANGE, pairwise, singles
from tests.standin.dish import StandIn
from tests.standin.habits import Habits
from tests.standin.ports import MemoryPort

SIZE = (120, 36)
PAGES = ("f1", "f2", "f3", "f4", "f5", "f6", "f7", "f8")
KEYS = (*PAGES, "escape", "enter", "space", "question_mark", "tab", "up", "down", "left", "right", *"hjklgmsbcd1290",
        "full_stop", "colon", "semicolon", "slash", "backspace", "ctrl+c")  # fmt: skip
SOME = (
    {},
    {"second_same": "block", "second_other": "block", "decimals": 1, "colour": True, "pieces": True},
    {"homed": False, "unhomed_as": "hundredths", "root_q": "dies", "chatter_s": 1.0, "jitter_s": 0.2},
)
"""Of the fast set; the soak has them all."""
STANDS = re.compile(r"Stands still at ([\d.]+)°/([\d.]+)°")


class Stepped(Session):
    """Begins without a thread: the test steps it."""

    def start(self):
        return


class Room:
    """The app, its station and the dish."""

    def __init__(self, **habits):
        self.clock = VirtualClock()
        self.dish = StandIn(self.clock.monotonic, Habits(**{"az_speed": 20.0, "el_speed": 12.0, **habits}))
        settings = StationSettings("standin", "g2", self._open, feed=STOCK_FEED, feed_name="stock-ku")
        self.station = Station(self.clock, settings)
        self.session = Stepped(self.clock, self.station)
        self.app = BirdcageApp(self.session, AppOptions(place=SitePlace(39.1, -95.7)))

    def _open(self, port, baud):
        return Link(MemoryPort(self.dish, port, baud), self.clock)

    async def step(self, seconds):
        self.session.step(seconds)
        await self.pilot.pause()
        self.app.paint()
        await self.pilot.pause()
        self.judge()

    async def press(self, *keys):
        await self.pilot.press(*keys)
        await self.pilot.pause()

    def text(self):
        strips = self.app.screen._compositor.render_strips()
        return "\n".join("".join(segment.text for segment in strip) for strip in strips)

    def judge(self):
        """Nothing ends the app, nothing leaves its limits, and what is said of rest is so."""
        dish = self.dish
        assert self.app.is_running
        assert dish.root_q == 0
        low, high = dish.span(1)
        assert low > 17.9
        assert high < 65.1
        for each in dish.asked():
            assert 0.0 <= each.deg <= 360.0 if each.axis == 0 else 18.0 <= each.deg <= 65.0
        told = STANDS.search(self.text())
        last = self.station.state.last_stop
        if told and last is not None and self.clock.monotonic() - last.at < 1.0:
            assert not dish.moves(), self.text()


async def evening(room):
    """Look at each page, go somewhere, stop on the way, release, jog, talk to the console, go again."""
    await room.step(5)
    for page in PAGES:
        await room.press(page)
        await room.step(0.5)
        await room.press("escape")
    await room.press("f1", "g", *"200", "comma", *"30", "enter")
    await room.step(1.5)
    await room.press("ctrl+c")
    await room.step(8)
    moving = room.dish.moves()
    words = room.text()
    assert room.station.state.held is not None, words
    assert not moving or "STOP" in words, words
    await room.step(30)
    await room.press("enter")
    await room.step(1)
    await room.press("f2", "right", "right", "up")
    await room.step(5)
    await room.press("f5", "enter", "a", "enter")
    await room.step(2)
    await room.press("question_mark", "enter")
    await room.step(2)
    await room.press("escape", "escape", "f1", "g", *"100", "comma", *"50", "enter")
    await room.step(60)


async def storm(room, seed, count):
    """Press keys at random, singly and in bursts."""
    rng = random.Random(seed)
    await room.step(3)
    pressed = 0
    while pressed < count:
        keys = rng.choices(KEYS, k=rng.choice((1, 1, 2, 4)))
        pressed += len(keys)
        await room.press(*keys)
        await room.step(rng.choice((0.0, 0.1, 1.0)))


def play(story, habits, *more):
    async def body():
        room = Room(**habits)
        async with room.app.run_test(size=SIZE) as room.pilot:
            await story(room, *more)
        return room

    return asyncio.run(body())


@pytest.mark.parametrize("habits", SOME, ids=str)
def test_an_evening(habits):
    room = play(evening, habits)
    if not habits:
        assert room.dish.where() == (pytest.approx(100.0, abs=0.05), pytest.approx(50.0, abs=0.05))


def test_keys_at_random():
    play(storm, {"second_same": "block", "second_other": "block", "chatter_s": 2.0}, 1, 60)


@pytest.mark.soak
@pytest.mark.parametrize("habits", by_night([*singles(STRANGE), *pairwise(HEALTHY)], 4), ids=str)
def test_an_evening_at_every_dish(habits):
    play(evening, habits)


@pytest.mark.soak
@pytest.mark.parametrize("seed", by_night(range(6), 1))
def test_many_keys_at_random(seed):
    rng = random.Random(seed)
    play(storm, rng.choice(singles(HEALTHY)) | rng.choice(singles(STRANGE)), seed, 400)
