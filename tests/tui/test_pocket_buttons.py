"""Every key that the words of the pocket view name has a button there."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
import stage
import stand_in
from birdcage.ready.check import Check
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldsScreen
from stage import read
from test_pocket import click, press, run

NAMED = {"U": "U resume", "K": "K end it", "L": "L place", "I": "I add", "H": "H home"}
"""Keys that the words of the pocket view name, and the buttons that do what they do."""


@pytest.mark.parametrize("size", [(40, 12), (43, 14), (60, 20), (79, 23)], ids=str)
def test_every_key_that_its_words_name_has_a_button(size):
    def named_in(text):
        words = re.sub(r"[\[(╎│][^\])╎│]*[\])╎│]", " ", "\n".join(text.splitlines()[1:]))  # without the buttons
        return {key for key in NAMED if re.search(rf"(?<![\w.]){key}(?::| (?:resume|sets|homes|ends|end)\w*)", words)}

    for name, text in stage.run_each(read, size=size).items():
        for key in named_in(text):
            assert NAMED[key] in text, (name, text)


def test_a_search_that_moves_the_dish_is_ended_by_a_thumb():
    async def end(app, pilot):
        await click(app, pilot, "K end it")
        on_button = type(app.screen)
        await press(app, pilot, "n")
        await click(app, pilot, "TV SEARCH RUNNING")
        return on_button, type(app.screen)

    assert run(end, "travler-search") == (QuestionScreen, QuestionScreen)


def test_what_is_missing_has_a_button_in_the_pocket_view():
    async def add(app, pilot):
        app.feeds.ready.take((Check("place", "place", "must", "not set", "birdcage place add"),))
        app.settings = replace(app.settings, place=None, keep_place=lambda *_: None)
        app.paint()
        await pilot.pause()
        text = stand_in.text_of(app)
        await click(app, pilot, "L place")
        return text, type(app.screen)

    text, screen = run(add, state={"target_az_deg": None, "target_el_deg": None})
    assert "L sets it" in text
    assert screen is FieldsScreen
