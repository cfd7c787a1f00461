"""F2, what hands do: steps are steps, questions name consequences, STOP is everywhere."""

from dataclasses import replace
from functools import partial
from types import MappingProxyType

import pytest
import stage
import stand_in
from birdcage.rotator.feature import Reading
from birdcage.station.requests import Engage, Goto, Home, Jog, Release, ReleaseMotors, SetSpeed, Stow
from birdcage_tui.commands import BY_NAME
from birdcage_tui.control.nudge import AT, STEPS, DigitsPane
from stage import read
from textual.widgets import Input, Static

SIZES = [(80, 24), (100, 30), (120, 36), (160, 48), (200, 60)]

run = partial(stage.run, key="f2")


@pytest.mark.parametrize("key", ["left", "h"])
def test_ten_presses_are_ten_steps(key):
    async def jog(app, pilot):
        await pilot.press("minus", "minus", *[key] * 10)
        return app.station.asked_for(Jog)

    assert run(jog) == [Jog(-0.2, 0.0, "you")] * 10


@pytest.mark.parametrize(
    ("command", "asked"),
    [
        ("left", Jog(-1.0, 0.0, "you")),
        ("right", Jog(1.0, 0.0, "you")),
        ("up", Jog(0.0, 1.0, "you")),
        ("down", Jog(0.0, -1.0, "you")),
    ],
)
def test_the_arrows_on_the_page_step_too(command, asked):
    async def click(app, pilot):
        pane = app.query_one("#jog")
        spot = next(region for region, name in pane.hot if name == command)
        await pilot.click(pane, offset=(spot.x + 1, spot.y))
        await pilot.pause()
        return app.station.asked_for(Jog)

    assert run(click) == [asked]


@pytest.mark.parametrize("digit", range(8))
def test_each_digit_is_nudged_by_its_own_size(digit):
    async def nudge(app, pilot):
        await pilot.press("tab")
        assert isinstance(app.focused, DigitsPane)
        await pilot.press(*["left"] * 8, *["l"] * digit, "up", "k", "down", "j")
        return app.station.asked_for(Jog)

    d_az, d_el = STEPS[digit]
    assert run(nudge) == [Jog(sign * d_az, sign * d_el, "you") for sign in (1, 1, -1, -1)]
    assert max(d_az, d_el) <= 10.0, "no single key moves further than the largest step"


def test_sizes_of_digits_are_those_of_the_places_they_stand_at():
    for place, (d_az, d_el) in zip(AT, STEPS, strict=True):
        digits = "100.00" if d_az else "10.00"
        ones = digits.index(".") - 1
        power = ones - place if place <= ones else ones - place + 1
        assert max(d_az, d_el) == pytest.approx(10.0**power)


@pytest.mark.parametrize(("row", "sign"), [(0, 1.0), (2, -1.0)])
def test_a_click_above_or_below_a_digit_nudges_it(row, sign):
    async def click(app, pilot):
        pane = app.query_one(DigitsPane)
        for digit in (2, 7):
            await pilot.click(pane, offset=(pane._columns[digit], row))
            await pilot.pause()
        await pilot.click(pane, offset=(pane._columns[0], 1))
        await pilot.pause()
        return app.station.asked_for(Jog), pane.cursor

    assert run(click) == ([Jog(sign * 0.1, 0.0, "you"), Jog(0.0, sign * 0.01, "you")], 0)


def test_the_cursor_is_seen_only_while_the_digits_have_the_focus():
    async def look(app, pilot):
        pane = app.query_one(DigitsPane)

        def reversed_cells():
            return [s.text for s in pane._strips[1] if s.style == pane.inks["accent-row"]]

        before = reversed_cells()
        await pilot.press("n", "right")
        await pilot.pause()
        during = reversed_cells()
        await pilot.press("shift+tab")
        await pilot.pause()
        return before, during, reversed_cells()

    assert run(look) == ([], ["1"], [])


@pytest.mark.parametrize("name", ["held", "lost", "not-homed", "fault", "refused", "opening"])
def test_nothing_is_nudged_when_the_dish_cannot_take_it(name):
    async def nudge(app, pilot):
        await pilot.press("n", "up", "p", "shift+tab", "up")
        return [type(r).__name__ for r in app.station.asked]

    assert not {"Jog", "Goto"} & set(run(nudge, name))


QUESTIONS = [
    ("H", Home("you"), "runs into its end stops"),
    ("E", Engage("you"), "switches the motor current on"),
    ("R", ReleaseMotors("you"), "may fall under its own weight"),
    ("R", ReleaseMotors("you"), "position is unknown afterwards"),
    ("W", Stow("you"), "crushes whatever is mounted in place of the stock feed"),
]


@pytest.mark.parametrize(("key", "request_", "consequence"), QUESTIONS)
@pytest.mark.parametrize("answer", ["y", "enter", "escape", "n"])
def test_each_is_asked_for_in_words_and_done_only_by_y(key, request_, consequence, answer):
    async def ask(app, pilot):
        await pilot.press(key)
        await pilot.pause()
        words = " ".join(str(each.render()) for each in app.screen.query(Static))
        await pilot.press(answer)
        await pilot.pause()
        return " ".join(words.split()), app.station.asked_for(type(request_))

    words, asked = run(ask, state={"stow_allowed": True})
    assert consequence in words
    assert asked == ([request_] if answer == "y" else [])


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_stow_is_grey_unless_the_feed_allows_it(size):
    async def press(app, pilot):
        pane = app.query_one("#actions")
        style = next(s.style for strip in pane._strips for s in strip if "stow" in s.text)
        await pilot.press("W")
        await pilot.pause()
        return style == pane.inks["bar-dim"], len(app.screen_stack), stand_in.text_of(app)

    dim, screens, text = run(press, size=size)
    assert dim
    assert screens == 1
    assert "Stow is locked by the feed Ku LNB." in text
    assert run(press, size=size, state={"stow_allowed": True})[:2] == (False, 2)


def without(**lacking):
    return {"dish": replace(stand_in.CARRYOUT_G2, **lacking)}


@pytest.mark.parametrize(
    ("key", "lacking", "says"),
    [
        ("W", {"has_stow": False}, "has no stow"),
        ("v", {"features": {}}, "This dish has no speed setting."),
        ("R", {"has_motor_power": False}, "has no motor current command."),
        ("H", {"homing_s": None}, "homes only at power-up. Switch it off and on."),
    ],
)
def test_what_a_dish_lacks_says_so(key, lacking, says):
    async def press(app, pilot):
        await pilot.press(key)
        await pilot.pause()
        return len(app.screen_stack), stand_in.text_of(app)

    screens, text = run(press, state={"stow_allowed": True, **without(**lacking)})
    assert screens == 1
    assert says in text


def test_no_speed_setting_is_said_on_the_page():
    assert "dish has no speed setting" in run(read, state=without(features={}))
    assert "this dish has no speed setting" in run(read, size=(120, 36), state=without(features={}))


@pytest.mark.parametrize(("name", "says"), [("held", "STOP is latched"), ("lost", "does not answer")])
@pytest.mark.parametrize("key", ["E", "W"])
def test_what_moves_the_dish_is_not_even_asked_for_while_held_or_lost(key, name, says):
    async def press(app, pilot):
        await pilot.press(key)
        await pilot.pause()
        return len(app.screen_stack), app.view().note

    screens, note = run(press, name, state={"stow_allowed": True})
    assert screens == 1
    assert says in note


@pytest.mark.parametrize(
    ("name", "allowed", "says"),
    [
        ("held", False, "Stow is locked by the feed Ku LNB."),
        ("fault", False, "Stow is locked by the feed Ku LNB."),
        ("fault", True, "A fault waits"),
        ("not-homed", True, "Home it first"),
        ("refused", True, "birdcage.toml line 7"),
        ("idle", True, None),
    ],
)
def test_what_forbids_stow_for_good_is_said_before_what_enter_mends(name, allowed, says):
    async def ask(app, pilot):
        return BY_NAME["stow"].refused(app.view())

    reason = run(ask, name, state={"stow_allowed": allowed})
    assert reason is None if says is None else says in reason


def test_motors_may_be_released_while_held():
    async def ask(app, pilot):
        await pilot.press("R")
        await pilot.pause()
        await pilot.press("y")
        await pilot.pause()
        return app.station.asked_for(ReleaseMotors)

    assert run(ask, "held") == [ReleaseMotors("you")]


def speeds():
    clock = stand_in.VirtualClock()
    readings = {
        f"speed.{axis}": Reading(speed, "deg/s", 0.0, clock.utc())
        for axis, speed in (("azimuth", 40.0), ("elevation", 39.0))
    }
    return {"readings": MappingProxyType(readings)}


def test_speeds_are_shown_as_read_and_as_dashes_before():
    assert "speed --.-/--.- °/s" in run(read)
    assert "speed 40.0/39.0 °/s" in run(read, state=speeds())


@pytest.mark.parametrize(
    ("typed", "asked", "says"),
    [
        ("30,5", [SetSpeed(0, 30.5, "you")], ""),
        ("9999", [], "type 0.1 to"),
        ("0", [], "type 0.1 to"),
        ("fast", [], "type 0.1 to"),
        ("nan", [], "type 0.1 to"),
        ("40", [], ""),
        ("", [], ""),
    ],
)
def test_a_speed_out_of_range_is_told_its_range(typed, asked, says):
    async def change(app, pilot):
        await pilot.press("v")
        await pilot.pause()
        app.screen.query(Input).first().value = typed
        await pilot.press("enter")
        await pilot.pause()
        return app.station.asked_for(SetSpeed), stand_in.text_of(app), len(app.screen_stack)

    found, text, screens = run(change, state=speeds())
    assert found == asked
    assert says in text
    assert screens == (2 if says else 1)


def test_enter_releases_what_is_held_even_in_the_list(kept):
    async def enter(app, pilot):
        await pilot.press("p", "enter")
        return app.station.asked_for(Release), app.station.asked_for(Goto)

    assert run(enter, "held", presets_file=kept) == ([Release("you")], [])


def test_help_speaks_of_what_has_the_focus(kept):
    async def ask(app, pilot):
        await pilot.press("p", "question_mark")
        await pilot.pause()
        return " ".join(stand_in.text_of(app).split())

    assert "Enter turns the dish there" in run(ask, size=(160, 60), presets_file=kept)


def test_esc_leads_from_the_digits_back_to_the_rose():
    async def leave(app, pilot):
        await pilot.press("n")
        before = app.focused.id
        await pilot.press("escape")
        return before, app.focused.id

    assert run(leave) == ("digits", "rose")


@pytest.mark.parametrize(
    ("keys", "hint"),
    [
        ([], "Arrows or hjkl step 1°"),
        (["n"], "← → select a digit of the target"),
        (["p"], "Enter turns the dish there"),
    ],
)
def test_the_last_row_says_what_the_arrows_do_where_the_focus_is(keys, hint):
    async def read(app, pilot):
        await pilot.press(*keys)
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app).splitlines()[-2]

    assert hint in run(read)
