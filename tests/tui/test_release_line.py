"""The line that releases the dish says who moves it first then, and where to; or that nothing does."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
import stand_in
import track_stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.held import HeldReason
from birdcage.base.reason import Reason
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Release
from birdcage.station.state import Activity, HeldState, StopReport, TvSearch
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.shown.held_words import after_release
from birdcage_tui.shown.state_words import bad_day
from birdcage_tui.shown.view import View
from desk_house import play
from stage import read, run
from test_resume import follow

SIZES = [(40, 12), (60, 20), (80, 24), (120, 36)]


def told(held=None, track=None, **changes):
    """The row's words in a state of the stand-in."""
    clock = VirtualClock()
    state = stand_in.held(clock)
    state = replace(state, held=replace(state.held, **(held or {})), **changes)
    view = View(state, clock.monotonic(), clock.utc(), AppOptions(), track=track)
    return after_release(view), bad_day(view)[1]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_nothing_moves_after_an_ordinary_stop_and_the_row_says_so(tmp_path, size):
    async def stop(house):
        await follow(house)
        await house.pilot.resize_terminal(*size)
        await house.press("space")
        for _ in range(3):
            text = await house.look(1.0)
        house.asked.clear()
        await house.press("enter")
        at = house.app.view().state.position
        for _ in range(30):
            await house.look(1.0)
        now = house.app.view().state
        return text, [type(each) for each in house.asked], (at.az_deg, at.el_deg), now

    text, asked, at, now = play(tmp_path, stop)
    assert "Enter release: nothing moves then" in re.sub(r"[\s│]+", " ", text), text
    assert asked[0] is Release
    assert now.held is None
    assert (now.position.az_deg, now.position.el_deg) == pytest.approx(at, abs=0.02), "and so it is"


def test_a_pursuit_that_a_lost_link_has_interrupted_goes_on_and_is_named_with_its_direction():
    clock = VirtualClock()
    state, desk, _ = track_stand_in.interrupted(clock)
    held = HeldState("birdcage", clock.monotonic(), clock.utc(), HeldReason.LINK, "tracker", 93.0, 41.0)
    view = View(replace(state, held=held), clock.monotonic(), clock.utc(), AppOptions(), track=desk)
    az_deg, el_deg = state.pursuit.plan.sky.at(clock.utc().timestamp())
    words = bad_day(view)[1]
    assert f"Enter release: tracker moves it to {az_deg % 360:.0f}°/{el_deg:.0f}° for METEOR-M2 4" in words
    assert "ignored" not in words, "it was announced, and asked for nothing that was refused"
    lost = replace(view, state=replace(view.state, position=None))
    assert bad_day(lost)[1].endswith("once its position is known")


def test_who_was_refused_may_move_it_and_you_do_not():
    assert told()[0] == "Gpredict may move it to 231.4/44.0"
    assert told()[1].startswith("■ HELD by you 12:00:00  Gpredict 231.4/44.0 ignored x3   Enter release: Gpredict may")
    assert told({"next_holder": "you"})[0] == "nothing moves then"


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"search": TvSearch.RUNNING}, "the TV search moves it on"),
        ({"activity": Activity.STOPPING}, "it may still be moving"),
        ({"last_stop": StopReport("you", 0.0, "retarget", False, "")}, "it may still be moving"),
        ({"last_stop": StopReport("you", 0.0, "end of move", None, "")}, "it may still be moving"),
        ({"activity": Activity.INITIALIZING}, "it starts up, and moves by itself"),
        ({"position": None, "position_lost": Reason.RELEASED}, "its motors stay off"),
        ({"position": None, "position_lost": Reason.UNHOMED, "homed": False}, "birdcage sends no motion then"),
        ({"activity": Activity.UNKNOWN}, "birdcage sends no motion then"),
        ({}, "nothing moves then"),
    ],
)
def test_in_every_other_state_no_more_is_said_than_is_known(changes, words):
    assert told({"next_holder": None, "ignored": 0}, **changes)[0] == words


def test_autotrack_that_stop_has_not_switched_off_yet_is_named():
    _, desk, _ = track_stand_in.idle(VirtualClock())
    assert told({"next_holder": None}, track=replace(desk, autotrack=True))[0] == "autotrack may move it"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_whole_line_stands_on_the_screen(size):
    text = re.sub(r"[\s│]+", " ", run(read, "held", size))
    assert "Enter release: Gpredict may move it to 231.4/44.0" in text


def test_only_a_dish_at_rest_after_a_confirmed_stop_is_said_to_stay():
    """Over every state of the pursuit: no row claims that nothing moves where a pursuit goes on."""
    clock = VirtualClock()
    state, desk, _ = track_stand_in.interrupted(clock)
    for phase in Phase:
        held = HeldState("birdcage", clock.monotonic(), clock.utc(), HeldReason.LINK)
        view = View(replace(state, held=held, pursuit=replace(state.pursuit, phase=phase)), clock.monotonic(),
                    clock.utc(), AppOptions(), track=desk)  # fmt: skip
        assert (after_release(view) == "nothing moves then") == (phase is not Phase.INTERRUPTED), phase
