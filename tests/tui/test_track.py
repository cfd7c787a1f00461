"""The Craft tab: what a person needs is seen and reached at every size, and its keys ask the desk for what they say."""

from __future__ import annotations

import itertools
import re
from dataclasses import replace

import pytest
import stand_in
import track_stand_in
from birdcage.sky.reach_model import LossReason, Lost, PassReach
from birdcage.station.requests import Release
from birdcage_tui.control.tabbing import TABS
from birdcage_tui.track.found import FoundList
from birdcage_tui.track.head import TrackHead
from birdcage_tui.track.now import TrackNow
from birdcage_tui.track.offer import OfferLine
from birdcage_tui.track.passes import TrackPasses
from birdcage_tui.track.plot import TrackSky
from birdcage_tui.track.radio import RadioPane
from birdcage_tui.track.schedule import SchedulePane
from birdcage_tui.track.strips import TrackStrips
from birdcage_tui.widgets.tab_row import TabRow
from textual.widgets import Input
from track_stage import SIZES, read, run, run_each


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_every_part_is_inside_the_screen_and_over_no_other(size):
    async def regions(app, pilot, desk):
        kinds = [TabRow, TrackHead, TrackSky]
        kinds += [FoundList] if desk.now.choice is None else [TrackStrips, TrackNow]
        if size[0] >= 100:
            kinds += [TrackPasses, SchedulePane]
        if size[0] >= 150:
            kinds.append(RadioPane)
        return {kind.__name__: (app.query_one(kind).region, app.query_one(kind).content_size) for kind in kinds}, (
            app.screen.region
        )

    for name, (found, screen) in run_each(regions, size).items():
        assert ("FoundList" in found) is (name == "craft-idle")
        for what, (region, inside) in found.items():
            assert inside.area > 0, (name, what)
            assert screen.contains_region(region), f"{name}: {what} {region} is not inside {screen}"
        for (what, (region, _)), (other, (second, _)) in itertools.combinations(found.items(), 2):
            assert not region.overlaps(second), f"{name}: {what} lies over {other}"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_first_questions_are_answered_at_every_size(size):
    text = run(read, size=size)
    for words in ("METEOR-M2 4", "AOS 341° 11:57:06", "TCA 71° 12:04:06", "LOS 158° 12:11:06", "11:58:51-12:02:35",
                  "6 h old", "FOLLOWING METEOR-M2 4", "0.0", "In reach", "02:35, then",
                  "● f Follow", "○ w Watch", "x leave", "offset +0.0 s", "▼ Craft", "dB", "■ STOP",
                  "18° floor" if size[0] >= 100 else "65° ceiling"):  # fmt: skip
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
        ("w", ("watch",)), ("x", ("leave",)),
        ("right_square_bracket", ("set_time_offset", 0.1)), ("left_square_bracket", ("set_time_offset", -0.1)),
        ("right_curly_bracket", ("set_time_offset", 1.0)), ("z", ("set_time_offset", 0.0)),
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


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(
    ("key", "offered", "footer", "asked"),
    [
        ("f", "Enter follows ISS (ZARYA): the dish goes to ", "follow it", ("follow",)),
        ("a", "Enter points once at ISS (ZARYA): the dish goes to ", "point once", ("aim_once",)),
        ("A", "Enter starts autotrack: first METEOR-M2 4, ", "start autotrack", ("set_autotrack", True)),
    ],
)  # fmt: skip
def test_what_moves_the_dish_is_offered_first_and_enter_or_a_click_does_it(key, offered, footer, asked, size):
    async def press(app, pilot, desk):
        await pilot.press(key)
        await settled(app, pilot)
        before, text = list(desk.asked), stand_in.text_of(app)
        await pilot.press("enter")
        await settled(app, pilot)
        done, closed = list(desk.asked), stand_in.text_of(app)
        await pilot.press(key)
        await settled(app, pilot)
        await pilot.click(OfferLine, offset=(5, 0))
        await settled(app, pilot)
        return before, text, done, closed, desk.asked

    before, text, done, closed, twice = run(press, "craft-chosen", size=size)
    assert before == []
    assert f"▶ {offered}" in text
    assert footer in text.splitlines()[-1]
    assert done == [asked]
    assert offered not in closed
    assert twice == [asked, asked]


@pytest.mark.parametrize("way", ["escape", "w", "slash"])
def test_what_was_offered_is_gone_once_something_else_was_taken_up(way):
    async def leave(app, pilot, desk):
        await pilot.press("f", way)
        await settled(app, pilot)
        text = stand_in.text_of(app)
        return text, [each for each in desk.asked if each == ("follow",)], app.station.stops

    text, asked, stops = run(leave, "craft-chosen")
    assert "Enter follows" not in text
    assert asked == []
    assert stops == []


def test_autotrack_is_switched_off_at_once():
    async def off(_app, pilot, desk):
        desk.show(replace(desk.now, autotrack=True))
        await pilot.pause()
        await pilot.press("A")
        await pilot.pause()
        return desk.asked

    assert run(off) == [("set_autotrack", False)]


def test_the_arrows_never_step_the_dish_here():
    async def press(app, pilot, _desk):
        await pilot.press("left", "right", "up", "down", "h", "l")
        await pilot.pause()
        return [type(request).__name__ for request in app.station.asked]

    assert "Jog" not in run(press)
    assert "Jog" in run(press, "craft-idle", keys=("f2",))


async def settled(app, pilot):
    await pilot.pause()
    app.paint()
    await pilot.pause()


def test_a_pass_is_chosen_with_arrow_and_enter():
    async def press(_app, pilot, desk):
        await pilot.press("down", "down", "enter")
        await pilot.pause()
        return desk.asked

    of = track_stand_in.desk(track_stand_in.plan(minutes=-2.9)).passes[2].passing.aos
    for size in SIZES[:2]:
        assert run(press, size=size) == [("choose_pass", of)]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_what_is_sent_and_satdumps_name_for_it_stand_with_the_radio(size):
    text = run(read, size=size, keys=("f2", "c", "v", "v", "v"))
    for words in ("LRPT, RHCP, 72 kbaud", "meteor_m2-x_lrpt", "137.900000 MHz", "-38.2 dB"):
        assert words in text, words


def test_before_a_target_is_chosen_the_favourites_and_what_is_up_stand_there():
    text = run(read, "craft-idle")
    for words in ("METEOR-M2 4", "ISS (ZARYA)", "Moon", "up now, 72°", "No target selected"):
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


@pytest.mark.parametrize(("then", "chosen"), [((), [("choose", "moon")]), (("o",), []), (("escape",), [])])
def test_enter_before_the_answer_counts_once_it_comes_unless_something_else_is_typed(then, chosen, monkeypatch):
    async def hurry(app, pilot, desk):
        await pilot.press("slash")
        await pilot.pause()
        search, late = desk.search, []
        monkeypatch.setattr(desk, "search", late.append)
        await pilot.press(*"mo", "enter")
        await pilot.pause()
        early, text = list(desk.asked), stand_in.text_of(app)
        await pilot.press(*then)
        search("mo")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return early, text, [each for each in desk.asked if each[0] == "choose"]

    early, text, asked = run(hurry, "craft-idle")
    assert not [each for each in early if each[0] == "choose"]
    assert "Enter counts once it is found." in text
    assert asked == chosen


def test_esc_closes_the_search_and_asks_for_nothing():
    async def leave(app, pilot, desk):
        await pilot.press("slash")
        await pilot.pause()
        await pilot.press("escape")
        await pilot.pause()
        return bool(app.query_one("#craft-search", Input).size), desk.asked, app.station.stops

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
    assert "Enter releases the dish, then f and Enter follow it." in run(read, "craft-held", size=(120, 36))


@pytest.mark.parametrize("size", SIZES[:2], ids=str)
def test_without_a_place_it_says_what_to_do_first(size):
    async def lost(app, pilot, _desk):
        app.settings = replace(app.settings, place=None)
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = run(lost, "craft-idle", size=size)
    assert "No location set. L sets it." in text
    assert "omputing" not in text


@pytest.mark.parametrize(
    ("minutes", "says"),
    [(-4.0, "Behind the horizon mask: f and Enter follow it anyway."), (3.0, "Behind the horizon mask in")],
)
def test_what_a_mask_hides_all_the_way_can_be_followed_and_says_so(minutes, says):
    async def hidden(app, pilot, desk):
        plan = track_stand_in.plan(minutes=minutes)
        lost = tuple(Lost(one.start, one.end, LossReason.HORIZON) for one in plan.reach.intervals)
        desk.show(track_stand_in.desk(replace(plan, reach=PassReach((), lost, None))))
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = run(hidden, "craft-chosen", size=(160, 48))
    assert "always behind the horizon mask" in text
    assert says in text
    assert "Never in reach" not in text


def test_the_radio_pane_says_what_sdrpp_does_and_does_not():
    text = re.sub(r"[ │]+", " ", run(read, "craft-sdrpp", size=(160, 48)))
    for words in ("strength none (RPRT 1)", "recording requested", "SDR++ takes AOS with Recording",
                  "too: check that it records."):  # fmt: skip
        assert words in text, words


@pytest.mark.parametrize(
    ("size", "words"),
    [
        ((80, 24), ("Skew -14.0° geometry +7.0° slot = -7.0°",)),
        ((120, 36), ("Skew 14.0° counterclockwise by geometry",
                     "Tilt 7.0° clockwise of the slot's own: 7.0° counterclockwise in all")),
    ],
)  # fmt: skip
def test_a_slot_has_its_skew_and_its_own_tilt_apart(size, words):
    text = run(read, "craft-slot", size=size)
    for each in words:
        assert each in text
