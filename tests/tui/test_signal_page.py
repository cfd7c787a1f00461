"""F3: the numbers that count with both hands on the dish, in the demo and beside a dish that has no tuner."""

from __future__ import annotations

import asyncio
import itertools

import pytest
import stage
import stand_in
from birdcage.signal.peak_hold import HeardPeak, LevelNow, Trend
from birdcage.station.requests import Goto, Jog, Watch
from birdcage_tui.control.jog import JogPane
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.signal.head import SignalHead
from birdcage_tui.signal.level import LevelPane
from birdcage_tui.signal.receiver import ReceiverPane
from birdcage_tui.signal.to_peak import ToPeakPane
from test_demo import stage_of_the_pictures

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]
PANES = (SignalHead, LevelPane, ToPeakPane, JogPane, SignalPane, ReceiverPane)


def level(app, *, share=0.98, trend=Trend.SAME, az_deg=190.0, el_deg=42.0, late_s=0.1):
    """Have the app show this level."""
    now = app.session.clock.monotonic()
    peak = HeardPeak(445.0, now - 12.0, az_deg, el_deg)
    told = LevelNow(443.0, now - late_s, 8.2, 0.65, 401.0, peak, share, trend)
    app.signals.book._holds[app.signals.book.heard.id] = type("Hold", (), {"now": lambda _self: told})()


def shown(size=(120, 36), name="idle", **what):
    async def look(app, pilot):
        level(app, **what)
        app.paint()
        await pilot.pause()
        return stage.stand_in.text_of(app)

    return stage.run(look, name, size, key="f3")


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "slewing", "lost", "travler-slew"])
def test_all_of_it_can_be_seen_and_reached(size, name):
    async def regions(app, _pilot):
        page = app.query_one("#page-signal")
        return {kind.__name__: page.query_one(kind).region for kind in PANES}, app.screen.region

    found, screen = stage.run(regions, name, size, key="f3")
    for what, region in found.items():
        assert region.area > 0, what
        assert screen.contains_region(region), (what, region)
    for (what, region), (other, second) in itertools.combinations(found.items(), 2):
        assert not region.overlaps(second), (what, other)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_part_of_the_peak_age_and_way_stand_there_at_every_size(size):
    text = shown(size, trend=Trend.HOTTER)
    for words in ("% of the peak", "▲ hotter", "443 counts", "floor 401", "0.1s old", "azimuth", "elevation",
                  "445 counts at 190.0° / 42.0°", "8.2 readings a second"):  # fmt: skip
        assert words in text, words


def test_a_peak_that_is_only_noise_is_not_claimed():
    text = shown(share=None)
    assert "% of the peak" not in text
    assert "no peak yet" in text


def test_a_reading_that_is_late_says_how_old_it_is_and_a_peak_without_direction_shows_no_degrees():
    assert "30s old" in shown(late_s=30.0)
    assert " / " not in shown(az_deg=None, el_deg=None).split("To the peak")[1].split("Signal")[0]


def test_arrows_step_the_dish_here_and_p_only_offers_the_way_to_the_peak():
    async def body(app, pilot):
        level(app)
        await pilot.press("right", "p")
        await pilot.pause()
        jogs, gotos = app.station.asked_for(Jog), app.station.asked_for(Goto)
        await pilot.press("enter")
        await pilot.pause()
        return jogs, gotos, app.station.asked_for(Goto)

    jogs, before, after = stage.run(body, "idle", key="f3")
    assert [jog.d_az_deg for jog in jogs] == [1.0]
    assert before == []
    assert [(goto.az_deg, goto.el_deg) for goto in after] == [(190.0, 42.0)]


def test_without_a_peak_p_says_so():
    async def body(app, pilot):
        await pilot.press("p")
        await pilot.pause()
        return app.station.asked_for(Goto), stand_in.text_of(app)

    gotos, text = stage.run(body, "idle", key="f3")
    assert gotos == []
    assert "No peak with a direction was heard yet." in text


def test_the_signal_is_read_steadily_here_and_in_bursts_on_the_dashboard():
    async def body(app, pilot):
        await pilot.press("f1")
        await pilot.pause()
        return [watch.steady for watch in app.station.asked_for(Watch) if "rssi" in watch.features]

    assert stage.run(body, "idle", key="f3") == [False, True, False]


def test_a_dish_without_a_tuner_says_what_to_do():
    async def body(app, pilot):
        await pilot.press("f3")
        await pilot.pause()
        return stand_in.text_of(app)

    text = " ".join(stage.run(body, "travler-slew", (160, 48)).split())
    assert "has no tuner to read" in text
    assert "no receiver of its own" in text


def test_in_the_demo_a_step_away_is_colder_and_the_way_back_is_found():
    """The real page, the real station, the simulated dish, which listens to its satellites."""
    pictures = stage_of_the_pictures()

    async def play():
        async with pictures.demo((120, 36)) as on:
            await on.wait(9)
            await on.press("f3", "g")
            await on.type("119W")
            await on.press("enter")
            await on.wait(10)
            await on.press("x")
            for key in ("left",) * 6:
                await on.press(key)
                await on.wait(3)
            away = on.text(), on.app.view().level
            await on.press("p", "enter")
            await on.wait(6)
            return away, (on.text(), on.app.view().level)

    (away, far), (back, near) = asyncio.run(play())
    assert "▼ colder" in away
    assert far.share < 0.2
    assert "▲ hotter" in back
    assert near.share > 0.95
    assert near.rate_hz > 4.0


@pytest.mark.parametrize(("size", "said"), [((40, 12), "98 % ▲ hotter"), ((60, 30), "98 % of peak  ▲ hotter")], ids=str)
def test_the_pocket_view_says_the_three_numbers_too(size, said):
    async def look(app, pilot):
        level(app, trend=Trend.HOTTER, az_deg=189.46)
        app.paint()
        await pilot.pause()
        level(app, late_s=30.0)
        steady = [watch.steady for watch in app.station.asked_for(Watch) if "rssi" in watch.features]
        before = stand_in.text_of(app)
        app.paint()
        await pilot.pause()
        return before, stand_in.text_of(app), steady

    fresh, late, steady = stage.run(look, "idle", size)
    assert f"443  {said}  ▶0.3° ▼0.9°" in fresh
    assert "30s old" in late
    assert steady[-1] is True
