"""A motor along an arc in the app: one axis, modelled, and what it lacks said where it is missed."""

from __future__ import annotations

import asyncio
import re

import pytest
import stand_in
from birdcage.base.errors import MotionRefused
from birdcage.rotator.mapping import Site
from birdcage.station.events import MoveEnded
from birdcage.station.requests import Goto, Home
from birdcage.testing import MachineBench, Stage
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.allowed import can_home
from birdcage_tui.shown.state_words import ended_text
from installed_toys import installed

SITE = Site(48.0, 11.0)


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    with installed(tmp_path_factory.mktemp("toys")):
        from birdcage_toys import swing_twin

        yield swing_twin


def shown(twins, test, *requests, site=SITE, size=(120, 36)):
    """Return what `test(app, pilot, stage)` returns once these requests are done."""

    async def body():
        with Stage(MachineBench("swing", twins.SwingTwin, (), settings={"site": site})) as stage:
            stage.session.start = lambda: None  # stepped here
            app = BirdcageApp(stage.session, AppOptions())
            async with app.run_test(size=size) as pilot:
                stage.step(3.0)
                for request in requests:
                    stage.do(request)
                    await settle(app, pilot)
                stage.step(1.0)
                await settle(app, pilot)
                return await test(app, pilot, stage)

    return asyncio.run(body())


async def settle(app, pilot):
    app._tick()
    await pilot.pause()
    app.paint()
    await pilot.pause()


async def dashboard_and_control(app, pilot, stage):
    first = stand_in.text_of(app)
    await pilot.press("f2")
    await settle(app, pilot)
    return first, stand_in.text_of(app)


@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
def test_where_it_went_and_what_that_misses(twins, size):
    dashboard, control = shown(twins, dashboard_and_control, Goto(200.0, 33.4, "you"), size=size)
    for text in (dashboard, control):
        assert "AZ~199.87°" in text
        assert "EL~32.94°" in text
    assert "misses by 0.48°" in dashboard
    assert "never: it has no homing" in dashboard or size[0] < 120
    assert "10.8° to 34.9°" in dashboard or size[0] < 120


def test_its_arrival_is_told_with_the_miss(twins):
    async def told(_app, _pilot, stage):
        return [ended_text(event) for event in stage.events if isinstance(event, MoveEnded)]

    told_on_arrival = shown(twins, told, Goto(200.0, 33.4, "you"))
    assert told_on_arrival == ["It should have arrived at 199.87°/32.94°, 0.48° off. At rest the dish does not tell."]


def test_on_its_way_an_arrow_adds_a_step_along_the_arc(twins):
    async def press(app, pilot, stage):
        await pilot.press("right")
        await settle(app, pilot)
        stage.step(0.5)
        stage.until(lambda: stage.state.activity.value == "idle", 60.0, "the step is gone")
        await settle(app, pilot)
        return stage.state.position, stand_in.text_of(app)

    here, text = shown(twins, press, Goto(180.0, 34.87, "you"))
    assert here.az_deg == pytest.approx(181.0, abs=0.05)
    assert f"AZ~{here.az_deg:.2f}°" in text


@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
def test_without_a_place_it_has_no_direction_and_says_what_it_lacks(twins, size):
    async def ask(app, pilot, stage):
        dashboard, control = await dashboard_and_control(app, pilot, stage)
        await pilot.press("right")
        await settle(app, pilot)
        return dashboard, control, stage.twin.taken()

    dashboard, control, taken = shown(twins, ask, site=None, size=size)
    for text in (dashboard, control):
        words = " ".join(re.sub(r"[│╭╮╰╯─]", " ", text).split())
        assert "NO DIRECTION The Swing has no azimuth and elevation. Its arc depends on where it stands:" in words
        assert "set your location (`birdcage place add`), then connect again." in words
        assert re.search(r"AZ +---\.--°", text)
        assert "goes to a direction" not in text
    assert "0.0° to 90.0°" not in dashboard
    assert "NO DIRECTION" in control.split("Azimuth", 1)[1] or size[0] < 120
    assert not taken


def test_the_go_to_line_lets_the_station_say_what_a_direction_misses(twins):
    async def ask(app, pilot, stage):
        await pilot.press("g")
        await pilot.press(*"180", "space", *"60", "enter")
        stage.step(1.0)
        await settle(app, pilot)
        return stand_in.text_of(app), stage.twin.taken()

    text, taken = shown(twins, ask)
    assert "misses this direction by 25.13°" in " ".join(text.split())
    assert not taken


def test_what_it_has_not_is_said_by_the_key_that_would_do_it(twins):
    async def ask(app, _pilot, stage):
        return can_home(app.view()), stage.refused(Home("you"), MotionRefused)

    reason, refusal = shown(twins, ask)
    assert reason == "The Swing has no homing."
    assert str(refusal) == "The Swing has no homing. Nothing was sent."
