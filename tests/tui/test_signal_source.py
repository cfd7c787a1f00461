"""`s` on F3: another source is heard, what is wrong with it is said, and a dish without a tuner peaks by it."""

from __future__ import annotations

import asyncio

import pytest
from birdcage.signal.recordings import list_recordings
from birdcage.station.requests import BeginTask
from birdcage_tui.widgets.choice_screen import ChoiceScreen
from test_demo import stage_of_the_pictures

OFFERED = ("tuner", "receiver", "SatDump", "gqrx", "SDR++", "rtl_tcp", "rtl_power")


def on_f3(play, size=(80, 24), **demo):
    async def body():
        async with stage_of_the_pictures().demo(size, **demo) as on:
            await on.wait(5)
            await on.press("f3")
            await on.wait(2)
            return await play(on)

    return asyncio.run(body())


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48)], ids=str)
def test_each_source_is_offered_with_its_unit_rate_and_place(size):
    async def look(on):
        await on.press("s")
        await on.wait(1)
        frame = on.app.screen.query_one("Vertical")
        assert isinstance(on.app.screen, ChoiceScreen)
        assert on.app.screen.region.contains_region(frame.region)
        return on.text()

    text = on_f3(look, size)
    for name in OFFERED:
        assert name in text, name
    for words in ("as often as the wire allows, in use", "http://localhost:8081/api", "dBFS, 10.0/s, each 0.1 s long"):
        assert words in text, words


def test_another_one_is_heard_from_then_on_and_how_to_keep_it_is_said():
    async def look(on):
        await on.press("s")
        await on.press("down", "enter")
        await on.wait(4)
        before = on.text()
        await on.press("s", "up", "enter")
        await on.wait(4)
        return before, on.text()

    receiver, tuner = on_f3(look)
    assert 'signal = "rigctl" in [feed.stock-ku] keeps it.' in receiver
    assert "(dB)" in receiver
    assert "dish tuner (counts)" in tuner


def test_a_dish_without_a_tuner_peaks_by_the_receiver():
    asked = []

    async def look(on):
        await on.press("f")
        await on.wait(1)
        refused = on.text()
        await on.press("s", "down", "enter")
        await on.wait(3)
        await on.press("f")
        await on.wait(1)
        question = on.text()
        ask = on.app.ask
        on.app.ask = lambda request, *more, **words: (asked.append(request), ask(request, *more, **words))[1]
        await on.press("enter")
        await on.wait(1)
        return refused, question

    refused, question = on_f3(look, firmware="hal205", size=(120, 36))
    assert "has no tuner to read. s chooses another source." in refused
    assert "Find the peak" in question
    begun = [request for request in asked if isinstance(request, BeginTask)]
    assert [request.values["source"] for request in begun] == ["rigctl"]


def test_every_reading_is_recorded_also_beside_another_page():
    async def look(on):
        await on.press("r")
        await on.wait(4)
        shown = on.text()
        await on.press("f7")
        await on.wait(6)
        await on.press("f3")
        await on.wait(1)
        await on.press("r")
        await on.wait(1)
        file = on.app.settings.recordings_file
        return shown, on.text(), list_recordings(file)

    shown, ended, (told,) = on_f3(look)
    assert "● recording, " in shown
    assert f"Recording 1: {told.readings} readings." in ended
    assert "● recording" not in ended
    assert told.readings > 20
    assert (told.ended - told.begun).total_seconds() > 8.0
    assert told.demo
