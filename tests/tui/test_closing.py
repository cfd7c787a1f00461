"""While the dish moves Esc stops it: each layer names another key that closes it, which does, and so does the mouse."""

import re

import pytest
import stand_in
from birdcage.station.requests import Unwatch, Watch
from birdcage_tui.track.offer import OfferLine
from birdcage_tui.widgets.esc_field import LeaveField
from places import BY_NAME, PLACES, at, settle
from stage import run

SAID = {
    "? closes": ["question_mark"], "q closes": ["q"], "Backspace closes": ["backspace"],
    "Backspace clears it": ["backspace"], "Backspace leaves": ["backspace"], "n  do nothing": ["n"],
    "; closes": ["semicolon"], "s closes": ["s"],
}  # fmt: skip
"""What is said, and the keys that it means."""
CANCEL = " Cancel "
"""A button that Tab reaches."""
LIVE = "l live"
"""So a replay is left. Under a dialog of its own this shows, too, and is not meant."""


def layers_of(app):
    focused = app.focused if isinstance(app.focused, LeaveField | OfferLine) else None
    return tuple(app.screen_stack), focused


def layered():
    """The places with a dialog, or with a line that takes the keys."""
    lines = ("EscField", "FindInput", "OfferLine")
    return [
        place for place in PLACES if place.dialog or any(f"/{kind}" in each for kind in lines for each in place.holds)
    ]


def named(text):
    flat = " ".join(re.sub("[│╭╮╰╯─]", " ", text).split())
    return next((words for words in (*SAID, CANCEL, LIVE) if words in text or words in flat), None)


async def press_what_is_named(app, pilot, words):
    if words == CANCEL:
        for _ in range(12):
            await pilot.press("tab")
            if type(app.focused).__name__ == "CancelButton":
                break
        await pilot.press("enter")
    else:
        await pilot.press(*({LIVE: ["l"]} | SAID)[words])
    await settle(app, pilot)


@pytest.mark.parametrize("place", layered(), ids=lambda place: place.name)
def test_while_the_dish_moves_a_key_is_named_that_closes_the_layer_and_does_nothing_else(place, tmp_path):
    async def close(app, pilot, _asked_by):
        before, asked, stops = layers_of(app), len(app.station.asked), len(app.station.stops)
        assert app.view().may_move
        text = stand_in.text_of(app)
        words = named(text)
        assert words is not None, text
        await press_what_is_named(app, pilot, words)
        assert layers_of(app) != before, words
        assert len(app.station.stops) == stops
        assert [each for each in app.station.asked[asked:] if not isinstance(each, Watch | Unwatch)] == []

    at(place, tmp_path, close)


CLICKED = ("help", "palette", "draw the horizon", "new preset", "set the location", "go to", "home", "jump",
           "pocket, go to", "help, pocket")  # fmt: skip


@pytest.mark.parametrize("name", CLICKED)
def test_the_mouse_closes_it_too(name, tmp_path):
    async def click(app, pilot, _asked_by):
        before, stops = layers_of(app), len(app.station.stops)
        rows = stand_in.text_of(app).splitlines()
        words = CANCEL if "go to" in name else named("\n".join(rows))
        spot = next((row.index(words), y) for y, row in reversed([*enumerate(rows)]) if words in row)
        await pilot.click(offset=(spot[0] + 1, spot[1]))
        await settle(app, pilot)
        assert layers_of(app) != before
        assert len(app.station.stops) == stops

    at(BY_NAME[name], tmp_path, click)


def test_enter_in_help_does_nothing_before_an_arrow_selects(tmp_path):
    async def stopped(app, pilot):
        await pilot.press("question_mark")
        await pilot.press("escape")
        before = list(app.station.stops)
        await pilot.press("enter")
        still = len(app.screen_stack) == 2 and app.station.stops == before
        await pilot.press("down", "enter")
        return before, still, len(app.screen_stack)

    assert run(stopped, "slewing") == (["you"], True, 1)


@pytest.mark.parametrize("name", ["help", "new preset", "go to"])
def test_no_layer_names_two_keys_for_stop_in_two_phrases(name, tmp_path):
    async def read(app, _pilot, _asked_by):
        return stand_in.text_of(app)

    text = at(BY_NAME[name], tmp_path, read)
    assert "Esc or Ctrl+C stops" in text
    assert "Esc stops the dish, Ctrl+C" not in text
