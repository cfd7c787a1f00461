"""What the map on F3 teaches: a horizon accepted point by point, north for Calibrate, a beam for the feed."""

from __future__ import annotations

import asyncio
from dataclasses import replace

import map_stand_in
import pytest
import stand_in
from birdcage.base.config import load
from birdcage.base.paths import Paths
from birdcage.sim.settings import SimSettings
from birdcage.sky.horizon import HorizonMask
from birdcage.skymap.plan import MapPlan
from birdcage.station.requests import ApplySettings, Goto, Jog
from birdcage_tui.feeds.map_lessons import MapLessons
from birdcage_tui.shown.map_book import MapRead
from birdcage_tui.signal.map_pane import MapPane
from birdcage_tui.widgets.choice_screen import ChoiceScreen
from birdcage_tui.widgets.dialogs import TAKEN_IN_S, QuestionScreen
from horizon_stand_in import File
from map_stand_in import settle

from tests.skymap.arcs import simulated_arc
from tests.skymap.suns import around, simulated

SIZES = [(80, 24), (120, 36), (160, 48)]
TREES = map_stand_in.made()
TREES = replace(TREES, about={**TREES.about, "beam_az_deg": 3.0, "beam_el_deg": 3.0})


def on_f3(test, sky, keys=(), *, size=(120, 36), lessons=True, make=None, thrown_away=True, **settings):
    """Return what `test(app, pilot)` returns on F3 with this map, after these keys."""
    paths = Paths.default()
    told = MapLessons(lambda: load(paths.config_file), paths, thrown_away=thrown_away) if lessons else None

    async def body():
        app = map_stand_in.app_with(sky, lessons=told, **settings)
        app.maps.beside = lambda work: work()
        if make is not None:
            app.calibrate._make = make
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            await pilot.press("f3")
            await pilot.pause()
            app.page._show_map()
            for key in keys:
                await pilot.press(key)
                await settle(app, pilot)
            return await test(app, pilot)

    return asyncio.run(body())


async def read(app, _pilot):
    return stand_in.text_of(app)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_proposed_horizon_lies_over_the_map_and_says_what_each_point_is(size):
    async def seen(app, _pilot):
        return stand_in.text_of(app), app.page.query_one(MapPane), app.screen.region

    said, pane, screen = on_f3(seen, TREES, ("y", "enter"), size=size, horizon=File())
    assert screen.contains_region(pane.region)
    assert "a accepts" in said
    assert "Enter keeps 0" in said
    assert f"point 1 of {len(pane.offer.points)}" in said
    assert "not accepted" in said
    assert said.count("○") >= len(pane.offer.points) - 2  # one is under the cursor
    heights = [map_stand_in.tree_deg(each.az_deg) for each in pane.offer.points if not each.is_clear]
    found = [each.el_deg for each in pane.offer.points if not each.is_clear]
    assert max(abs(a - b) for a, b in zip(heights, found, strict=True)) < 2.0


def test_points_are_accepted_one_by_one_and_kept_with_enter():
    file = File(HorizonMask([(20.0, 5.0), (300.0, 5.0)]))

    async def seen(app, pilot):
        offer = app.page.query_one(MapPane).offer
        before = stand_in.text_of(app)
        await pilot.press("enter")
        await settle(app, pilot)
        return offer, before, stand_in.text_of(app), app.page.query_one(MapPane).offer

    offer, before, after, left = on_f3(seen, TREES, ("y", "enter", "a", "right", "a", "left", "a"), horizon=file)
    # The first, then the third; back to it from the fourth, which takes it back again.
    assert offer.accepted == {0}
    assert "Enter keeps 1" in before
    assert "Saved: horizon of" in after
    assert left is None
    kept = offer.points[0]
    assert (round(kept.az_deg, 3), round(kept.el_deg, 2)) in [(az, el) for az, el in file.mask.points]
    assert (20.0, 5.0) in file.mask.points
    assert file.mask.at(offer.points[2].az_deg) == pytest.approx(5.0)


def test_all_are_accepted_at_once_and_the_dish_is_not_moved():
    file = File(HorizonMask())

    async def seen(app, _pilot):
        return [each for each in app.station.asked if isinstance(each, Goto | Jog)]

    moves = on_f3(seen, TREES, ("y", "enter", "A", "left", "right", "enter"), horizon=file)
    assert moves == []
    inside = [az for az in range(140, 240, 5) if map_stand_in.tree_deg(az) > 20.0]
    assert len(inside) > 10
    assert max(abs(file.mask.at(az) - map_stand_in.tree_deg(az)) for az in inside) < 2.0


@pytest.mark.parametrize("key", ["q", "escape"])
def test_leaving_keeps_nothing(key):
    file = File(HorizonMask([(20.0, 5.0), (300.0, 5.0)]))

    async def seen(app, _pilot):
        return app.page.query_one(MapPane).offer, stand_in.text_of(app)

    offer, said = on_f3(seen, TREES, ("y", "enter", "A", key), horizon=file)
    assert offer is None
    assert "Enter keeps" not in said
    assert "Proposal discarded. The horizon is unchanged." in said
    assert file.mask == HorizonMask([(20.0, 5.0), (300.0, 5.0)])


def test_enter_without_an_accepted_point_says_so_and_keeps_the_proposal():
    file = File(HorizonMask())
    said = on_f3(read, TREES, ("y", "enter", "enter"), horizon=file)
    assert "No points accepted. The horizon is unchanged." in said
    assert "Enter keeps 0" in said
    assert not file.mask


def test_another_map_takes_the_proposal_away():
    async def seen(app, pilot):
        app.maps.book.read("another", MapRead.of(map_stand_in.made(heard=900)))
        await settle(app, pilot)
        return app.page.query_one(MapPane).offer

    assert on_f3(seen, TREES, ("y", "enter"), horizon=File()) is None


def test_what_a_map_does_not_teach_is_said():
    high = replace(map_stand_in.made(MapPlan(130.0, 250.0, 34.0, 50.0, 1.0)), about=TREES.about)
    assert "No trees stand out" in on_f3(read, high, ("y", "enter"), horizon=File())
    assert "counts are no power" in on_f3(read, TREES, ("y", "down", "down", "enter"))
    assert "no settings to keep it in" in on_f3(read, TREES, ("y",), lessons=False)


def test_the_list_tells_the_three_lessons():
    async def seen(app, _pilot):
        return isinstance(app.screen, ChoiceScreen), stand_in.text_of(app)

    is_open, said = on_f3(seen, TREES, ("y",), size=(80, 24))
    assert is_open
    for words in ("What this map teaches", "accepted point by point", "handed to Calibrate", "kept with the feed"):
        assert words in said, words


class Calibration:
    """Notes what is handed over."""

    def __init__(self):
        self.peaks = ()

    def start(self):
        """Nothing to begin."""

    def look(self):
        """Nothing to look at."""

    def close(self):
        """Nothing to end."""

    def put(self, peaks):
        self.peaks = tuple(peaks)


@pytest.mark.parametrize("agreed", [True, False])
def test_north_is_told_and_handed_to_calibrate_when_agreed(agreed):
    calibration = Calibration()

    async def seen(app, pilot):
        asked = isinstance(app.screen, QuestionScreen), stand_in.text_of(app)
        app.session.clock.advance(TAKEN_IN_S)
        await pilot.press("y" if agreed else "n")
        await settle(app, pilot)
        return asked, stand_in.text_of(app)

    (is_asked, said), after = on_f3(
        seen, simulated_arc(7.0, 1.2, -1.6), ("y", "down", "enter"), make=lambda _show: calibration
    )
    assert is_asked
    assert "Azimuth offset +7." in said
    assert "Tilt 2.0" in said or "Tilt 1.9" in said
    assert (len(calibration.peaks) >= 5, "handed to Calibrate" in after) == (agreed, agreed)


@pytest.mark.parametrize("agreed", [True, False])
def test_the_beam_is_kept_with_the_feed_and_told_to_the_station_when_agreed(agreed):
    async def seen(app, pilot):
        said = stand_in.text_of(app)
        app.session.clock.advance(TAKEN_IN_S)
        await pilot.press("y" if agreed else "n")
        await settle(app, pilot)
        return said, stand_in.text_of(app), [each for each in app.station.asked if isinstance(each, ApplySettings)]

    sky = simulated(SimSettings, around(12.0, 12.0, 1.5))
    said, after, applied = on_f3(seen, sky, ("y", "down", "down", "enter"))
    assert "K (" in said
    assert "dB/K" in said
    feed = load(Paths.default().config_file).active_feed
    assert (feed.beam_origin == "scan", len(applied), "Kept with the feed" in after) == (agreed, int(agreed), agreed)
    if agreed:
        assert applied[0].settings.active_feed == feed


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(
    ("sky", "keys"),
    [
        (TREES, ("enter", "A", "enter")),
        (simulated_arc(7.0, 1.2, -1.6), ("down", "enter")),
        (simulated(SimSettings, around(12.0, 12.0, 1.5)), ("down", "down", "enter")),
    ],
    ids=["horizon", "north", "beam"],
)
def test_what_a_simulated_sky_teaches_stays_out_of_the_settings_of_another_dish(sky, keys, size):
    file, config = File(HorizonMask()), Paths.default().config_file

    async def seen(app, _pilot):
        return isinstance(app.screen, QuestionScreen), stand_in.text_of(app)

    is_asked, said = on_f3(seen, sky, ("y", *keys), size=size, horizon=file, thrown_away=False)
    assert (is_asked, bool(file.mask), config.exists()) == (False, False, False)
    assert "DEMO map: nothing is kept, as birdcage.toml has no simulated port" in said
    own = replace(sky, demo=False)
    is_asked, said = on_f3(seen, own, ("y", *keys), size=size, horizon=file, thrown_away=False)
    assert is_asked or file.mask
    assert "DEMO map" not in said
