"""F2 on a real station and a simulated dish: what hands do arrives at the dish, or says why not."""

import pytest
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shown.options import SitePlace
from test_end_to_end import House, played, press
from textual.widgets import Input


async def typed(house, text):
    await press(house, "g")
    house.app.query_one(Input).value = text
    await press(house, "enter")


async def arrived(house, text, *, seconds=6):
    await typed(house, text)
    await house.step(seconds)


@pytest.fixture
def house(tmp_path):
    house = House()
    house.app.settings = AppOptions(place=SitePlace(39.1, -95.7))
    house.app.presets._path = tmp_path / "presets.toml"
    return house


def at(house):
    truth = house.device.truth()
    return pytest.approx((truth.az_deg % 360, truth.el_deg), abs=0.13)


async def begin(house):
    await house.step(3)
    await press(house, "f2")
    await house.step(1)
    await arrived(house, "195.5 40")


@played
async def test_ten_presses_and_one_nudge_each_arrive_whole(house):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await begin(house)
        assert at(house) == (195.5, 40.0)
        await press(house, *["l"] * 10)
        await house.step(4)
        assert at(house) == (205.5, 40.0)
        await press(house, "n", "left", "down", "right", "right", "up", "right", "right", "right", "down")
        await house.step(4)
        assert at(house) == (195.6, 39.0), "it carries over the tens, as a jog does"


@played
async def test_beyond_a_limit_it_says_which_and_by_how_much_and_sends_nothing(house):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await begin(house)
        before = house.clock.monotonic()
        await press(house, "g")
        house.app.query_one(Input).value = "200 10"
        await house.step(0.1)
        assert "Refused: Elevation 10.00° is 8.00° below the floor of 18.00°." in house.text()
        await press(house, "enter")
        await house.step(1)
        assert "Refused: Elevation 10.00° is 8.00° below the floor of 18.00°." in house.text()
        assert house.app.query_one("GotoLine").is_open, "there it can be mended"
        assert house.moves(before) == []


@pytest.mark.parametrize(
    ("wish", "where"),
    [("200,5 41", (200.5, 41.0)), ("S", (180.0, 40.0)), ("el=+3", (195.5, 43.0)), ("+5 -2", (200.5, 38.0))],
)
@played
async def test_what_is_typed_is_where_it_goes(house, wish, where):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await begin(house)
        await arrived(house, wish)
        assert at(house) == where
        assert "Arrived at " in house.text()


@played
async def test_a_kept_direction_is_gone_to_again(house):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await begin(house)
        await press(house, "a", *"Roof", "enter")
        await house.step(0.2)
        assert "Roof" in house.text()
        await arrived(house, "230 30")
        assert at(house) == (230.0, 30.0)
        await press(house, "p", "enter")
        await house.step(5)
        assert at(house) == (195.5, 40.0)


@played
async def test_after_the_motors_were_released_nothing_is_pretended(house):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await begin(house)
        await press(house, "R")
        await press(house, "y")
        await house.step(3)
        text = house.text()
        assert "AZ ---.--" in text
        assert "◉" not in text
        assert "MOTORS RELEASED" in text or "NOT HOMED" in text
        since = house.clock.monotonic()
        await press(house, "l", "n", "up", "g", *"90", "space", *"40", "enter")
        assert house.app.query_one("GotoLine").is_open, "it stays, and says why nothing is sent"
        assert "Home it first" in house.text()
        await house.step(2)
        assert house.moves(since) == []


@played
async def test_a_slower_speed_is_set_and_read_back(house):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await begin(house)
        assert "speed 65.0/45.0 °/s" in house.text()
        await press(house, "v")
        house.app.screen.query(Input).first().value = "20"
        await press(house, "enter")
        await house.step(3)
        assert "speed 20.0/45.0 °/s" in house.text()
