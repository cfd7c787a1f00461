"""A new user at F8: real engine, real station, simulated dish out of its box, keys in, bytes out. All in one thread."""

from __future__ import annotations

import asyncio
import functools
from dataclasses import fields
from datetime import UTC, datetime

import pytest
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.config import edit, load
from birdcage.base.geometry import shortest_turn
from birdcage.base.paths import Paths
from birdcage.link.link import Link
from birdcage.setup.engine import Setup
from birdcage.setup.first_run import is_first_run
from birdcage.setup.step import NAMES
from birdcage.signal.signal_tasks import signal_tasks
from birdcage.sim.almanac import sun
from birdcage.sim.port import SimPort, open_device
from birdcage.station.known import PortInfo, SystemFacts
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings, rules_from
from birdcage.station.station import Station
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.widgets.dialogs import QuestionScreen
from setup_stage import inside

NOON = datetime(2026, 3, 20, 18, 20, 0, tzinfo=UTC)
FRESH = "g2?boot=1&nvs20=0&home_fails=1&heading=30&seed=4"
"""Freshly booted, not homed, its TV search on; its zero looks at 30 degrees true."""
ADAPTER = PortInfo("/dev/ttyUSB0", None, "FT232R USB UART", "0403:6001", "A5", "1-1")


class Stepped(Session):
    """Begins without a thread: the test steps it."""

    def start(self) -> None:
        return


class Garden:
    """A dish, a laptop, and a person at its keys."""

    def __init__(self, folder, port, dish=FRESH, size=(120, 36)):
        self.clock, self.size = VirtualClock(NOON), size
        self.device = open_device(dish, clock=self.clock)
        self.paths = Paths.in_folder(folder)
        self.port = port

    def start(self):
        settings = load(self.paths.config_file, {})
        rules = rules_from(settings)
        wanted = StationSettings(
            port=settings.dish.port or self.port, firmware="g2", baud=settings.dish.baud, open_link=self._open,
            backup_folder=self.paths.backups, tasks=signal_tasks(),
            **{each.name: getattr(rules, each.name) for each in fields(rules)},
        )  # fmt: skip
        self.session = Stepped(self.clock, Station(self.clock, wanted))

        def make():
            self.setup = Setup(
                self.session, settings, self.paths, environ={}, ports=lambda: [ADAPTER], system=SystemFacts
            )
            return self.setup

        page = "setup" if is_first_run(settings, self.paths) or not wanted.port else "dashboard"
        self.app = BirdcageApp(self.session, AppOptions(setup=make, first_page=page))
        return self.app.run_test(size=self.size)

    def _open(self, port, baud):
        return Link(SimPort(self.device, port, baud=baud), self.clock)

    async def arrive(self, pilot):
        self.pilot = pilot
        for _ in range(4):
            await pilot.pause()

    async def step(self, seconds):
        for _ in range(round(seconds / 0.2)):
            self.session.step(0.2)
            self.setup.tick()
        await self.settle()

    async def settle(self):
        for _ in range(3):
            self.app.paint()
            await self.pilot.pause()

    async def until(self, what, seconds=90):
        end = self.clock.monotonic() + seconds
        while not what():
            assert self.clock.monotonic() < end, self.text()
            await self.step(1.0)

    async def press(self, *keys):
        for key in keys:
            await self.pilot.press(key)
        await self.settle()

    async def answer(self, *keys):
        """Press, and wait until nothing is under way."""
        await self.press(*keys)
        await self.until(lambda: not self.setup.busy)

    async def type(self, text):
        for letter in text:
            await self.pilot.press({"-": "minus", ".": "full_stop", ":": "colon"}.get(letter, letter))

    def text(self):
        return stand_in.text_of(self.app)

    def moves(self):
        with self.device.lock:
            self.device.machine.run()
            return [line for _at, line in self.device.shell.received if line.startswith(("a ", "h ", "g "))]

    def looks_at(self):
        truth = self.device.truth()
        return (truth.az_deg + self.device.settings.heading) % 360.0, truth.el_deg


def played(play):
    """Make a plain test of a coroutine."""

    @functools.wraps(play)
    def test(*args, **kwargs):
        asyncio.run(play(*args, **kwargs))

    return test


async def wires_to_feed(garden):
    setup = garden.setup
    assert "No port set" in garden.text()
    await garden.press("1")
    await garden.until(lambda: setup.current == "search")
    assert "✓ 1  Link" in garden.text()
    await garden.until(lambda: setup.step("search").choices)
    await garden.answer("enter")
    while not setup.step("search").evidence.startswith("saved"):
        await garden.answer("enter")  # the first Enter lets go of what its own search had latched
        await garden.step(0.4)
    garden.device.power_cycle()
    for _ in range(200):
        await garden.step(0.4)
        state = garden.app.station.state
        if state.fault is not None or state.held is not None:
            await garden.press("enter")  # a person reads it, and lets go
        if setup.current == "home" and state.held is None and state.fault is None:
            break
    assert setup.current == "home", garden.text()
    assert garden.moves() == []
    await garden.press("enter")
    assert isinstance(garden.app.screen, QuestionScreen)
    await garden.press("n")
    await garden.step(5)
    assert garden.moves() == []
    await garden.press("enter")
    await garden.answer("y")
    await garden.until(lambda: setup.current == "feed")
    assert any(line.startswith("h ") for line in garden.moves())


@played
async def test_from_wires_to_a_dish_that_points_and_resumed_half_way(tmp_path):
    garden = Garden(tmp_path, "")
    async with garden.start() as pilot:
        await garden.arrive(pilot)
        assert garden.app.page.scope == "setup", "it opens by itself"
        await garden.step(1)
        await wires_to_feed(garden)
        await garden.answer("enter")
        assert garden.setup.current == "limits"
    garden.session.close()

    async with garden.start() as pilot:
        await garden.arrive(pilot)
        assert garden.app.page.scope == "dashboard", "and never again by itself"
        await garden.press("f8")
        await garden.step(8)
        assert garden.setup.current == "limits"
        assert "▶ ○ 6  Limits" in garden.text()
        assert "backup nvs-g2-" in garden.text()
        before = len(garden.moves())
        await garden.answer("enter")
        await garden.press("enter")
        await garden.press("y")
        await garden.until(lambda: not garden.setup.busy)
        await garden.answer("y")
        await garden.answer("y")
        assert len(garden.moves()) > before
        await garden.press("s")
        assert garden.setup.current == "place"
        await place_and_north(garden)
        assert garden.setup.current == "first"
        assert "Find it by its signal" in garden.text()
        await garden.press("enter")  # into the satellite's name
        await garden.press("enter")
        await garden.step(5)
        assert "directions heard" in garden.text()
        await garden.until(lambda: not garden.setup.busy, 600)
        assert "Most likely it is EchoStar 16 (61.5°W)" in garden.text()
        assert not garden.setup.finished
        await garden.answer("enter")
        assert garden.setup.step("first").evidence.endswith("north set by it")
        assert garden.setup.finished
        assert "The setup is complete, but for Level" in " ".join(garden.text().replace("│", " ").split())
        assert load(garden.paths.config_file, {}).alignment.az_offset_deg == pytest.approx(30.0, abs=0.2)
    garden.session.close()


async def place_and_north(garden):
    setup = garden.setup
    typed = next(choice for choice in setup.step("place").choices if choice.name == "typed")
    await garden.press(typed.key)
    for field in typed.fields:
        value = {"latitude_deg": "39.1", "longitude_deg": "-95.7", "height_m": "250"}.get(field.name, "")
        box = next(box for box in garden.app.page.form.query("Input") if box.name == f"typed/{field.name}")
        box.focus()
        await garden.settle()
        box.value = ""
        await garden.type(value)
    await garden.press("enter")
    trust = next(choice for choice in setup.step("place").choices if choice.name == "trust")
    await garden.answer(trust.key)
    assert setup.current == "north", garden.text()
    assert garden.app.settings.place.latitude_deg == 39.1
    for _ in range(3):
        az_deg, el_deg = sun(garden.clock.utc(), 39.1, -95.7)
        looks_at = garden.looks_at()
        setup.choose("north", "jog", {
            "d_az_deg": f"{shortest_turn(looks_at[0], az_deg):.2f}", "d_el_deg": f"{el_deg - looks_at[1]:.2f}",
        })  # fmt: skip
        await garden.until(lambda: not setup.busy)
    await garden.step(2)
    await garden.press("enter")
    await garden.answer("enter")
    await garden.until(lambda: setup.current == "first")


@played
async def test_a_wrong_speed_is_found_and_mended_with_two_keys(tmp_path):
    garden = Garden(tmp_path, "/dev/ttyUSB0")
    edit(garden.paths.config_file, {"dish.baud": 57600})
    async with garden.start() as pilot:
        await garden.arrive(pilot)
        await garden.press("f8")
        await garden.step(12)
        text = garden.text()
        assert "✕ 1  Link" in text
        assert "What may be wrong" in text
        assert "Enter  Listen at other speeds" in text
        await garden.answer("enter")
        text = garden.text()
        assert "115200: prompt" in text
        assert "Connect at 115200 baud" in text
        await garden.answer("enter")
        await garden.until(lambda: garden.setup.current != "link")
        assert "115200 8N1" in garden.text()
        assert garden.moves() == []
    garden.session.close()


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (200, 60)], ids=str)
@played
async def test_every_step_with_its_own_words_is_whole_on_the_screen(tmp_path, size):
    garden = Garden(tmp_path, "/dev/ttyUSB0", "g2?seed=1", size)
    place = {"place.latitude_deg": 39.1, "place.longitude_deg": -95.7, "setup.clock": "trusted 2026-03-20T12:00Z"}
    edit(garden.paths.config_file, place)
    async with garden.start() as pilot:
        await garden.arrive(pilot)
        await garden.press("f8")
        await garden.step(6)
        for name in NAMES:
            garden.setup.go(name)
            await garden.step(0.4)
            await garden.settle()
            assert garden.setup.current == name
            inside(garden.app, garden.setup, causes=False)
    garden.session.close()
