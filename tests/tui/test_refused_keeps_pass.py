"""What a limit forbids, typed, chosen or stepped to, ends no pass and takes no control."""

from __future__ import annotations

import pytest
import stand_in
from birdcage.base.presets import Preset
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import AcquireLease, Goto, Jog
from birdcage_tui.goto.goto_line import GotoLine
from desk_house import play
from stage import run
from test_resume import follow
from textual.widgets import Input

SIZES = [(80, 24), (120, 36)]


def by_hand(house):
    return [each for each in house.asked if isinstance(each, Goto | Jog | AcquireLease)]


async def go_on(house):
    for _ in range(4):
        text = await house.look(1.0)
    state = house.app.view().state
    return text, by_hand(house), state.pursuit.phase, state.holder


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_enter_on_a_direction_beyond_the_limit_keeps_the_line_and_the_pass(tmp_path, size):
    async def type_it(house):
        await follow(house)
        await house.press("g")
        await house.type("180 95")
        await house.press("enter")
        line = house.app.query_one(GotoLine)
        return *await go_on(house), line.is_open, line.query_one(Input).value

    text, asked, phase, holder, is_open, typed = play(tmp_path, type_it, size)
    assert (asked, phase, is_open, typed) == ([], Phase.FOLLOWING, True, "180 95")
    assert holder != "you"
    assert "Refused: Elevation 95.00° is 30.00° above the limit of 65.00°" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_enter_on_a_preset_beyond_the_limit_says_so_and_the_pass_goes_on(tmp_path, size):
    async def choose(house):
        await follow(house)
        house.app.presets.add(Preset("Roof", 120.0, 80.0))
        await house.press("f2", "P", "enter")
        return await go_on(house)

    text, asked, phase, holder = play(tmp_path, choose, size)
    assert (asked, phase) == ([], Phase.FOLLOWING)
    assert holder != "you"
    assert "Refused: Elevation 80.00° is 15.00° above the limit of 65.00°" in text


def test_a_step_beyond_the_limit_says_so_and_the_pass_goes_on(tmp_path):
    async def step(house):
        await follow(house)
        house.app.motions.step_deg = 90.0
        await house.press("up")
        return await go_on(house)

    text, asked, phase, _ = play(tmp_path, step, (120, 36))
    assert (asked, phase) == ([], Phase.FOLLOWING)
    assert "above the limit of 65.00°" in text


def test_at_rest_too_what_was_typed_stays_with_the_reason():
    async def type_it(app, pilot):
        await pilot.press("g", *"180 95".replace(" ", "/"), "enter")
        await pilot.pause()
        return app.query_one(GotoLine).is_open, stand_in.text_of(app), app.station.asked_for(Goto)

    is_open, text, asked = run(type_it)
    assert (is_open, asked) == (True, [])
    assert "Elevation 95.00° is 30.00° above the limit" in text


def test_the_line_says_which_pass_enter_ends(tmp_path):
    async def type_it(house):
        await follow(house)
        await house.press("g")
        return await house.type("180 40")

    assert "Enter ends NOAA 20 (JPSS-1): az 180.00° S, el 40.00°" in play(tmp_path, type_it, (120, 36))
