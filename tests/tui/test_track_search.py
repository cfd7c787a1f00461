"""The search of the Track tab: what stands around the field, and the columns of what was found."""

import re
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.held import HeldReason
from birdcage.station.requests import Release
from birdcage.station.state import HeldState
from test_track_lists import with_schedule
from track_stage import run


async def typed(app, pilot, _desk):
    await pilot.press("slash")
    await pilot.press(*"met")
    await pilot.pause()
    app.paint()
    await pilot.pause()
    return stand_in.text_of(app)


@pytest.mark.parametrize("size", [(80, 24), (100, 30), (160, 48)], ids=str)
def test_the_field_has_its_name_and_says_what_leaves_it_after_something_was_typed(size):
    text = run(typed, "craft-idle", size=size)
    assert re.search(r"^ search +met +Enter selects, Esc closes *$", text, re.MULTILINE), text


@pytest.mark.parametrize("size", [(80, 24), (100, 30), (160, 48)], ids=str)
def test_an_age_is_said_to_be_that_of_the_elements(size):
    text = run(typed, "craft-idle", size=size)
    heading = next(line for line in text.splitlines() if "number · elements" in line)
    row = next(line for line in text.splitlines() if "59051 · 6 h old" in line)
    assert heading.index("number · elements") == row.index("59051 · 6 h old"), text


def test_on_a_large_screen_a_found_satellite_has_its_next_pass():
    text = run(typed, "craft-idle", size=(160, 48))
    assert re.search(r"name +number · elements +next event +max +reach", text), text
    assert re.search(r"METEOR-M2 4 +59051 · 6 h old +out +01:29 +71° +7m28", text)


def test_on_a_small_screen_the_pass_is_left_out_and_nothing_is_cut():
    text = run(typed, "craft-idle", size=(80, 24))
    assert "next event" not in text
    assert "59051 · 6 h old" in text


@pytest.mark.parametrize("size", [(80, 24), (160, 48)], ids=str)
def test_enter_in_the_field_chooses_while_the_dish_is_held_and_row_2_names_no_key_that_the_field_takes(size):
    async def choose(app, pilot, desk):
        held = HeldState("you", 0.0, app.session.clock.utc(), HeldReason.STOP)
        app.station.state = replace(app.station.state, held=held)
        text = await typed(app, pilot, desk)
        await pilot.press("enter")
        return text, desk.asked, app.station.asked

    text, asked, of_dish = run(choose, "craft-idle", size=size)
    row = text.splitlines()[1]
    assert "HELD by you" in row
    assert "Esc, then Enter release" in row
    assert " U resume" not in row
    assert "Enter choose" in text.splitlines()[-1] or size == (80, 24)
    assert any(each[0] == "choose" for each in asked)
    assert not any(isinstance(each, Release) for each in of_dish)


def test_a_row_without_room_for_number_and_age_tells_what_comes_next():
    async def long(app, pilot, desk):
        await typed(app, pilot, desk)
        found = tuple(replace(one, detail="999000001 · elements 44 min old") for one in desk.now.found)
        return await with_schedule(app, pilot, desk, found=found)

    text = run(long, "craft-idle", size=(80, 24))
    assert re.search(r"name +next event +max", text), text
    assert re.search(r"METEOR-M2 4 .*out +01:29 +71°", text), text
    assert "999000001" not in text
