"""Keys of the Calibrate tab, and its mouse: what each asks for."""

from __future__ import annotations

import re
from concurrent.futures import Future
from dataclasses import replace

import calibrate_stand_in
import pytest
import stand_in
from birdcage_tui.calibrate.aim import AimPane
from birdcage_tui.calibrate.lists import ObjectsPane
from birdcage_tui.calibrate.tabs import SetupTabs
from birdcage_tui.shown.allowed import can_move
from birdcage_tui.widgets.footer import KeyBar
from burst import write
from calibrate_tab import SIZES, press, run, settle


def test_keys_ask_for_what_they_say():
    async def play(app, pilot, source):
        for keys in (("right",), ("up",), ("minus",), ("h",), ("enter",), ("n",), ("enter",), ("m",), ("enter",),
                     ("u",), ("r",)):  # fmt: skip
            await press(app, pilot, *keys)
        asked = [tuple(each for each in one if not isinstance(each, Future)) for one in source.asked]
        assert asked == [
            ("nudge", 1.0, 0.0), ("nudge", 0.0, 1.0), ("nudge", -0.5, 0.0), ("take",),
            *[("go", calibrate_stand_in.SCENES["five"].guide.proposals[0].candidate)] * 2,
            ("undo",), ("refresh",),
        ]  # fmt: skip
        ways = [each for one in source.asked for each in one if isinstance(each, Future)]
        assert app.motions.under_way == set(ways), "Esc stops until they are at their end"
        assert app.view().may_move
        for way in ways:
            way.set_result(None)
        assert not app.motions.under_way

    run(play)


def test_another_object_is_chosen_in_the_list_and_gone_to():
    async def play(app, pilot, source):
        await press(app, pilot, "o")
        assert app.focused is app.screen.query_one(ObjectsPane)
        await press(app, pilot, "down")
        await press(app, pilot, "down")
        await press(app, pilot, "enter")
        assert source.asked[0][:2] == ("go", calibrate_stand_in.SCENES["five"].guide.proposals[2].candidate)
        assert app.focused is app.screen.query_one(AimPane), "the arrows nudge again"

    run(play)


def test_a_click_chooses_an_object_and_a_button_goes_there():
    async def play(app, pilot, source):
        pane = app.screen.query_one(ObjectsPane)
        await pilot.click(pane, offset=(10, 3))  # below the frame and the names of the columns
        await settle(app, pilot)
        assert pane.at == 1
        aim = app.screen.query_one(AimPane)
        spot = next(region for region, command in aim.hot if command == "calibrate-object-go")
        await pilot.click(aim, offset=(spot.x + 3, spot.y + 1))
        await settle(app, pilot)
        assert source.asked[0][:2] == ("go", calibrate_stand_in.SCENES["five"].guide.proposals[1].candidate)

    run(play)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(("key", "name"), [("n", "82°W Nimiq 4"), ("m", "Sun")])
def test_a_letter_selects_an_object_in_sight_and_the_footer_says_that_enter_goes_there(key, name, size):
    """Whatever list was shown before, and wherever its cursor was."""

    async def play(app, pilot, source):
        now = calibrate_stand_in.SCENES["five"]
        app.calibrate.now = replace(now, guide=replace(now.guide, target="Sun", expected=(223.0, 42.0)))
        await press(app, pilot, "o")
        await press(app, pilot, "down")
        await press(app, pilot, "s")
        await press(app, pilot, key)
        objects, text = app.page.query_one(ObjectsPane), stand_in.text_of(app)
        assert app.focused is objects
        assert objects.region.area > 0
        assert f"▶ {name}" in text
        assert re.search(r"Enter\s+go there", text.splitlines()[-1])
        assert [each[0] for each in source.asked] == []
        bar = app.query_one(KeyBar)
        spot = next(region for region, command in bar.hot if command == "calibrate-object-go")
        await pilot.click(bar, offset=(spot.x + 1, spot.y))
        await settle(app, pilot)
        candidate = {"n": now.guide.proposals[0].candidate, "m": None}[key]
        assert source.asked[0][:2] == ("go", candidate)
        assert app.focused is app.page.query_one(AimPane)

    run(play, size=size)


def test_enter_right_behind_the_letter_goes_there_and_takes_no_peak():
    async def play(app, pilot, source):
        write(app, "n", "enter")
        for _ in range(4):
            await settle(app, pilot)
        assert [each[0] for each in source.asked] == ["go"]

    run(play)


def test_a_peak_is_forgotten_and_all_of_them_only_after_a_yes():
    async def play(app, pilot, source):
        await press(app, pilot, "p")
        await press(app, pilot, "down")
        await press(app, pilot, "d")
        assert source.asked == [("remove", 2)]
        await press(app, pilot, "X")
        await press(app, pilot, "enter")
        assert source.asked == [("remove", 2)]
        await press(app, pilot, "X")
        await press(app, pilot, "y")
        assert source.asked == [("remove", 2), ("remove",)]

    run(play)


def test_a_fit_is_kept_under_a_name_and_a_kept_set_is_used():
    async def play(app, pilot, source):
        await press(app, pilot, "a")
        assert "Saved: Roof, Van" in " ".join(stand_in.text_of(app).replace("│", " ").split())
        await press(app, pilot, *["backspace"] * 4)
        await press(app, pilot, "enter")
        assert "Type a name" in stand_in.text_of(app)
        await press(app, pilot, *"Shed")
        await press(app, pilot, "enter")
        await press(app, pilot, "s")
        await press(app, pilot, "down")
        await press(app, pilot, "enter")
        assert source.asked == [("apply", "Shed"), ("use", "Van")]

    run(play)


def test_nothing_is_asked_for_that_cannot_be_done():
    async def play(app, pilot, source):
        for key in ("enter", "u", "a", "X", "p", "d"):
            await press(app, pilot, key)
        assert source.asked == []
        assert "No object is chosen" not in stand_in.text_of(app).splitlines()[-1]

    run(play, "first")


def test_enter_releases_first_while_stop_is_latched():
    async def play(app, pilot, source):
        assert can_move(app.view()) is not None
        await press(app, pilot, "right")
        await press(app, pilot, "n")
        await press(app, pilot, "enter")
        assert source.asked == []
        assert type(app.station.asked[-1]).__name__ == "Release"

    run(play, state="held")


def test_v_turns_the_picture_over_where_there_is_room_for_one():
    async def play(app, pilot, _source):
        assert "Residuals" in stand_in.text_of(app)
        await press(app, pilot, "v")
        await settle(app, pilot)
        text = stand_in.text_of(app)
        assert "On the sky" in text
        assert "Residuals" not in text

    run(play)


def test_the_tabs_lead_there_and_back_by_the_mouse():
    async def play(app, pilot, _source):
        tabs = app.page.query_one(SetupTabs)
        await pilot.click(tabs, offset=(3, 0))
        await settle(app, pilot)
        assert app.page.scope == "setup"
        spot = next(region for region, command in app.page.query_one(SetupTabs).hot if command == "tab-calibrate")
        await pilot.click(app.page.query_one(SetupTabs), offset=(spot.x + 2, 0))
        await settle(app, pilot)
        assert app.page.scope == "calibrate"

    run(play)
