"""Before something long begins, an app that drives the dish itself says once that it ends with the terminal."""

from __future__ import annotations

from dataclasses import replace

import pytest
import stand_in
from track_stage import SIZES, run

WORDS = "Following ends with this terminal. `birdcage station run` goes on without one."


def offered(key, *, demo, via="", size=(80, 24)):
    """Return what row 2 says once following is offered, and once it is offered again."""

    async def offer(app, pilot, _desk):
        app.session.via = via
        app.station.state = replace(app.station.state, demo=demo, pursuit=None, held=None, holder=None)
        found = []
        for _ in range(2):
            await pilot.press(key)
            await pilot.pause()
            app.paint()
            await pilot.pause()
            found.append(stand_in.text_of(app).splitlines()[1].strip())
            await pilot.press("backspace")
            app.say("")
            await pilot.pause()
        return found

    return run(offer, "craft-chosen", size)


@pytest.mark.parametrize("size", SIZES[:3])
@pytest.mark.parametrize("key", ["f", "A"])
def test_it_is_said_before_following_and_once(key, size):
    first, second = offered(key, demo=False, size=size)
    assert first == WORDS
    assert second != WORDS


def test_pointing_once_is_not_long():
    assert WORDS not in offered("a", demo=False)


def test_a_demo_and_an_app_that_is_attached_do_not_say_it():
    assert WORDS not in offered("f", demo=True)
    assert WORDS not in offered("f", demo=False, via="birdcage station run (process 7)")
