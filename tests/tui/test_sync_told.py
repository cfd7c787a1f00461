"""A rotator that a person has to sync: the app says so, Y asks where it points, and nothing moves by it."""

from __future__ import annotations

import re
from concurrent.futures import Future
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.errors import ConfirmationNeeded
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.station.requests import Sync
from birdcage_tui.widgets.dialogs import TAKEN_IN_S, QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldsScreen
from stage import run

ROTATOR = replace(
    CARRYOUT_G2, name="Rotator", homing_s=None, never_homes=True, zero_at_power_up=(CARRYOUT_G2.azimuth.name,)
)
UNTOLD = {"dish": ROTATOR, "homed": False, "position": None, "position_lost": "unsynced"}


async def text(app, _pilot):
    return stand_in.text_of(app)


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (160, 48), (40, 12)])
def test_it_says_what_is_missing_and_which_key_helps(size):
    shown = run(text, state=UNTOLD, size=size)
    assert "NOT SYNCED" in shown
    assert "NOT HOMED" not in shown
    assert "Y\N{NO-BREAK SPACE}syncs it" in shown or "Y syncs it" in shown
    assert "H homes" not in shown
    if size[0] >= 120:
        assert re.search(r"synced +NO: Y syncs it", shown)


def test_nothing_is_homed_and_nothing_sent():
    async def press(app, pilot):
        await pilot.press("H", "right")
        await pilot.pause()
        return app.station.asked

    asked = run(press, state=UNTOLD, size=(160, 48))
    assert [each for each in asked if type(each).__name__ in ("Home", "Goto", "Jog")] == []


@pytest.mark.parametrize(("typed", "sent"), [
    (("200", ""), Sync(200.0, None, "you")), (("12,5", "31"), Sync(12.5, 31.0, "you")),
])  # fmt: skip
def test_y_asks_and_tells(typed, sent):
    async def press(app, pilot):
        await pilot.press("Y")
        await pilot.pause()
        assert isinstance(app.screen, FieldsScreen)
        await pilot.press(*typed[0].replace(",", "."), "tab", *typed[1], "enter")
        await pilot.pause()
        return app.station.asked_for(Sync)

    assert run(press, state=UNTOLD) == [sent]


@pytest.mark.parametrize("typed", ["", "north", "400"])
def test_what_is_no_azimuth_is_not_told(typed):
    async def press(app, pilot):
        await pilot.press("Y")
        await pilot.pause()
        await pilot.press(*typed, "enter")
        await pilot.pause()
        return app.station.asked_for(Sync), stand_in.text_of(app)

    asked, shown = run(press, state=UNTOLD)
    assert asked == []
    assert "Type the azimuth: 0 to 360." in shown


def test_what_it_believes_otherwise_is_asked_in_its_words():
    async def press(app, pilot):
        asked = []

        def submit(request):
            asked.append(request)
            future = Future()
            if isinstance(request, Sync) and not request.agreed:
                future.set_exception(ConfirmationNeeded("It points elsewhere by its own word. Change it?"))
            return future

        app.station.submit = submit
        await pilot.press("Y")
        await pilot.pause()
        await pilot.press(*"200", "enter")
        await pilot.pause()
        await pilot.pause()
        assert isinstance(app.screen, QuestionScreen)
        shown = stand_in.text_of(app)
        app.session.clock.advance(TAKEN_IN_S)
        await pilot.press("y")
        await pilot.pause()
        return shown, [each for each in asked if isinstance(each, Sync)]

    shown, asked = run(press, state=UNTOLD)
    assert "It points elsewhere by its own word." in shown
    assert asked == [Sync(200.0, None, "you"), Sync(200.0, None, "you", agreed=True)]


def test_a_dish_that_knows_by_itself_is_not_asked():
    async def press(app, pilot):
        await pilot.press("Y")
        await pilot.pause()
        return isinstance(app.screen, FieldsScreen), stand_in.text_of(app)

    opened, shown = run(press, size=(160, 48))
    assert not opened
    assert "knows by itself where it points" in shown
