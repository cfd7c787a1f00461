"""F8: what its keys do, and that nothing moves before a person said that it may."""

import asyncio
from dataclasses import replace

import pytest
import setup_stand_in
import stand_in
from birdcage.setup.case import Cause
from birdcage.setup.engine import CLEAR_QUESTION
from birdcage.setup.step import Choice, Field
from birdcage.station.requests import AcknowledgeFault, Goto, Home, Jog, Release
from birdcage.station.state import LinkPhase, LinkState
from birdcage_tui.setup.form import ChoiceButton
from birdcage_tui.setup.steps import StepsPane
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.status import BadDayRow
from burst import key_of, write
from setup_stage import press, run, settle
from textual.widgets import Input

MOTIONS = (Goto, Home, Jog)


def moved(app):
    return [request for request in app.station.asked if isinstance(request, MOTIONS)]


def test_before_the_first_motion_it_asks_and_no_means_that_nothing_happens():
    async def asked(app, pilot, engine):
        await press(app, pilot, "enter")
        assert isinstance(app.screen, QuestionScreen)
        assert " ".join(CLEAR_QUESTION.split())[:40] in " ".join(stand_in.text_of(app).split())
        assert engine.asked == []
        await press(app, pilot, "n")
        assert engine.asked == []
        assert not engine.area_clear
        await press(app, pilot, "enter")
        await press(app, pilot, "enter")
        assert engine.asked == [], "Enter in the question does nothing"
        await press(app, pilot, "enter")
        await press(app, pilot, "y")
        assert engine.asked == [("home", "home", {})]
        await press(app, pilot, "enter")
        assert engine.asked == [("home", "home", {})] * 2, "it is asked once"

    run(asked)


def test_choices_by_letter_digit_and_mouse():
    async def choose(app, pilot, engine):
        await press(app, pilot, "1")
        assert engine.asked == [("feed", "feed-1", {})]
        await press(app, pilot, "enter")
        assert engine.asked[1:] == [("feed", "stock", {})]
        button = next(button for button in app.query(ChoiceButton) if button.choice.name == "stock")
        await pilot.click(button)
        assert engine.asked[2:] == [("feed", "stock", {})]
        assert app.page.scope == "setup", "its digit is the step's, not a page's"

    run(choose, "feed")


def test_typed_values_reach_the_engine_and_no_field_has_the_focus_on_arrival():
    async def typed(app, pilot, engine):
        assert isinstance(app.focused, StepsPane)
        await press(app, pilot, "enter")
        assert isinstance(app.focused, Input)
        await press(app, pilot, *"1.5", "enter")
        assert engine.asked == [], "the other field is still empty"
        await press(app, pilot, *"-2", "enter")
        assert engine.asked == [("level", "typed", {"pitch_deg": "1.5", "roll_deg": "-2"})]
        assert isinstance(app.focused, StepsPane)

    run(typed, "level")


def test_keys_typed_into_a_field_are_no_commands():
    async def typed(app, pilot, engine):
        await press(app, pilot, "o")
        await press(app, pilot, *"bsow 1")
        assert app.focused.value == "bsow 1"
        assert engine.asked == []
        await press(app, pilot, "escape")
        assert isinstance(app.focused, StepsPane)
        await press(app, pilot, "b")
        assert engine.asked == [("back",)]

    run(typed, "feed")


def test_what_is_typed_stays_while_words_change_every_second():
    async def typed(app, pilot, engine):
        await press(app, pilot, "t", *"12")
        focused = app.focused
        for second in range(3):
            choices = engine.steps()[9].choices
            mark = replace(choices[0], label=f"The dish looks at the Sun now: {189 + second}°")
            engine.change("north", choices=(mark, choices[1]), words=(f"Sun now at {189 + second}°.",))
            await settle(app, pilot)
        assert app.focused is focused
        assert focused.value == "12"
        assert "Sun now: 191°" in stand_in.text_of(app)

    run(typed, "north")


def test_a_refusal_is_told_in_its_own_words():
    async def refused(app, pilot, engine):
        engine.refusal = "pitch: '1.5x' is not a number."
        await press(app, pilot, "enter", *"1.5x", "enter", "2", "enter")
        text = stand_in.text_of(app)
        assert "▲ pitch: '1.5x' is not a number." in text
        assert isinstance(app.focused, Input), "to be mended where it stands"

    run(refused, "level")


@pytest.mark.parametrize("key", ["h", "j", "k", "l", "left", "right", "up", "down", "plus", "minus"])
def test_no_key_jogs(key):
    async def jog(app, pilot, engine):
        await press(app, pilot, *[key] * 3)
        return moved(app), engine.asked

    assert run(jog, "link") == ([], [])


def test_arrows_look_at_other_steps_and_enter_goes_there():
    async def look(app, pilot, engine):
        await press(app, pilot, "down", "down")
        text = stand_in.text_of(app)
        assert "Does your coax, a wall or the tripod" in text
        assert "Go to this step" in text
        assert "Homing can't be stopped" not in text
        assert engine.asked == []
        await press(app, pilot, "enter")
        assert engine.asked == [("go", "limits")]
        assert "Take the limits as they are" in stand_in.text_of(app)
        await press(app, pilot, "s")
        assert engine.asked[1:] == [("skip", "limits")]

    run(look)


def test_a_click_looks_at_a_step():
    async def click(app, pilot, engine):
        await pilot.click("#setup-steps", offset=(8, 1))
        await settle(app, pilot)
        return stand_in.text_of(app)

    assert "Asking the dish." in run(click)


def test_o_opens_the_page_of_the_step_or_says_that_there_is_none():
    async def page(app, pilot, engine):
        await press(app, pilot, "o")
        await settle(app, pilot)
        return app.page.scope

    assert run(page, "home") == "control"

    async def none(app, pilot, engine):
        await press(app, pilot, "o")
        return app.page.scope, stand_in.text_of(app)

    where, text = run(none, "limits")
    assert where == "setup"
    assert "no separate page" in text


@pytest.mark.parametrize(("state", "kind"), [("held", Release), ("fault", AcknowledgeFault)])
def test_enter_releases_first_and_so_does_the_row(state, kind):
    async def enter(app, pilot, engine):
        await press(app, pilot, "enter")
        assert len(app.station.asked_for(kind)) == 1
        assert engine.asked == []
        assert len(app.screen_stack) == 1
        await pilot.mouse_down(BadDayRow)
        await pilot.pause()
        assert len(app.station.asked_for(kind)) == 2

    run(enter, state=state)


def test_work_under_way_is_told_with_its_time():
    async def wait(app, pilot, engine):
        app.session.clock.advance(7.0)
        await settle(app, pilot)
        text = stand_in.text_of(app)
        assert "◌ homing; cut the 12 V to stop it  00:07" in text
        await press(app, pilot, "enter")
        assert engine.asked == []
        assert "Wait: homing" in stand_in.text_of(app)

    run(wait, "busy")


def test_go_to_asks_whether_the_area_is_clear_first():
    async def goto(app, pilot, engine):
        await press(app, pilot, "g")
        assert isinstance(app.screen, QuestionScreen)
        await press(app, pilot, "n", "g")
        await press(app, pilot, "y")
        assert isinstance(app.focused, Input)
        await press(app, pilot, *"180 45", "enter")
        return app.station.asked_for(Goto)

    assert run(goto) == [Goto(180.0, 45.0, "you")]


def test_the_page_follows_the_engine_to_its_next_step():
    async def follow(app, pilot, engine):
        engine.change("home", mark=setup_stand_in.DONE, evidence="homed, now at AZ 0.00 EL 65.00")
        engine.current = "feed"
        ticks = engine.ticks
        await settle(app, pilot)
        assert engine.ticks > ticks, "each frame lets the engine go on"
        text = stand_in.text_of(app)
        assert "✓ 4  Home" in text
        assert "▶ ○ 5  Feed" in text
        assert "Which feed is fitted?" in text

    run(follow, size=(120, 36))


def test_what_is_under_way_goes_on_behind_another_page():
    async def hide(app, pilot, engine):
        page = app.page
        await press(app, pilot, "f1")
        await settle(app, pilot)
        assert app.page is not page
        ticks = engine.ticks
        app.paint()
        assert engine.ticks == ticks, "a hidden page draws nothing"
        page.go_on()
        assert engine.ticks == ticks + 1
        engine.change("home", busy="")
        page.go_on()
        page.go_on()
        assert engine.ticks == ticks + 2, "nothing is under way any more"

    run(hide, "busy")


def test_other_pages_learn_the_place_from_the_setup():
    async def place(app, pilot, engine):
        engine.settings = replace(
            engine.settings, place=replace(engine.settings.place, latitude_deg=52.1, longitude_deg=5.2, name="JO22")
        )
        await settle(app, pilot)
        return app.settings.place

    where = run(place)
    assert (where.latitude_deg, where.longitude_deg, where.name) == (52.1, 5.2, "JO22")


def test_a_cause_that_another_speed_mends_offers_that_speed():
    async def use(app, pilot, engine):
        cause = Cause("Wrong baud rate", "At 9600 baud came text.", "Use 9600 baud.", likely=True, use_baud=9600)
        engine._causes = (cause,)
        await settle(app, pilot)
        assert "Use 9600 baud" in stand_in.text_of(app)
        await press(app, pilot, "u")
        return engine.asked

    assert run(use, "mute", "silent") == [("link", "other", {"port": "/dev/ttyUSB0", "baud": "9600"})]


@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
def test_a_letter_that_would_turn_the_dish_far_selects_its_answer_and_enter_gives_it(size):
    async def again(app, pilot, engine):
        engine.area_clear = True
        engine.change("home", choices=(Choice("home", "h", "Home again", moves=True, far=True),))
        await settle(app, pilot)
        await press(app, pilot, "h")
        before, text = list(engine.asked), stand_in.text_of(app)
        await press(app, pilot, "enter")
        return before, text, engine.asked

    before, text, asked = run(again, size=size)
    assert before == []
    assert "Enter: Home again. Nothing moves before." in text
    assert asked == [("home", "home", {})]


def test_without_a_port_it_says_so_and_blames_nothing():
    async def none(app, pilot, engine):
        state = app.station.state
        app.station.state = replace(state, port="", link=LinkState(LinkPhase.LOST, detail="No port is set."))
        await settle(app, pilot)
        return stand_in.text_of(app)

    text = run(none, "mute", "silent")
    assert "○ NO PORT  No port is set." in text
    assert "What may be wrong" not in text
    assert "Type a port" in text


def test_an_app_without_a_setup_says_so_and_crashes_on_no_key():
    async def body():
        app = stand_in.app_in("idle", setup=None, first_page="setup")
        async with app.run_test(size=(80, 24)) as pilot:
            await settle(app, pilot)
            await settle(app, pilot)
            text = stand_in.text_of(app)
            await press(app, pilot, "enter", "s", "b", "down", "w", "w", "o", "escape")
            return text, moved(app)

    text, motions = asyncio.run(body())
    assert "Use `birdcage setup` in a terminal." in " ".join(text.replace("│", " ").split())
    assert motions == []


def test_while_it_listens_the_causes_stay_as_they_were():
    async def listen(app, pilot, engine):
        before = stand_in.text_of(app)
        engine.change("link", busy="listening at several speeds", choices=())
        engine._causes = ()
        await settle(app, pilot)
        return before, stand_in.text_of(app)

    before, after = run(listen, "mute", "silent", size=(120, 36))
    assert "What may be wrong" in before
    assert "What may be wrong" in after
    assert "Seen: 57600: 34 bytes" in after


def test_enter_takes_the_step_s_own_release_and_does_not_only_acknowledge():
    async def go_on(app, pilot, engine):
        engine.change("home", choices=(Choice("release", "enter", "I did that: go on"),))
        await settle(app, pilot)
        text = stand_in.text_of(app)
        await press(app, pilot, "enter")
        return text, engine.asked

    text, asked = run(go_on, "home", "fault")
    assert asked == [("home", "release", {})]
    assert "Enter acknowledges the fault first" not in text


def test_an_enter_that_stop_has_overtaken_takes_no_release_of_a_step():
    async def look(app, pilot, engine):
        engine.change("home", choices=(Choice("release", "enter", "I did that: go on"),))
        await settle(app, pilot)
        keys, deal = app.keys, app.keys._deal

        async def overtaken(key):
            keys.read(key_of("ctrl+c"))
            await deal(key)

        keys._deal = overtaken
        write(app, "enter")
        await settle(app, pilot)
        return app.station.stops, engine.asked

    assert run(look, state="held") == (["you"], [])


def test_enter_in_a_field_that_may_stay_empty_sends_what_was_typed_before_it():
    hint = "empty: the dish's own"
    fields = tuple(Field(name, name, "deg", hint) for name in ("floor", "ceiling", "cable_min", "cable_max"))

    async def narrow(app, pilot, engine):
        engine.change("limits", choices=(Choice("own", "n", "Narrow them", fields=fields),))
        await settle(app, pilot)
        await press(app, pilot, "n", "2", "5", "enter")
        assert engine.asked == []
        assert app.screen.focused.name == "own/ceiling"
        await press(app, pilot, "enter")
        return engine.asked

    assert run(narrow, "limits") == [
        ("limits", "own", {"floor": "25", "ceiling": "", "cable_min": "", "cable_max": ""})
    ]  # fmt: skip


def test_another_firmware_that_was_chosen_ends_the_app_so_that_it_begins_anew():
    async def chosen(app, pilot, engine):
        assert app.ending.anew is None
        engine.begin_anew = "hal205"
        await settle(app, pilot)
        return app.ending.anew, app._exit, app.station.stops

    assert run(chosen) == (1, True, [])
