"""The horizon on a real station and a simulated dish: what is recorded is where the dish really rests."""

import pytest
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.config import PlaceSettings, Settings
from birdcage.base.paths import Paths
from birdcage.sky.horizon import HorizonMask
from birdcage_tui.feeds.horizon_book import HorizonBook
from birdcage_tui.feeds.sky_feed import make_sky
from horizon_stand_in import File
from test_end_to_end import House, played, press, type_direction


@pytest.fixture(params=["g2", "hal205"])
def house(request):
    house = House(f"{request.param}?seed=1")
    book = HorizonBook(File(HorizonMask()))
    house.app.horizon = house.app.feeds.horizon = house.app.dishes.shown.horizon = book
    return house


async def rest(house):
    """Let it arrive, and stand a while, looked at as the app looks."""
    await house.step(30 if house.app.station.state.dish.skew else 8)
    for _ in range(4):
        await house.step(0.5)


def truth(house):
    found = house.device.truth()
    return pytest.approx((found.az_deg % 360, found.el_deg), abs=0.13)


@played
async def test_jogging_along_the_tree_line_records_it_and_nothing_else(house):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await house.step(3)
        await press(house, "f2")
        await type_direction(house, 220, 40)
        await rest(house)
        await press(house, "M")
        await rest(house)
        assert house.app.horizon.mask.points == (), "where it was sent by a go-to is no tree"
        where = []
        for keys in ("lll", "jj", "ll"):
            await press(house, *keys)
            assert "● recording" in house.text()
            await rest(house)
            where.append(truth(house))
        points = house.app.horizon.mask.points
        assert len(points) == 2, "the second measured the first azimuth again"
        assert points[0] == where[1]
        assert points[1] == where[2]
        before = house.clock.monotonic()
        await press(house, "M", "m", "z", "Z", "y", "z")
        await rest(house)
        assert house.moves(before) == [], "the horizon moves nothing"
        assert house.app.horizon.mask.points == points


@played
async def test_a_slew_gives_no_point(house):
    async with house.app.run_test(size=(120, 36)) as house.pilot:
        await house.step(3)
        await press(house, "f2")
        await type_direction(house, 220, 40)
        await house.step(0.6)
        await press(house, "m")
        await house.step(0.1)
        assert house.app.horizon.mask.points == ()
        assert any(words in house.text() for words in ("The dish is moving or may move.", "only modelled"))


def test_the_watch_of_the_sky_takes_it_over_the_settings(tmp_path):
    clock = VirtualClock()
    place = PlaceSettings(latitude_deg=39.1, longitude_deg=-95.7, horizon=((0.0, 5.0), (180.0, 5.0)))
    shown = []
    source = make_sky(Settings(place=place), Paths.in_folder(tmp_path), clock, demo=True, threads=False)(
        shown.append, print
    )
    state = stand_in.at_rest(clock)
    source.keep(state, None)
    source.start()
    source.step()
    before = shown[-1]
    source.keep(state, None, HorizonMask([(0.0, 64.0), (180.0, 64.0)]))
    clock.advance(2.0)
    source.step()
    trees = shown[-1]
    source.keep(state, None, HorizonMask())
    clock.advance(2.0)
    source.step()
    source.close()
    assert before.mask == HorizonMask([(0.0, 5.0), (180.0, 5.0)])
    assert trees.mask == HorizonMask([(0.0, 64.0), (180.0, 64.0)])
    assert sum(row.reach_s for row in trees.rows) < sum(row.reach_s for row in before.rows) / 4
    assert not shown[-1].mask
