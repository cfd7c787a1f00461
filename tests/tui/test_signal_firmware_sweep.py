"""`w` on F3, by firmware: the dish sweeps by itself, is drawn as it comes, and a machine that can't says why."""

from __future__ import annotations

import asyncio

import pytest
from birdcage.station.state import Activity
from birdcage.station.stop_words import stop_line
from birdcage_tui.signal.ask_sweep import BY_FIRMWARE, wrong_sweep
from test_demo import stage_of_the_pictures
from textual.widgets import Input


async def asked(on, *, by="firmware", transponders="2"):
    await on.press("w")
    await on.wait(1)
    await on.press("tab", "tab", "tab")
    await on.type(by)
    words = on.text()
    await on.press("tab")
    await on.type(transponders)
    return words


def swept(size):
    async def body():
        async with stage_of_the_pictures().demo(size) as on:
            await on.wait(5)
            await on.press("f3", "g")
            await on.type("61.5W")
            await on.press("enter")
            await on.wait(15)
            words = await asked(on)
            screen = on.app.screen.region
            fields = [field.region for field in on.app.screen.query(Input)]
            await on.press("enter")
            await on.wait(60)
            return words, screen, fields, on.text()

    return asyncio.run(body())


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_the_firmware_sweeps_and_the_beam_is_drawn(size):
    asking, screen, fields, over = swept(size)
    assert BY_FIRMWARE[:27] in asking
    assert len(fields) == 5
    assert all(screen.contains_region(field) and field.width > 8 for field in fields)
    assert "azimuth 132." in over
    for words in ("width", "rise", "floor", "122.8°", "142.8°", "132.8°"):
        assert words in over, words


def test_while_it_sweeps_the_app_says_that_stop_may_not_end_it():
    async def body():
        async with stage_of_the_pictures().demo((120, 36)) as on:
            await on.wait(5)
            seen = set()
            on.app.station.watch(lambda state: seen.add((state.activity, stop_line(state, 0.0))))
            await on.press("f3")
            await asked(on)
            await on.press("enter")
            await on.wait(60)
            return {line for activity, line in seen if activity is Activity.SWEEPING}

    lines = asyncio.run(body())
    assert lines == {"STOP sends a key; the sweep may go on to its end. In an emergency, switch off its 12 V."}


def test_a_dish_without_one_shows_the_rows_grey_with_the_reason():
    async def body():
        async with stage_of_the_pictures().demo((80, 24), firmware="hal205") as on:
            await on.wait(12)
            await on.press("f3", "s")
            await on.wait(1)
            await on.press("end", "enter")
            await on.wait(2)
            await on.press("w")
            await on.wait(1)
            return on.text(), [field.disabled for field in on.app.screen.query(Input)]

    text, off = asyncio.run(body())
    assert "has no sweep of its own" in text
    assert off == [False, False, False, True, True]


@pytest.mark.parametrize(("values", "words"), [
    (("az", "20", "1", "firmware", "1"), ""),
    (("az", "20", "1", "steps", "x"), ""),
    (("az", "20", "1", "steps: the dish has no sweep of its own", "—"), ""),
    (("az", "20", "1", "me", "1"), "Type steps or firmware."),
    (("az", "20", "1", "firmware", "0"), "Type 1 to 32."),
    (("az", "20", "1", " Firmware ", "33"), "Type 1 to 32."),
])  # fmt: skip
def test_who_can_sweep(values, words):
    said = wrong_sweep(values)
    assert words in said
    assert bool(said) == bool(words)
