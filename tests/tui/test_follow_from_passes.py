"""F7 follows: f shows the plan of the pass under the cursor, Enter there follows it; and 110W from any page."""

from __future__ import annotations

import pytest
import stand_in
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Goto, Home, Pursue, Release
from birdcage_tui.goto.goto_line import GotoLine
from desk_house import play

SIZES = [(80, 24), (120, 36)]


async def to_passes(house, *keys):
    """Home the dish, let the search end, and press keys on F7."""
    await house.home()
    await house.press("f7", *keys)
    for _ in range(3):
        await house.look()


def pursuits(house):
    return [each for each in house.asked if isinstance(each, Pursue)]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_next_pass_of_a_name_is_followed_in_four_keys_and_the_name(tmp_path, size):
    async def follow(house):
        await to_passes(house, "slash", *"noaa 20", "enter")
        picked = house.app.page.selection.chosen(house.app.view())
        await house.press("f")
        await house.look()
        offered = await house.look()
        before = pursuits(house), list(house.asked)
        await house.press("enter")
        await house.look()
        return picked, offered, before, pursuits(house), await house.look()

    picked, offered, (before, asked), after, text = play(tmp_path, follow, size)
    assert picked.name == "NOAA 20 (JPSS-1)"
    assert "Enter follows NOAA 20 (JPSS-1): the dish goes to" in offered
    assert before == [], "f only shows the plan"
    assert not any(isinstance(each, Goto) for each in asked)
    (pursue,) = after
    assert pursue.plan.aim.norad_id == 43013
    assert abs(pursue.plan.passing.tca.timestamp() - picked.tca_s) < 60
    assert "Enter follows NOAA 20" not in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_it_is_the_pass_under_the_cursor_and_not_the_next_one_of_that_satellite(tmp_path, size):
    async def follow(house):
        await to_passes(house, "slash", *"meteor", "enter", "down", "down")
        picked = house.app.page.selection.chosen(house.app.view())
        await house.press("f")
        await house.look()
        await house.look()
        return picked, house.app.track.now.plan.passing, await house.look()

    picked, passing, text = play(tmp_path, follow, size)
    assert abs(passing.tca.timestamp() - picked.tca_s) < 60
    assert f"{passing.tca:%H:%M:%S}" in text


@pytest.mark.parametrize("way", [("escape",), ("down",), ("f7", "f2"), ("v", "escape")])
def test_enter_follows_nothing_once_something_else_was_taken_up(tmp_path, way):
    async def leave(house):
        await to_passes(house, "slash", *"noaa 20", "enter")
        await house.press("f")
        await house.look()
        await house.press(*way)
        text = await house.look()
        await house.press("enter")
        await house.look()
        return text, pursuits(house)

    text, asked = play(tmp_path, leave)
    assert "Enter follows" not in text
    assert asked == []


def test_what_is_held_is_released_first_and_follows_nothing_by_that(tmp_path):
    async def held(house):
        await to_passes(house, "slash", *"noaa 20", "enter")
        await house.press("space")
        await house.look()
        await house.press("f")
        await house.look()
        offered = await house.look()
        await house.press("enter")
        await house.look()
        first = [type(each) for each in house.asked if isinstance(each, Pursue | Release)]
        await house.press("enter")
        await house.look()
        return offered, first, pursuits(house)

    offered, first, then = play(tmp_path, held)
    assert "Enter releases the dish. Enter again follows NOAA 20 (JPSS-1)." in offered
    assert first == [Release]
    assert len(then) == 1


def test_a_dish_that_is_not_homed_says_so_and_is_not_sent(tmp_path):
    async def lost(house):
        for _ in range(8):
            await house.look(1.0)
        await house.press("f7", "f")
        for _ in range(3):
            text = await house.look()
        await house.press("enter")
        await house.look()
        return text, house.app.view().state.homed, pursuits(house)

    text, homed, asked = play(tmp_path, lost, port="sim:g2?seed=1&unhomed=1")
    assert homed is False
    assert "▶ ISS (ZARYA): home the dish first (H). " in text
    assert asked == []


def test_help_has_what_enter_does_there(tmp_path):
    async def ask(house):
        await to_passes(house, "slash", *"noaa 20", "enter")
        await house.press("f")
        await house.look()
        scopes = house.app.view().scopes
        await house.press("question_mark")
        return scopes, " ".join(stand_in.text_of(house.app).split())

    scopes, text = play(tmp_path, ask)
    assert scopes == ("offer-follow", "craft")
    assert "Enter Follow the picked pass" in text


def test_favourites_only_has_moved_to_a_capital(tmp_path):
    async def both(house):
        await to_passes(house)
        await house.press("F")
        hidden = house.app.page.selection.choice.favourites_only
        await house.press("question_mark")
        return hidden, " ".join(stand_in.text_of(house.app).split())

    hidden, text = play(tmp_path, both, (120, 60))
    assert hidden
    assert "f Plan and follow" in text
    assert "F Favourites only" in text


@pytest.mark.parametrize("page", [f"f{number}" for number in (1, 2, 3, 7)])
def test_a_slot_is_typed_as_the_map_writes_it_on_every_page(tmp_path, page):
    async def go(house):
        house.session.station.submit(Home("you"))
        house.session.step(60.0)
        await house.look(1.0)
        await house.press(page)
        await house.look()
        house.asked.clear()
        await house.press("g", *"110W", "enter")
        for _ in range(3):
            await house.look()
        return [each for each in house.asked if isinstance(each, Goto)], house.app.query_one(GotoLine).is_open

    ((goto,), is_open) = play(tmp_path, go)
    assert goto.az_deg == pytest.approx(201.8, abs=1.0)
    assert not is_open


def test_a_pursuit_begins_and_the_status_line_says_so(tmp_path):
    async def follow(house):
        await to_passes(house, "slash", *"noaa 20", "enter", "f")
        await house.look()
        await house.look()
        await house.press("enter")
        await house.look()
        await house.look()
        return house.app.view().state.pursuit

    assert play(tmp_path, follow).phase is not Phase.OVER
