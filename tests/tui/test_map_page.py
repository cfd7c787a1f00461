"""The map of the sky on F3: what a person reads and does, at three sizes."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta

import map_stand_in
import pytest
import stand_in
from birdcage.skymap.plan import MapFrame, MapPlan
from birdcage.station.requests import Goto, Jog, Release
from birdcage.station.task_state import TaskPhase
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.panes.signal import SignalPane
from birdcage_tui.signal.level import LevelPane
from birdcage_tui.signal.map_pane import MapPane
from birdcage_tui.signal.receiver import ReceiverPane
from map_stand_in import on_map, settle

SIZES = [(80, 24), (120, 36), (160, 48)]
AROUND = MapPlan(-5.0, 5.0, -5.0, 5.0, 0.5, frame=MapFrame.TARGET)


async def read(app, _pilot):
    return stand_in.text_of(app)


def heard(count=None, plan=map_stand_in.PLAN, **other):
    return map_stand_in.made(plan, count, **other)


def task(sky, **more):
    return map_stand_in.task(sky, **more)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_running_map_takes_the_page_and_says_how_far_it_is(size):
    sky = heard(1500)

    async def seen(app, _pilot):
        page = app.page
        regions = [page.query_one(kind).region for kind in (MapPane, LevelPane, SignalPane, ReceiverPane)]
        return stand_in.text_of(app), regions, app.screen.region

    said, (shown, *others), screen = on_map(seen, sky, task(sky, left_s=4320.0), size=size)
    assert "running, 1500 of 3993, 1 h 12 min left, ends 13:12Z" in said
    assert "Map  DEMO, az 130:250 el 18:50, every 1°" in said
    for words in ("150°", "180°", "240°", "counts", "101W", "119W", "◆", "30°", "loudest az"):
        assert words in said, words
    assert screen.contains_region(shown)
    assert shown.height >= size[1] - 6
    assert [each.area for each in others] == [0, 0, 0]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_z_brings_the_level_back_above_it(size):
    async def pressed(app, pilot):
        await pilot.press("z")
        await settle(app, pilot)
        level, shown = app.page.query_one(LevelPane).region, app.page.query_one(MapPane).region
        text = stand_in.text_of(app)
        await pilot.press("z")
        await settle(app, pilot)
        return level, shown, app.screen.region, text, app.page.query_one(LevelPane).region

    level, shown, screen, text, after = on_map(pressed, heard(1500), size=size)
    assert level.area > 0
    assert level.bottom <= shown.y
    assert screen.contains_region(shown)
    assert "1500 of 3993" in text
    assert after.area == 0


@pytest.mark.parametrize(
    ("phase", "more", "state", "words"),
    [
        (TaskPhase.RUNNING, {}, {}, "running, 40 of 3993"),
        (TaskPhase.WAITING, {"next_at": "23:00"}, {}, "waiting until 23:00Z, 40 of 3993 heard"),
        (TaskPhase.COUNTDOWN, {"next_at": "4 s"}, {}, "MOVES in 4 s, Space cancels. 40 of 3993 heard"),
        (TaskPhase.YIELDED, {"why": "Gpredict has control."}, {}, "paused: Gpredict has control. 40 of 3993 heard"),
        (TaskPhase.YIELDED, {}, {"not_now": "Guests in the garden."}, "not now: Guests in the garden. 40 of 3993"),
        (TaskPhase.INTERRUPTED, {"why": "The link was lost."}, {}, "interrupted at 40 of 3993: The link was lost"),
    ],
)  # fmt: skip
def test_what_a_map_does_is_told_in_every_state(phase, more, state, words):
    sky, utc = heard(40), stand_in.VirtualClock().utc()
    when = {"23:00": utc.replace(hour=23, minute=0), "4 s": utc + timedelta(seconds=4)}
    more = {name: when.get(value, value) for name, value in more.items()}
    assert words in on_map(read, sky, task(sky, phase=phase, **more), state=state)


def test_a_map_that_nothing_makes_says_how_it_goes_on():
    assert "unfinished, 40 of 3993. u resumes it" in on_map(read, heard(40))
    whole = heard()
    assert "finished 2026-03-20 07:39Z, all 3993 heard" in on_map(read, replace(whole, ended=whole.samples[-1].utc))


def held(app):
    state = stand_in.held(app.session.clock).held
    return replace(state, utc=state.utc - timedelta(seconds=8))


def test_a_held_dish_is_told_and_enter_releases_it_before_anything_else():
    async def pressed(app, pilot):
        app.station.state = replace(app.station.state, held=held(app))
        await settle(app, pilot)
        said = stand_in.text_of(app)
        await pilot.press("u")
        await settle(app, pilot)
        refused = stand_in.text_of(app)
        await pilot.press("i", "enter")
        await settle(app, pilot)
        return said, refused, app.station.asked_for(Release), app.query_one(GotoLine).display

    said, refused, released, line = on_map(pressed, heard(40))
    assert "unfinished, 40 of 3993. Dish HELD: Enter releases it, then u resumes the map" in said
    assert "STOP is latched. Enter releases it." in refused
    assert len(released) == 1
    assert not line


def test_the_cursor_reads_out_and_its_arrows_do_not_move_the_dish():
    sky = heard()

    async def pressed(app, pilot):
        await pilot.press("enter", "left", "up")
        await settle(app, pilot)
        return stand_in.text_of(app), app.station.asked_for(Jog), app.query_one(MapPane).cursor(app.maps.book.shown)

    said, jogs, at = on_map(pressed, sky)
    loudest = max(sky.samples, key=lambda each: each.value)
    sample = sky.samples[sky.plan.sequence.index(loudest.cell + sky.plan.columns - 1)]
    assert at == sample.cell
    assert jogs == []
    for words in (f"az {sample.az_deg:.2f}° el {sample.el_deg:.2f}°", f"{sample.value:.0f} ±0.7 counts", "n 10",
                  f"{sample.utc:%H:%M:%S}Z", "° away"):  # fmt: skip
        assert words in said, words


def test_snr_and_lock_are_read_out_where_they_are_known_and_nothing_stands_where_nothing_was_heard():
    sky = heard(40)
    samples = tuple(replace(each, snr_db=9.1, lock=True, scatter=None) for each in sky.samples)

    async def pressed(app, pilot):
        await pilot.press("i")
        await settle(app, pilot)
        said = stand_in.text_of(app)
        await pilot.press("right")
        await settle(app, pilot)
        return said, stand_in.text_of(app)

    said, beside = on_map(pressed, replace(sky, samples=samples), size=(160, 48))
    assert "SNR 9.1 dB  lock" in said
    assert "±" not in said.split("az ")[-1]
    assert "not heard" in beside


def test_esc_and_i_leave_the_map_and_the_arrows_jog_again():
    async def pressed(app, pilot):
        pane, held = app.query_one(MapPane), []
        for key in ("i", "i", "i", "escape"):
            await pilot.press(key)
            await settle(app, pilot)
            held.append(pane.has_focus)
        await pilot.press("right")
        await settle(app, pilot)
        return held, app.station.asked_for(Jog)

    focus, jogs = on_map(pressed, heard(40))
    assert focus == [True, False, True, False]
    assert len(jogs) == 1


def test_a_click_puts_the_cursor_there_and_g_offers_to_point():
    sky = heard()

    async def clicked(app, pilot):
        pane = app.query_one(MapPane)
        layout = pane._layout
        x, y = layout.chart.spot_of(sky.plan.columns * 20 + 50)
        await pilot.click(pane, offset=(1 + layout.left + int(x), 1 + layout.top + int(y)))
        await settle(app, pilot)
        at = pane.cursor(app.maps.book.shown)
        await pilot.press("g")
        await settle(app, pilot)
        text, before = stand_in.text_of(app), app.station.asked_for(Goto)
        await pilot.press("enter")
        await settle(app, pilot)
        return at, pane.direction(app.maps.book.shown), text, before, app.station.asked_for(Goto)

    at, (az_deg, el_deg), text, before, gone = on_map(clicked, sky)
    assert divmod(at, sky.plan.columns)[1] in (49, 50)
    assert f"{az_deg:.2f} {el_deg:.2f}" in text
    assert before == []
    assert [(each.az_deg, each.el_deg) for each in gone] == [(az_deg, el_deg)]


def test_a_map_around_a_target_has_offsets_and_no_direction_to_point_at():
    sky = map_stand_in.made_map(AROUND, lambda x, y: 100.0 - x * x - y * y, about={"target": "Sun"})

    async def pressed(app, pilot):
        said = stand_in.text_of(app)
        await pilot.press("i", "right", "g")
        await settle(app, pilot)
        return said, stand_in.text_of(app), app.query_one(GotoLine).display

    said, after, line = on_map(pressed, sky)
    assert "around Sun, every 0.5°" in said
    for words in ("-4°", "+4°", "0°"):
        assert words in said
    assert "101W" not in said
    assert said.count("◆") == 2, "the target, and the legend"
    assert "+0.50° right, +0.00° up" in after
    assert "it moves with the target" in after
    assert not line


def test_directions_out_of_reach_are_told_when_it_is_finished():
    sky = heard(3990)
    said = on_map(read, replace(sky, ended=sky.samples[-1].utc))
    assert "finished 2026-03-20 07:39Z, 3990 heard, 3 out of reach" in said
