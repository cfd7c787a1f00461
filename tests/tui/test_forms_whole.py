"""At 40x12 no form and no layer cuts its words short."""

from __future__ import annotations

import pytest
import stand_in
from stage import run

LAYERS = {
    "L": ("location", "Rotterdam or JO21jv", "Cancel"),
    "I": ("elements", "~/iss.txt, or paste", "Cancel"),
    "colon": ("Type part of a command", "Step counterclockwise"),
    "question_mark": ("The pocket view", "Esc"),
    "g": ("go to", "A sign adds to the last target."),
}


def flat(text):
    return " ".join(text.replace("│", " ").split())


@pytest.mark.parametrize("state", ["idle", "slewing"])
@pytest.mark.parametrize("key", LAYERS)
def test_its_words_hint_and_keys_are_whole(key, state):
    async def opened(app, pilot):
        await pilot.press(key)
        await pilot.pause()
        app.paint()
        await pilot.wait_for_scheduled_animations()
        return stand_in.text_of(app)

    text = run(opened, state, (40, 12), keep_place=lambda *_: None)
    assert "…" not in text, text
    for words in LAYERS[key]:
        assert words in flat(text), text
    if key != "g":
        edge = next(row for row in text.splitlines() if row.lstrip().startswith("╰─"))
        assert ("Esc stops" if state == "slewing" else "Esc closes") in edge, text


@pytest.mark.parametrize("typed", ["180/95", "no such thing at all", "az=9999"])
def test_why_nothing_would_be_sent_is_whole_in_the_go_to_line(typed):
    async def type_it(app, pilot):
        await pilot.press("g")
        app.screen.focused.value = typed
        await pilot.pause()
        app.paint()
        await pilot.pause()
        from birdcage_tui.goto.goto_line import foretell

        return foretell(typed, app.view(), 38)[1], stand_in.text_of(app)

    words, text = run(type_it, "idle", (40, 12))
    assert " ".join(words.split()) in flat(text), text
    assert "S T O P" in text


def test_a_wrong_place_is_told_whole_with_its_way_out():
    async def type_it(app, pilot):
        await pilot.press("L")
        app.screen.focused.value = "rotterdxm"
        await pilot.pause()
        typed = flat(stand_in.text_of(app))
        await pilot.press("enter")
        await pilot.pause()
        return typed, flat(stand_in.text_of(app))

    for text in run(type_it, "idle", (40, 12), keep_place=lambda *_: None):
        assert "No city called 'rotterdxm'" in text
        assert "Type a larger city nearby, a locator, or latitude and longitude. Cancel" in text
