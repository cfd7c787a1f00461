"""The Craft tab: what a person needs is seen and reached at every size, and its keys ask the desk for what they say."""

from __future__ import annotations

import asyncio
from dataclasses import replace

import pytest
import stand_in
import track_stand_in
from birdcage.station.events import PursuitChanged
from birdcage.station.pursuit import Phase
from birdcage.station.requests import AcquireLease, Jog, Release, ReleaseLease
from birdcage_tui.control.tabs import TABS, TabRow
from birdcage_tui.track.found import FoundList
from birdcage_tui.track.head import TrackHead
from birdcage_tui.track.now import TrackNow
from birdcage_tui.track.passes import TrackPasses
from birdcage_tui.track.plot import TrackSky
from birdcage_tui.track.radio import RadioPane
from birdcage_tui.track.schedule import SchedulePane
from birdcage_tui.track.strips import TrackStrips
from textual.widgets import Input

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


def run(test, name="craft-following", size=(80, 24), keys=("f2", "c"), **options):
    """Return what `test(app, pilot, desk)` returns, on the Craft tab in a scene."""

    async def body():
        app = track_stand_in.app_in(name, **options)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            for key in keys:
                await pilot.press(key)
                await pilot.pause()
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return await test(app, pilot, app.track.source)

    return asyncio.run(body())


async def read(app, _pilot, _desk):
    return stand_in.text_of(app)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", track_stand_in.SCENES)
def test_every_part_is_inside_the_screen_and_over_no_other(name, size):
    async def regions(app, pilot, _desk):
        kinds = [TabRow, TrackHead, TrackSky, FoundList if name == "craft-idle" else TrackStrips]
        if name != "craft-idle":
            kinds.append(TrackNow)
        if size[0] >= 100:
            kinds += [TrackPasses, SchedulePane]
        if size[0] >= 150:
            kinds.append(RadioPane)
        return {kind.__name__: (app.query_one(kind).region, app.query_one(kind).content_size) for kind in kinds}, (
            app.screen.region
        )

    found, screen = run(regions, name, size)
    for what, (region, inside) in found.items():
        assert inside.area > 0, what
        assert screen.contains_region(region), f"{what} {region} is not inside {screen}"
    panes = list(found.items())
    for index, (what, (region, _)) in enumerate(panes):
        for other, (second, _) in panes[index + 1 :]:
            assert not region.overlaps(second), f"{what} lies over {other}"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_first_questions_are_answered_at_every_size(size):
    text = run(read, size=size)
    for words in ("METEOR-M2 4", "AOS 341° 11:57:06", "TCA 71° 12:04:06", "LOS 158° 12:11:06", "11:58:51-12:02:35",
                  "6 h old", "FOLLOWING METEOR-M2 4", "0.0", "65° ceiling in 02:35", "● f Follow", "○ w Watch",
                  "x leave", "offset +0.0 s", "▼ Craft", "18° floor", "dB", "■ STOP"):  # fmt: skip
        assert words in text, words


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_tabs_stand_in_one_row_and_each_is_a_target_for_the_mouse(size):
    async def press(app, pilot, _desk):
        row, seen = app.query_one(TabRow), []
        assert row.region.height == 1
        for name in (*TABS, "craft"):
            region, _ = next(pair for pair in row.hot if pair[1] == f"tab-{name}")
            await pilot.click(row, offset=(region.x + 1, 0))
            await pilot.pause()
            await pilot.pause()
            seen.append(app.page.tab)
            assert "▼" in stand_in.text_of(app).splitlines()[2]
        return seen

    assert run(press, size=size) == [*TABS, "craft"]


@pytest.mark.parametrize(
    ("key", "asked"),
    [
        ("w", ("watch",)), ("a", ("aim_once",)), ("f", ("follow",)), ("x", ("leave",)),
        ("right_square_bracket", ("set_time_offset", 0.1)), ("left_square_bracket", ("set_time_offset", -0.1)),
        ("right_curly_bracket", ("set_time_offset", 1.0)), ("z", ("set_time_offset", 0.0)),
        ("A", ("set_autotrack", True)),
    ],
)  # fmt: skip
def test_a_key_asks_the_desk_for_what_it_says(key, asked):
    async def press(app, pilot, desk):
        await pilot.press(key)
        await pilot.pause()
        return desk.asked, [
            request for request in app.station.asked if type(request).__name__ not in ("Watch", "Unwatch")
        ]

    said, station = run(press)
    assert said == [asked]
    assert station == []


def test_the_arrows_never_step_the_dish_here():
    async def press(app, pilot, _desk):
        await pilot.press("left", "right", "up", "down", "h", "l")
        await pilot.pause()
        return [type(request).__name__ for request in app.station.asked]

    assert "Jog" not in run(press)
    assert "Jog" in run(press, "craft-idle", keys=("f2",))


def test_a_pass_is_chosen_with_arrow_and_enter():
    async def press(_app, pilot, desk):
        await pilot.press("down", "down", "enter")
        await pilot.pause()
        return desk.asked

    of = track_stand_in.desk(track_stand_in.plan(minutes=-2.9)).passes[2].passing.aos
    for size in SIZES[:2]:
        assert run(press, size=size) == [("choose_pass", of)]


def test_before_a_target_is_chosen_the_favourites_and_what_is_up_stand_there():
    text = run(read, "craft-idle")
    for words in ("METEOR-M2 4", "ISS (ZARYA)", "Moon", "up now, 72°", "No target is chosen"):
        assert words in text

    async def take(_app, pilot, desk):
        await pilot.press("down", "enter")
        await pilot.pause()
        return desk.asked

    assert run(take, "craft-idle") == [("choose", "25544")]


def test_typing_searches_and_enter_takes_the_row_under_the_cursor():
    async def find(app, pilot, desk):
        await pilot.press("slash")
        await pilot.pause()
        assert app.query_one("#craft-search", Input).has_focus
        await pilot.press(*"mo")
        await pilot.pause()
        text = stand_in.text_of(app)
        await pilot.press("enter")
        await pilot.pause()
        return text, desk.asked, app.focused

    text, asked, focused = run(find)
    assert "Moon" in text
    assert "up now" not in text
    assert asked[-2:] == [("search", "mo"), ("choose", "moon")]
    assert focused is None


def test_esc_closes_the_search_and_asks_for_nothing():
    async def leave(app, pilot, desk):
        await pilot.press("slash")
        await pilot.pause()
        await pilot.press("escape")
        await pilot.pause()
        return app.query_one("#craft-search", Input).display, desk.asked, app.station.stops

    shown, asked, stops = run(leave, "craft-chosen")
    assert not shown
    assert asked == [("search", "")]
    assert stops == []


def test_enter_releases_what_is_held_before_it_chooses():
    async def press(app, pilot, desk):
        await pilot.press("enter")
        await pilot.pause()
        return app.station.asked_for(Release), desk.asked

    released, asked = run(press, "craft-held")
    assert released
    assert asked == []


@pytest.mark.parametrize("page", ["f1", "f2", "f7"])
def test_a_countdown_stands_in_the_row_under_the_status_on_every_page(page):
    row = run(read, "craft-countdown", keys=(page,)).splitlines()[1]
    assert "▲ MOVES to 17°/18° for METOP-C in 4 s" in row
    assert "Space stops it" in row


def test_a_countdown_rings_once_and_stop_ends_it():
    async def ring(app, pilot, _desk):
        rung = []
        app.track._bell = lambda: rung.append(1)
        pursuit = app.station.state.pursuit
        for phase in (Phase.WAITING, Phase.COUNTDOWN, Phase.COUNTDOWN):
            app.track.hear(PursuitChanged(0.0, app.session.clock.utc(), replace(pursuit, phase=phase)))
        await pilot.press("space")
        return rung, app.station.stops

    rung, stops = run(ring, "craft-countdown")
    assert rung == [1]
    assert stops == ["you"]


def test_esc_stops_while_something_is_pursued_though_nothing_moves():
    async def press(app, pilot, _desk):
        await pilot.press("escape")
        return app.station.stops

    assert run(press, "craft-waiting") == ["you"]


def test_why_it_waits_and_when_it_goes_on_are_told():
    text = run(read, "craft-waiting")
    assert "WAITING FOR METOP-C" in text
    assert "leave in 32:10" in text
    assert "Below the 18° floor" in text
    assert "rises in 31:00" in text


def test_an_interrupted_pursuit_is_told_in_the_row_under_the_status():
    assert "◌ PURSUIT INTERRUPTED  The link was lost" in run(read, "craft-interrupted", keys=("f1",)).splitlines()[1]


def test_the_keyhole_is_written_on_the_time_axis_before_it_comes():
    for size in SIZES:
        assert "keyhole" in run(read, "craft-keyhole", size=size)


def test_the_offset_says_what_it_means_in_degrees():
    assert "offset +0.3 s = 0." in run(read, "craft-waiting", size=(120, 36))


def test_what_was_left_in_mid_pass_is_offered_and_taken_up_or_forgotten():
    async def press(app, pilot, desk):
        text = stand_in.text_of(app)
        await pilot.press("u", "D")
        await pilot.pause()
        return text, desk.asked

    text, asked = run(press, "craft-over", size=(120, 36))
    assert "METEOR-M2 4 was left in mid-pass, in reach until 12:05:00" in text
    assert asked == [("take_up",), ("forget_unfinished",)]


def test_a_frequency_is_typed_in_megahertz():
    async def type_it(app, pilot, desk):
        await pilot.press("F")
        await pilot.pause()
        field = app.screen.query_one(Input)
        assert field.value == "137.9"
        field.value = "0.3"
        await pilot.press("enter")
        assert desk.asked == []
        field.value = "145.825"
        await pilot.press("enter")
        await pilot.pause()
        return desk.asked

    assert run(type_it) == [("set_frequency", 145.825e6)]


def test_the_dashboard_and_the_status_line_say_it_in_brief():
    text = run(read, keys=("f1",))
    assert "FOLLOW 0.0" in text.splitlines()[0]
    assert "tracker" in text.splitlines()[0]
    for words in ("FOLLOWING METEOR-M2 4", "error 0.0", "65° ceiling in 02:35", "LOS 12:11:06", "12:06"):
        assert words in text, words


def test_the_pocket_view_says_it_in_two_rows():
    rows = run(read, size=(40, 12), keys=()).splitlines()
    assert any("FOLLOW METEOR-M2 4" in row and "err 0.0" in row for row in rows)
    assert any("65° ceiling in 02:35   LOS 12:11:06" in row for row in rows)


def test_f_on_the_dashboard_goes_to_craft():
    async def page(app, pilot, _desk):
        await pilot.pause()
        return app.page.tab, app.page.id

    assert run(page, keys=("f",)) == ("craft", "page-control")


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_passes_autotrack_and_radio_can_be_seen_at_every_size(size):
    async def look(app, pilot, _desk):
        seen = stand_in.text_of(app)
        for _ in range(3):
            await pilot.press("v")
            await pilot.pause()
            await pilot.pause()
            seen += stand_in.text_of(app)
        return seen

    text = run(look, size=size)
    for words in ("Passes of the target", "10 h 10", "dry run: 6 of 7", "overlaps"):
        assert words in text, words
    if size[0] != 120:
        assert "137.898157 MHz" in text


def test_the_network_tab_says_what_there_is_and_what_there_is_not():
    for size in SIZES:
        text = run(read, size=size, keys=("f2", "N"))
        for words in ("tracker", "birdcage stop", "birdcage track", "rotctld", "version has none"):
            assert words in text


def test_the_presets_fill_the_width_and_esc_goes_back_to_the_rose(kept):
    async def back(app, pilot, _desk):
        text, focused = stand_in.text_of(app), app.focused.id
        await pilot.press("escape")
        await pilot.pause()
        return text, focused, app.focused.id, app.page.tab

    text, focused, after, tab = run(back, "craft-idle", keys=("f2", "P"), presets_file=kept)
    assert "Direction 11" in text
    assert "Command" not in text
    assert (focused, after, tab) == ("presets", "rose", "manual")


def test_a_pursuit_that_is_over_keeps_its_curve_and_tells_its_figures():
    text = run(read, "craft-over", size=(160, 48))
    assert "Followed: rms 0.0" in text
    assert "It has set." in text


def test_the_looks_of_another_pursuit_do_not_stay():
    async def hear(app, _pilot, _desk):
        before = len(app.track.looks)
        app.track.hear(PursuitChanged(0.0, app.session.clock.utc(), replace(app.station.state.pursuit, number=9)))
        return before, len(app.track.looks)

    before, after = run(hear)
    assert before > 30
    assert after == 0


def test_what_is_not_known_is_a_dash():
    async def unknown(app, pilot, _desk):
        state = app.station.state
        app.station.state = replace(state, beam_deg=None, pursuit=replace(
            state.pursuit, sample=replace(state.pursuit.sample, loss_db=None)))  # fmt: skip
        app.track.looks[-1] = replace(app.track.looks[-1], loss_db=None)
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    assert "--.-- dB" in run(unknown)


def test_help_says_what_the_tab_is_for():
    async def ask(app, pilot, _desk):
        await pilot.press("question_mark")
        await pilot.pause()
        return str(app.screen.query_one("OptionList").get_option_at_index(0).prompt)

    assert "Craft finds a target and follows it." in run(ask)
    assert "Who has control" in run(ask, keys=("f2", "N"))


def test_following_draws_when_the_dish_was_looked_at_and_not_between():
    async def pace(app, _pilot, _desk):
        return app._frames._active.is_set(), app.view().moving

    assert run(pace) == (False, True)


def test_a_key_that_moves_by_hand_takes_your_own_pursuit_over():
    async def jog(app, pilot, _desk):
        await pilot.press("right")
        return [request for request in app.station.asked if isinstance(request, AcquireLease | Jog)]

    assert run(jog, keys=("f1",)) == [AcquireLease("you", take_over=True), Jog(1.0, 0.0, "you")]


def test_it_takes_nothing_from_anybody_else():
    async def jog(app, pilot, _desk):
        app.station.state = replace(app.station.state, holder="Gpredict")
        await pilot.press("right")
        return app.station.asked_for(AcquireLease)

    assert run(jog, keys=("f1",)) == []


def test_follow_gives_back_what_was_taken_by_hand():
    async def follow(app, pilot, desk):
        app.station.state = replace(
            app.station.state,
            holder="you",
            pursuit=replace(app.station.state.pursuit, phase=Phase.YIELDED, why="You have control."),
        )
        app.paint()
        await pilot.pause()
        text = stand_in.text_of(app)
        await pilot.press("f")
        await pilot.pause()
        return text, app.station.asked_for(ReleaseLease), desk.asked

    text, released, asked = run(follow)
    assert "f follows it again, x leaves it." in text
    assert released == [ReleaseLease("you")]
    assert asked == [("follow",)]
