"""The app on a real station and a simulated dish, all in one thread on a virtual clock: keys in, bytes out."""

from __future__ import annotations

import asyncio
import functools
from datetime import UTC, datetime

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.config import STOCK_FEED
from birdcage.base.errors import LinkError
from birdcage.base.held import HeldNote
from birdcage.link.link import Link
from birdcage.sim.port import SimPort, open_device
from birdcage.station.held_keeper import HeldKeeper
from birdcage.station.requests import Goto
from birdcage.station.session import Session
from birdcage.station.settings import StationSettings
from birdcage.station.station import Station
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace

SIZE = (120, 36)


class Stepped(Session):
    """Begins without a thread: the test steps it."""

    def start(self) -> None:
        return


class House:
    def __init__(self, address="g2?seed=1", **more):
        firmware = address.partition("?")[0]
        self.clock = VirtualClock()
        self.device = open_device(address, clock=self.clock)
        settings = StationSettings(
            f"sim:{firmware}", firmware, self._open, feed=STOCK_FEED, feed_name="stock-ku", **more
        )
        self.station = Station(self.clock, settings)
        self.session = Stepped(self.clock, self.station)
        self.app = BirdcageApp(self.session, AppOptions(place=SitePlace(39.1, -95.7)))
        self.pilot = None

    def _open(self, port, _baud):
        try:
            return Link(SimPort(self.device, port), self.clock)
        except ConnectionError as error:
            raise LinkError(str(error), reason="missing") from error

    async def step(self, seconds):
        self.session.step(seconds)
        await self.pilot.pause()
        self.app.paint()
        await self.pilot.pause()

    def text(self):
        strips = self.app.screen._compositor.render_strips()
        return "\n".join("".join(segment.text for segment in strip) for strip in strips)

    def moves(self, since):
        with self.device.lock:
            self.device.machine.run()
            return [
                line for at, line in self.device.shell.received if at > since and line.startswith(("a ", "h ", "g "))
            ]


@pytest.fixture(params=["g2", "hal205"])
def house(request):
    return House(f"{request.param}?seed=1")


@pytest.fixture
def g2():
    return House()


def played(play):
    """Make a plain test of a coroutine."""

    @functools.wraps(play)
    def test(*args, **kwargs):
        asyncio.run(play(*args, **kwargs))

    return test


async def press(house, *keys):
    await house.pilot.press(*keys)
    await house.pilot.pause()


async def type_direction(house, az, el):
    await press(house, "g")
    for letter in f"{az},{el}":
        await press(house, {",": "comma", ".": "full_stop"}.get(letter, letter))
    await press(house, "enter")


@played
async def test_a_person_drives_the_dish(house):
    async with house.app.run_test(size=SIZE) as house.pilot:
        await house.step(3)
        assert "IDLE" in house.text()
        await type_direction(house, 220, 40)
        await house.step(0.6)
        assert "SLEWING" in house.text()
        await house.step(60 if house.app.station.state.dish.skew else 5)
        assert "219.9" in house.text() or "220.0" in house.text()
        truth = house.device.truth()
        assert (truth.az_deg, truth.el_deg) == (pytest.approx(220, abs=0.07), pytest.approx(40, abs=0.07))


@pytest.mark.parametrize("key", ["space", "ctrl+c", "escape"])
@played
async def test_each_stop_key_stops_a_slew_and_holds(house, key):
    async with house.app.run_test(size=SIZE) as house.pilot:
        await house.step(3)
        await type_direction(house, 220, 40)
        await house.step(0.8)
        assert house.device.truth().moving
        before = house.clock.monotonic() - 0.001
        await press(house, key)
        await house.step(2)
        if house.app.station.state.dish.slew is None:
            assert any(line.startswith("a 0") for line in house.moves(before))
        else:
            assert house.moves(before) == [], "a byte ends its slew: no new target"
        assert not house.device.truth().moving
        assert "HELD by you" in house.text()


@played
async def test_a_client_that_asks_every_second_moves_nothing_after_space(house):
    async with house.app.run_test(size=SIZE) as house.pilot:
        await house.step(3)
        house.station.submit(Goto(200, 40, "Gpredict"))
        await house.step(0.5)
        await press(house, "space")
        await house.step(0.5)
        since = house.clock.monotonic()
        for second in range(60):
            house.station.submit(Goto(100 + second, 40, "Gpredict"))
            house.session.step(1)
        await house.step(0)
        assert house.moves(since) == []
        assert "Gpredict" in house.text()
        assert "ignored" in house.text()
        await press(house, "enter")
        await house.step(1)
        assert "HELD" not in house.text()
        assert house.moves(since) == []


@played
async def test_still_held_after_unplug_and_replug(house):
    async with house.app.run_test(size=SIZE) as house.pilot:
        await house.step(3)
        await type_direction(house, 220, 40)
        await house.step(0.5)
        await press(house, "space")
        await house.step(0.5)
        since = house.clock.monotonic()
        house.device.unplug()
        await house.step(4)
        assert "LINK LOST" in house.text()
        house.device.plug()
        for _second in range(60):
            house.station.submit(Goto(100, 40, "Gpredict"))
            house.session.step(1)
        await house.step(0)
        assert house.moves(since) == []
        assert "HELD" in house.text()


@played
async def test_an_unhomed_dish_shows_no_position():
    house = House("g2?seed=1&unhomed=1")
    async with house.app.run_test(size=SIZE) as house.pilot:
        await house.step(3)
        assert "NOT HOMED" in house.text()
        assert "AZ ---.--" in house.text()


@played
async def test_a_silent_port_is_told_and_shows_no_position():
    house = House()
    house.device.wire.to_host.silent = True
    async with house.app.run_test(size=SIZE) as house.pilot:
        await house.step(2.1)
        assert "AZ ---.--" in house.text()
        assert "SILENT" in house.text() or "does not answer" in house.text()


@played
async def test_a_dish_that_an_earlier_program_left_held_is_released_by_enter(tmp_path, monkeypatch):
    monkeypatch.setenv("LOGNAME", "anna")
    keeper = HeldKeeper(tmp_path, lambda _port: "usb:0403:6001:A5")
    keeper.meet("sim:g2")
    keeper.latch(HeldNote("you", datetime(2026, 3, 19, 18, 20, 11, tzinfo=UTC)))
    keeper.close(5)
    keeper = HeldKeeper(tmp_path, lambda _port: "usb:0403:6001:A5")
    house = House(held_keeper=keeper)
    async with house.app.run_test(size=SIZE) as house.pilot:
        await house.step(3)
        assert "HELD by anna 19 Mar 18:20:11" in house.text()
        assert "birdcage sends no motion until you press Enter." in " ".join(house.text().split())
        await type_direction(house, 220, 40)
        await house.step(1)
        assert house.moves(0.0) == []
        await press(house, "escape", "enter")
        await house.step(1)
        assert "HELD" not in house.text()
        assert keeper.flush(5)
        assert not list(tmp_path.rglob("held.json"))
    keeper.close(5)


@played
async def test_where_held_cannot_be_kept_the_app_says_so_and_stop_goes_out(tmp_path):
    (tmp_path / "dishes").write_text("in the way")
    keeper = HeldKeeper(tmp_path, lambda _port: "usb:0403:6001:A5")
    house = House(held_keeper=keeper)
    async with house.app.run_test(size=(160, 48)) as house.pilot:
        await house.step(3)
        await type_direction(house, 220, 40)
        await house.step(0.8)
        before = house.clock.monotonic() - 0.001
        await press(house, "space")
        assert any(line.startswith("a 0") for line in house.moves(before))
        await house.step(2)
        assert keeper.flush(5)
        await house.step(0.1)
        assert "NOT KEPT" in house.text()
        assert "HELD ends with this program" in " ".join(house.text().replace("│", " ").split())
    keeper.close(5)
