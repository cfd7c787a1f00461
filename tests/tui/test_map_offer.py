"""A horizon proposed on the map: whose the keys are, what Enter does first, and when a result may come up."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import pytest
import stand_in
from birdcage.sky.horizon import HorizonMask
from birdcage.skymap.horizon_lesson import HorizonEdge
from birdcage.skymap.plan import MapPlan
from birdcage.station.requests import AcknowledgeFault, Jog, Release
from birdcage_tui.shown.map_offer import MapOffer
from birdcage_tui.signal.map_chart import MapChart
from birdcage_tui.signal.map_offer_drawing import draw_offer
from birdcage_tui.signal.map_overlay import MapOverlay
from birdcage_tui.signal.map_pane import MapPane
from birdcage_tui.widgets.dialogs import TAKEN_IN_S, QuestionScreen
from horizon_stand_in import File
from map_stand_in import settle
from test_map_teach import TREES, on_f3

from tests.skymap.arcs import simulated_arc

HERE = stand_in.PLACE


async def press(app, pilot, *keys):
    for key in keys:
        await pilot.press(key)
        await settle(app, pilot)
    await settle(app, pilot)
    return stand_in.text_of(app)


@pytest.mark.parametrize(("there", "back"), [("down", "up"), ("j", "k"), ("right", "left"), ("l", "h")])
def test_every_arrow_goes_from_point_to_point_and_none_moves_the_dish(there, back):
    async def seen(app, pilot):
        points = []
        for keys in ((there, there), (back,)):
            await press(app, pilot, *keys)
            points.append(app.page.query_one(MapPane).offer.at)
        return points, app.station.asked_for(Jog)

    assert on_f3(seen, TREES, ("y", "enter"), horizon=File()) == ([2, 1], [])


@pytest.mark.parametrize("keys", [("i",), ("v", "v", "v")], ids=str)
@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
def test_a_proposal_without_the_focus_says_how_to_return_and_the_arrows_are_the_dishs(keys, size):
    async def seen(app, pilot):
        app.page._show_map()
        if keys == ("i",):
            app.screen.set_focus(None)
            away = await press(app, pilot)
        else:
            away = await press(app, pilot, *keys)
        await press(app, pilot, "right")
        jogs = app.station.asked_for(Jog)
        return away, jogs, await press(app, pilot, "i"), app.page.query_one(MapPane).offer

    away, jogs, back, offer = on_f3(seen, TREES, ("y", "enter", "a"), horizon=File(), size=size)
    assert "i returns to it" in away
    assert "a accepts" not in away
    assert f"point 2 of {len(offer.points)}" not in away
    assert len(jogs) == 1
    assert "Enter keeps 1" in back


def test_a_dialog_over_a_proposal_leaves_it_as_it_was():
    async def seen(app, pilot):
        await press(app, pilot, "a", "question_mark", "escape")
        return stand_in.text_of(app)

    assert "Enter keeps 1" in on_f3(seen, TREES, ("y", "enter"), horizon=File())


def test_a_proposal_shows_the_map_before_its_keys_count():
    async def seen(app, pilot):
        waiting = []
        app.maps.beside = waiting.append
        await press(app, pilot, "y", "enter", "v")
        before = app.page.shows_map
        for work in waiting:
            work()
        await press(app, pilot)
        await settle(app, pilot)
        return before, app.page.shows_map, app.page.query_one(MapPane).has_focus, stand_in.text_of(app)

    before, shown, focus, said = on_f3(seen, TREES, horizon=File())
    assert (before, shown, focus) == (False, True, True)
    assert "a accepts" in said


@pytest.mark.parametrize(
    ("name", "asked", "words"),
    [
        ("held", Release, "Enter releases the dish first, and keeps nothing yet"),
        ("fault", AcknowledgeFault, "Enter acknowledges the fault first, and keeps nothing yet"),
    ],
)
def test_enter_releases_what_is_held_before_it_keeps_a_proposal(name, asked, words):
    file = File(HorizonMask())

    async def seen(app, pilot):
        stand_in.change_to(app, name)
        app.session.clock.advance(5.0)
        said = await press(app, pilot)
        await press(app, pilot, "enter")
        return said, app.station.asked_for(asked), app.page.query_one(MapPane).offer

    said, released, offer = on_f3(seen, TREES, ("y", "enter", "A"), horizon=file)
    assert words in said
    assert "Enter keeps" not in said
    assert len(released) == 1
    assert offer is not None
    assert not file.mask


def test_what_is_kept_goes_into_the_horizon_of_that_moment_and_z_takes_it_back():
    file = File(HorizonMask([(20.0, 5.0), (300.0, 5.0)]))

    async def seen(app, pilot):
        file.mask = HorizonMask([(20.0, 9.0), (300.0, 9.0)])  # another program has written it meanwhile
        await press(app, pilot, "a", "enter")
        kept = file.mask
        app.horizon.undo()
        return kept, file.mask

    kept, undone = on_f3(seen, TREES, ("y", "enter"), horizon=file)
    assert (20.0, 9.0) in kept.points
    assert len(kept.points) > 2
    assert undone == HorizonMask([(20.0, 9.0), (300.0, 9.0)])


def test_a_map_of_another_place_proposes_no_horizon_and_draws_none():
    far = replace(TREES, about={**TREES.about, "latitude_deg": HERE.latitude_deg + 0.01})
    file = File(HorizonMask([(20.0, 25.0), (300.0, 25.0)]))

    async def seen(app, pilot):
        pane = app.page.query_one(MapPane)
        return pane.offer, await press(app, pilot), len(pane._picture._marks.signs)

    offer, said, marks = on_f3(seen, far, ("y", "enter"), horizon=file)
    _, _, flat = on_f3(seen, far, horizon=File(HorizonMask()))
    assert marks == flat
    assert offer is None
    assert "This map was made at another place." in said

    async def moved(app, pilot):
        app.move_to(replace(HERE, latitude_deg=HERE.latitude_deg + 0.01))
        said = await press(app, pilot, "A", "enter")
        return said, file.mask

    said, mask = on_f3(moved, TREES, ("y", "enter"), horizon=file)
    assert "This map was made at another place." in said
    assert mask == HorizonMask([(20.0, 25.0), (300.0, 25.0)])


def test_a_lesson_that_fails_in_an_unexpected_way_says_so_and_another_can_begin():
    class Broken:
        def inputs(self, *_args):
            raise ZeroDivisionError("no beam")

    async def seen(app, pilot):
        app.settings = replace(app.settings, lessons=Broken())
        failed = await press(app, pilot, "y", "enter")
        return failed, await press(app, pilot, "y")

    failed, again = on_f3(seen, TREES, horizon=File())
    assert "It failed: ZeroDivisionError, no beam" in failed
    assert "What this map teaches" in again


def test_a_result_waits_while_another_page_is_seen_and_its_question_takes_no_key_meant_for_the_page():
    waiting = []

    async def seen(app, pilot):
        app.maps.beside = waiting.append
        await press(app, pilot, "y", "down", "enter", "f2")
        for work in waiting:
            work()
        told = await press(app, pilot)
        away = isinstance(app.screen, QuestionScreen)
        await press(app, pilot, "f3", "y")
        came = isinstance(app.screen, QuestionScreen)
        await press(app, pilot, "y")
        stays = isinstance(app.screen, QuestionScreen)
        app.session.clock.advance(TAKEN_IN_S)
        await press(app, pilot, "y")
        return told, away, came, stays, isinstance(app.screen, QuestionScreen)

    told, *open_ = on_f3(seen, simulated_arc(7.0, 1.2, -1.6))
    assert "What the map teaches is ready. y on F3 shows it." in told
    assert open_ == [False, True, True, False]


def test_points_of_a_map_over_north_are_joined_as_they_stand_side_by_side():
    edge = partial(HorizonEdge, sigma_deg=0.5, is_clear=False)
    points = (edge(5.0, 10.0), edge(10.0, 50.0), edge(350.0, 50.0), edge(355.0, 10.0))
    chart = MapChart.within(MapPlan(300.0, 420.0, 0.0, 60.0, 1.0), 121, 34, 2.0)
    overlay = MapOverlay(chart.width, chart.height)
    draw_offer(overlay, chart, MapOffer("a", points))
    x, y = (int(each) for each in chart.spot(0.0, 50.0))
    assert not [spot for spot in overlay.signs if spot[0] in range(x - 2, x + 3) and spot[1] in range(y - 3, y + 4)]
    low = int(chart.spot(0.0, 10.0)[1])
    assert [spot for spot in overlay.signs if spot[0] in range(x - 2, x + 3) and spot[1] in range(low - 1, low + 2)]
