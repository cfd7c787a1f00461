"""Two stations and two simulated dishes in one app, on virtual clocks: keys in, bytes out."""

from __future__ import annotations

import pytest
from birdcage.base.errors import Held
from birdcage.station.requests import Goto
from birdcage.station.state import Activity, LinkPhase
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.options import SitePlace
from test_end_to_end import House, played, press

SIZE = (120, 36)


class TwoHouses:
    def __init__(self, first="g2?seed=1", second="hal205?seed=2"):
        self.houses = House(first), House(second)
        (first, second), options = self.houses, AppOptions(place=SitePlace(39.1, -95.7))
        self.app = BirdcageApp(first.session, options, (second.session, options))
        self.pilot = None

    async def step(self, seconds):
        for house in self.houses:
            house.session.step(seconds)
        await self.pilot.pause()
        self.app.paint()
        await self.pilot.pause()

    async def move_both(self):
        """Send both on a long way, and wait until both are on it."""
        await self.step(3)
        for house in self.houses:
            house.station.submit(Goto(220.0, 40.0, "you"))
        await self.step(0.6)
        assert [house.station.state.activity for house in self.houses] == [Activity.SLEWING] * 2

    def rows(self):
        strips = self.app.screen._compositor.render_strips()
        return ["".join(segment.text for segment in strip) for strip in strips]


@pytest.fixture
def two():
    return TwoHouses()


@pytest.mark.parametrize("key", ["space", "ctrl+c", "escape"])
@played
async def test_one_key_stops_and_holds_both(two, key):
    async with two.app.run_test(size=SIZE) as two.pilot:
        await two.move_both()
        await press(two, key)
        first, second = two.houses
        assert [house.station.stop_reach.value for house in two.houses] == ["sent", "sent"], "before any station turns"
        await two.step(10)
        for house in two.houses:
            assert not house.device.truth().moving
            assert abs(house.device.truth().az_deg - 220.0) > 5.0
            assert house.station.state.held.by == "you"
            assert house.station.state.last_stop.confirmed
        assert "HELD" in two.rows()[1]
        await press(two, "enter")
        await two.step(1)
        assert first.station.state.held is None
        assert second.station.state.held is not None, "release is by machine"
        refused = second.station.submit(Goto(200.0, 40.0, "you"))
        moved = first.station.submit(Goto(200.0, 40.0, "you"))
        await two.step(10)
        assert isinstance(refused.exception(0), Held)
        assert moved.exception(0) is None
        assert first.device.truth().az_deg == pytest.approx(200.0, abs=0.2)
        await press(two, "O")
        await press(two, "enter")
        await two.step(1)
        assert second.station.state.held is None


@played
async def test_a_motion_of_one_dish_goes_on_while_the_other_is_shown(two):
    async with two.app.run_test(size=SIZE) as two.pilot:
        await two.move_both()
        await press(two, "O")
        await two.step(0.2)
        assert "Trav'ler" in two.rows()[0]
        assert "SLEWING" in two.rows()[1]
        await two.step(60)
        for house in two.houses:
            assert house.device.truth().az_deg == pytest.approx(220.0, abs=0.2)
        assert "IDLE" in two.rows()[1]


@played
async def test_the_row_shows_where_the_other_dish_is_now(two):
    async with two.app.run_test(size=SIZE) as two.pilot:
        await two.step(3)
        second = two.houses[1]
        second.station.submit(Goto(220.0, 40.0, "you"))
        await two.step(60)
        position = second.station.state.position
        assert f"{position.az_deg:6.2f}°" in two.rows()[1]
        assert position.az_deg == pytest.approx(220.0, abs=0.2)


@played
async def test_a_dead_dish_does_not_hinder_the_other(two):
    async with two.app.run_test(size=SIZE) as two.pilot:
        await two.move_both()
        first, second = two.houses
        second.device.unplug()
        await two.step(3)
        assert second.station.state.link.state is LinkPhase.LOST
        await press(two, "space")
        await two.step(5)
        assert not first.device.truth().moving
        assert [house.station.state.held is not None for house in two.houses] == [True, True]
        assert "LOST" in two.rows()[1]
        await press(two, "enter")
        first.station.submit(Goto(200.0, 40.0, "you"))
        await two.step(10)
        assert first.device.truth().az_deg == pytest.approx(200.0, abs=0.2)


@played
async def test_the_end_stops_both_and_says_where_each_is(two):
    async with two.app.run_test(size=SIZE) as two.pilot:
        await two.move_both()
        await press(two, "ctrl+q")
    words = two.app.dishes.end("quit", 0.0).splitlines()
    assert [line[:3] for line in words] == ["1  ", "2  "]
    assert all("STOP was sent" in line for line in words)
    for house in two.houses:
        house.clock.advance(10.0)
        assert not house.device.truth().moving
        assert abs(house.device.truth().az_deg - 220.0) > 5.0
