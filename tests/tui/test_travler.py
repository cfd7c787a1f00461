"""A Trav'ler on screen: the third axis, what is modelled, what STOP can do, and what it lacks, with the reason."""

import re
from dataclasses import replace
from datetime import UTC, datetime

import pytest
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.held import HeldReason
from birdcage.protocol.hal.model import TRAVLER
from birdcage.rotator.facts import SearchSwitch
from birdcage.station.events import End, MoveEnded
from birdcage.station.requests import Goto, Home, SetSearch, TurnSkew
from birdcage.station.state import Activity, HeldState, LinkPhase, LinkState, StopReport, TvSearch
from birdcage_tui.commands import BY_NAME
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.goto.goto_line import foretell
from birdcage_tui.goto.goto_skew import skew_of
from birdcage_tui.panes.health import HealthPane
from birdcage_tui.shown.state_words import bad_day, calm, ended_text, motion_text
from birdcage_tui.shown.stop_words import stop_text
from birdcage_tui.shown.view import View
from stage import read, run

SIZES = [(80, 24), (120, 36), (160, 48)]


def view_of(name):
    clock = VirtualClock()
    return View(stand_in.STATES[name](clock), clock.monotonic(), clock.utc(), AppOptions())


def row_with(text, word):
    return next(row for row in text.splitlines() if word in row)


@pytest.mark.parametrize("key", [None, "f2"])
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_skew_is_read_on_dashboard_and_control(size, key):
    text = run(read, "travler-skew", size, key=key)
    assert re.search(r"(skew|SK) +45\.00°", text), text
    assert "110.0" in text, "where it was sent"
    assert " < " in text
    assert " > " in text


@pytest.mark.parametrize("key", [None, "f2"])
@pytest.mark.parametrize("size", [*SIZES, (40, 12)], ids=str)
def test_a_dish_without_that_axis_shows_nothing_of_it(size, key):
    text = run(read, "idle", size, key=key if size[0] >= 80 else None)
    assert "skew" not in text.lower()
    assert "SK " not in text


def test_the_pocket_view_shows_angles_skew_stop_and_cable():
    text = run(read, "travler-slew", (40, 12), heard=False)
    for words in ("AZ~", "EL~", "skew~ 45.00°", "STOP takes 0.4 s", "cable 0°", "455°", "[S skew]", "S T O P"):
        assert words in text, text
    assert "H home" not in text


@pytest.mark.parametrize("glyphs", ["braille", "ascii"])
@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_modelled_position_is_told_by_a_sign_and_a_word(size, glyphs):
    for key in (None, "f2"):
        text = run(read, "travler-slew", size, key=key, glyphs=glyphs)
        assert "AZ~201.30" in text
        assert "EL~32.90" in text
        assert "modelled" in text
        if glyphs == "braille":
            assert "◎" in text
    still = run(read, "travler", size, glyphs=glyphs)
    assert "modelled" not in still
    assert "◎" not in still
    assert "AZ 189.16" in still


def test_a_silent_slew_is_not_taken_for_a_dish_that_owes_an_answer():
    clock = VirtualClock()
    state = stand_in.travler_slew(clock)
    view = View(state, clock.monotonic() + 30.0, clock.utc(), AppOptions(), watched=True)
    assert not view.late
    assert not view.stale
    assert view.position_age_s == pytest.approx(34.6), "its age is counted from the last reading"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("travler", "STOP holds it where it is"),
        ("travler-slew", "STOP takes 0.4 s"),
        ("travler-step", "STOP at end of move, 3 s"),
        ("travler-skew", "STOP at end of move, 5 s"),
        ("travler-search", "STOP ends the TV search"),
    ],
)
def test_what_stop_can_do_is_told(name, words):
    assert stop_text(view_of(name)) == words
    assert words in run(read, name, (120, 36)).replace("\n", "")


def test_turning_the_skew_is_told_with_its_own_way():
    assert motion_text(view_of("travler-skew")) == "SKEW 65.0° to go, 5.2 s"


@pytest.mark.parametrize(
    ("command", "reason"),
    [
        ("home", "homes only at power-up. Switch it off and on."),
        ("engage", "has no motor current command."),
        ("release-motors", "has no motor current command."),
        ("speeds", "no speed setting"),
        ("stow", "Stow is locked"),
    ],
)
def test_what_it_lacks_is_refused_with_the_reason(command, reason):
    assert reason in BY_NAME[command].refused(view_of("travler"))

    async def press(app, pilot):
        app.action_command(command)
        await pilot.pause()
        return stand_in.text_of(app), app.station.asked

    text, asked = run(press, "travler", (120, 36), key="f2")
    assert reason in text
    assert not [request for request in asked if isinstance(request, Home)]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_place_of_the_signal_is_not_left_empty(size):
    text = run(read, "travler", size, heard=False)
    assert "Nothing heard" not in text
    panes = "\n".join(row for row in text.splitlines() if "1 Dashboard" not in row)
    assert (panes != text) is (size[0] >= 100), "page names stand from 100x30 on"
    assert "Signal" not in panes
    assert "0..180°" in text or "180°" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_cable_of_an_unknown_turn_is_shaded_not_hatched(size):
    row = row_with(run(read, "travler", size), "turn unknown")
    assert re.search(r"cable 0°▕░+▏455° turn unknown", row)
    control = run(read, "travler", size, key="f2")
    assert "turn unknown: this dish doesn't report it" in control
    assert "+455°" in control
    assert "H homes" not in control


def test_elevation_goes_from_15_to_90():
    text = run(read, "travler", (120, 36), key="f2")
    assert re.search(r"ceiling +90\.0°", text)
    assert re.search(r"floor +15\.0°", text)


def test_a_running_search_says_which_key_ends_it_and_that_asks_first():
    async def end(app, pilot):
        before = stand_in.text_of(app)
        await pilot.press("K")
        await pilot.pause()
        asked = stand_in.text_of(app)
        assert not app.station.asked_for(SetSearch)
        await pilot.press("y")
        await pilot.pause()
        return before, asked, app.station.asked_for(SetSearch)

    before, asked, sent = run(end, "travler-search")
    assert "▲ TV SEARCH RUNNING" in before
    assert "K ends it until the next power-up" in before
    assert "starts again at each" in asked
    assert sent == [SetSearch("you", disabled=True)]


def test_the_search_of_a_g2_is_not_ended_by_that_key():
    assert "Setup (8), step 3" in BY_NAME["search"].refused(view_of("idle"))
    assert "The search has ended" in BY_NAME["search"].refused(view_of("travler"))


def test_a_dish_without_a_search_says_so_and_owes_nothing():
    view = view_of("idle")
    dish = replace(view.state.dish, search_switch=SearchSwitch.NEVER_SEARCHES, search_setting=None)
    view = replace(view, state=replace(view.state, dish=dish, search=TvSearch.NONE))
    assert BY_NAME["search"].refused(view) == "This dish has no TV search."
    assert [(ink, value) for ink, name, value in HealthPane.facts(view) if name == "TV search"] == [
        (("●", "good"), "none")
    ]


def test_an_unhomed_travler_is_sent_to_its_power_switch():
    ink, words = bad_day(view_of("travler-not-homed"))
    assert ink == "warn-row"
    assert "Switch it off and on: it homes by itself" in words
    assert "H home" not in words
    assert "Switch it off and on: it homes by itself" in BY_NAME["left"].refused(view_of("travler-not-homed"))


def test_keys_turn_the_skew_in_steps_from_where_it_was_sent_last():
    async def turn(app, pilot):
        for key in (*["greater_than_sign"] * 10, "minus", "less_than_sign"):
            await pilot.press(key)
        await pilot.pause()
        return app.station.asked_for(TurnSkew)

    asked = run(turn, "travler")
    assert [request.deg for request in asked] == [*range(46, 56), 54.5]


def test_a_step_ends_at_the_end_of_the_range():
    async def turn(app, pilot):
        for _ in range(4):
            await pilot.press("plus")
        for _ in range(20):
            await pilot.press("greater_than_sign")
        await pilot.pause()
        return app.station.asked_for(TurnSkew)

    assert run(turn, "travler")[-1].deg == 180.0


def test_the_keys_of_the_skew_do_nothing_on_a_g2_and_say_why():
    async def turn(app, pilot):
        await pilot.press("greater_than_sign")
        await pilot.pause()
        return stand_in.text_of(app), app.station.asked_for(TurnSkew)

    text, asked = run(turn, "idle")
    assert asked == []
    assert "has no skew axis" in text


@pytest.mark.parametrize(("typed", "deg"), [
    ("skew 12", 12.0), ("sk=12.5", 12.5), ("SKEW: 90°", 90.0), ("skew +5", 50.0), ("sk -5,5", 39.5), ("skew180", None),
    ("skew 180", 180.0), ("skew 181", None), ("skew", None), ("skew -46", None), ("skew 1 2", None),
])  # fmt: skip
def test_the_go_to_line_takes_the_skew(typed, deg):
    view = view_of("travler")
    if deg is None:
        ink, words = foretell(typed, view)
        assert ink == "warn", words
        assert words.startswith("▲ ")
    else:
        assert skew_of(typed, view) == deg
        assert foretell(typed, view) == ("text", foretell(typed, view)[1])
        assert f"skew {deg:.2f}°" in foretell(typed, view)[1]


def test_enter_in_the_go_to_line_turns_the_skew_and_nothing_else():
    async def turn(app, pilot):
        await pilot.press("S")
        await pilot.pause()
        await pilot.press("6", "0", "enter")
        await pilot.pause()
        return app.station.asked_for(TurnSkew), app.station.asked_for(Goto)

    assert run(turn, "travler") == ([TurnSkew(60.0, "you")], [])


def test_the_skew_is_not_offered_on_a_g2():
    assert foretell("skew 12", view_of("idle")) == ("warn", "▲ The Carryout G2 has no skew axis.")
    assert "skew" not in foretell("", view_of("idle"))[1]
    assert "skew 45" in foretell("", view_of("travler"))[1]


def test_while_held_no_skew_is_sent():
    async def turn(app, pilot):
        await pilot.press("greater_than_sign")
        await pilot.pause()
        return app.station.asked_for(TurnSkew)

    assert run(turn, "held", state={"dish": TRAVLER, "activity": Activity.IDLE}) == []


def test_the_end_of_a_motion_tells_the_skew_where_there_is_one():
    def end(position):
        return ended_text(MoveEnded(0.0, datetime.now(UTC), End.ARRIVED, "arrived", position))

    assert end(replace(view_of("travler-skew").state.position, skew_deg=46.0)).endswith(", skew 46.00°.")
    assert "skew" not in end(view_of("idle").state.position)


def test_the_opening_is_told_once():
    view = view_of("travler")
    opening = LinkState(LinkPhase.OPENING, detail="opening dish-1")
    text = bad_day_or_calm(View(replace(view.state, link=opening), view.now, view.utc, AppOptions()))
    assert text == "Opening dish-1 …"


def bad_day_or_calm(view):
    wrong = bad_day(view)
    return calm(view) if wrong is None else wrong[1]


@pytest.mark.parametrize(
    ("means", "confirmed", "words"),
    [
        ("end of move", None, "STOP waits for the end of this move"),
        ("abort", None, "STOP sent: not yet at rest"),
        ("end of move", False, "STOP not confirmed: use power switch"),
    ],
)
def test_a_dish_that_still_turns_after_stop_is_not_said_to_be_held(means, confirmed, words):
    view = view_of("travler")
    stopped = StopReport("you", view.now, means, confirmed, "A sentence.")
    state = replace(view.state, motion=None, activity=Activity.STOPPING, last_stop=stopped)
    assert stop_text(View(state, view.now, view.utc, AppOptions())) == words


def test_a_move_that_nothing_calls_back_is_not_said_to_have_been_sent_a_stop():
    view = view_of("travler")
    held = HeldState("you", view.now, view.utc, HeldReason.STOP)
    stopped = StopReport("you", view.now, "end of move", None, "A sentence.")
    state = replace(view.state, held=held, activity=Activity.STOPPING, last_stop=stopped)
    _ink, words = bad_day(View(state, view.now, view.utc, AppOptions()))
    assert "no STOP for this move: it ends by itself" in words
    assert "STOP sent" not in words
