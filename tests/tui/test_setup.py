"""F8: what is seen of the setup, what its keys do, and that nothing moves before a person said that it may."""

import asyncio
from dataclasses import replace

import pytest
import setup_stand_in
import stand_in
from birdcage.setup.engine import CLEAR_QUESTION
from birdcage.station.requests import AcknowledgeFault, Goto, Home, Jog, Release
from birdcage_tui.dialogs import QuestionScreen
from birdcage_tui.footer import KeyBar
from birdcage_tui.pages.setup import SetupPage
from birdcage_tui.setup.extra import ExtraPane
from birdcage_tui.setup.fold import fold
from birdcage_tui.setup.form import AnswerForm, ChoiceButton
from birdcage_tui.setup.steps import StepsPane
from birdcage_tui.setup.words import StepWords
from birdcage_tui.status import BadDayRow, StatusLine, StopButton
from textual.widgets import Input

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]
MOTIONS = (Goto, Home, Jog)


def run(test, engine="home", state="idle", size=(80, 24), **options):
    async def body():
        made = setup_stand_in.ENGINES[engine]()
        app = stand_in.app_in(state, setup=lambda: made, first_page="setup", **options)
        async with app.run_test(size=size) as pilot:
            await settle(app, pilot)
            return await test(app, pilot, made)

    return asyncio.run(body())


async def settle(app, pilot):
    """Wait until the layout has followed what is shown."""
    for _ in range(4):
        await pilot.pause()
        app.paint()
    await pilot.pause()


async def press(app, pilot, *keys):
    await pilot.press(*keys)
    await settle(app, pilot)


async def read(app, pilot, engine):
    return stand_in.text_of(app)


def moved(app):
    return [request for request in app.station.asked if isinstance(request, MOTIONS)]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_eleven_steps_are_told_with_mark_title_and_evidence(size):
    text = run(read, size=size)
    for step in setup_stand_in.STEPS:
        assert f"{step.number:<2} {step.title}" in text
    for words in ("✓ 1  Link", "▶ 4  Home", "– 8  Level", "… 11 First", "ttyUSB0, FTDI, 115200 8N1"):
        assert words in text
    assert "Homing cannot be stopped from here" in text
    assert "Area is clear: home" in text
    assert "▲ moves the dish" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("engine", setup_stand_in.ENGINES)
def test_what_a_person_needs_is_inside_the_screen(engine, size):
    state = "silent" if engine == "mute" else "idle"

    async def regions(app, pilot, made):
        page = app.query_one(SetupPage)
        kinds = [StatusLine, StopButton, BadDayRow, KeyBar, SetupPage, StepWords]
        parts = [app.query_one(kind) for kind in kinds]
        parts += [*page.query(ChoiceButton), *page.query(Input), page.query_one("#setup-steps")]
        if page.query_one("#setup-rest").display:
            parts.append(page.query_one("#setup-rest"))
        if page.query_one(ExtraPane).display and engine == "mute":
            parts.append(page.query_one(ExtraPane))
        step = page.query_one("#setup-step")
        for part in parts:
            assert part.region.area > 0, part
            assert app.screen.region.contains_region(part.region), f"{part} {part.region}"
            if step in part.ancestors:
                assert step.region.contains_region(part.region), f"{part} {part.region} is outside {step.region}"
        for number, part in enumerate(parts[6:]):
            for other in parts[6:][number + 1 :]:
                assert not part.region.overlaps(other.region), f"{part} lies over {other}"
        shown = made.steps()[[step.name for step in made.steps()].index(made.current)]
        assert len(page.query(ChoiceButton)) == len(shown.choices) or engine == "mute"
        for button in page.query(ChoiceButton):
            assert button.region.width == button.styles.width.value, "no choice is cut off"

    run(regions, engine, state, size)


def test_the_list_folds_around_the_step_that_is_looked_at():
    assert [(row.first, row.last) for row in fold(11, 0, 3)] == [(0, 0), (1, 1), (2, 10)]
    assert [(row.first, row.last) for row in fold(11, 10, 3)] == [(0, 8), (9, 9), (10, 10)]
    assert [(row.first, row.last) for row in fold(11, 5, 3)] == [(0, 4), (5, 5), (6, 10)]
    assert [(row.first, row.last) for row in fold(11, 3, 11)] == [(index, index) for index in range(11)]
    for looked in range(11):
        for room in range(3, 12):
            rows = fold(11, looked, room)
            assert len(rows) <= room
            assert [index for row in rows for index in range(row.first, row.last + 1)] == list(range(11))
            assert any(row.single and row.first == looked for row in rows)


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
        engine.refusal = "pitch: '1.5x' is no number."
        await press(app, pilot, "enter", *"1.5x", "enter", "2", "enter")
        text = stand_in.text_of(app)
        assert "▲ pitch: '1.5x' is no number." in text
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
        assert "Make this the present step" in text
        assert "Homing cannot be stopped" not in text
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
    assert "no page of its own" in text


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


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_mute_port_walks_through_the_causes(size):
    async def walk(app, pilot, engine):
        text = stand_in.text_of(app)
        flat = " ".join(text.replace("│", " ").split())
        for words in (
            "57600: 34 bytes, garbage", "115200: silence", "9600: own echo", "1/7 You may not open it",
            "sudo usermod -aG dialout $USER", "2/7 Wrong baud rate", "ModemManager", "brltty", "Look at other speeds",
        ):  # fmt: skip
            assert words in flat, words
        assert flat.count("57600: 34 bytes, garbage") == 1
        await press(app, pilot, "right", "right")
        flat = " ".join(stand_in.text_of(app).replace("│", " ").split())
        assert "Swap the two wires of the receiving pair" in flat
        await press(app, pilot, "left")
        assert app.page.chosen == 1
        await press(app, pilot, "p")
        assert engine.asked == [("link", "probe", {})]

    run(walk, "mute", "silent", size)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_w_draws_the_plug_and_w_puts_it_away(size):
    async def wiring(app, pilot, engine):
        await press(app, pilot, "w")
        text = stand_in.text_of(app)
        for words in ("Carryout G2", "RJ-12", "1 ╪══ white  GND", "3 ╪══ red    TX+", "clip pointed away", "TA"):
            assert words.lower() in text.lower(), words
        for _ in range(12):
            await press(app, pilot, "down")
        if size == (80, 24):
            seen = stand_in.text_of(app)
            assert "Source" in seen or "Sources" in seen or "winegard-sky-scan" in seen, "it scrolls to its end"
        await press(app, pilot, "escape")
        return stand_in.text_of(app)

    assert "Area is clear: home" in run(wiring, size=size)[:] or size != (80, 24)


def test_a_finished_setup_says_so_and_what_comes_next():
    async def done(app, pilot, engine):
        text = " ".join(stand_in.text_of(app).replace("│", " ").split())
        assert "Setup is finished" in text
        assert "after each power-up" in text.lower()
        assert text.count("as answered") >= 4

    for size in SIZES:
        run(done, "finished", size=size)


@pytest.mark.parametrize("engine", ["home", "feed", "place", "mute"])
@pytest.mark.parametrize("key", ["space", "ctrl+c"])
def test_stop_from_everything_that_takes_the_focus(engine, key):
    async def stop(app, pilot, made):
        widgets = [None, *(widget for widget in app.screen.query("*") if widget.focusable)]
        assert any(isinstance(widget, ChoiceButton) for widget in widgets)
        stops = 0
        for widget in widgets:
            app.set_focus(widget)
            await pilot.press(key)
            typed = key == "space" and isinstance(widget, Input)
            stops += not typed
            assert len(app.station.stops) == stops, widget
        assert made.asked == []

    run(stop, engine, "slewing")


@pytest.mark.parametrize("key", ["space", "ctrl+c"])
def test_stop_in_the_question(key):
    async def stop(app, pilot, engine):
        await press(app, pilot, "enter")
        assert isinstance(app.screen, QuestionScreen)
        await pilot.press(key)
        assert app.station.stops == ["you"]
        assert engine.asked == []

    run(stop)


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
        await settle(app, pilot)
        text = stand_in.text_of(app)
        assert "✓ 4  Home" in text
        assert "▶ 5  Feed" in text
        assert "What hangs in the focus?" in text

    run(follow)


def test_other_pages_learn_the_place_from_the_setup():
    async def place(app, pilot, engine):
        engine.settings = replace(
            engine.settings, place=replace(engine.settings.place, latitude_deg=52.1, longitude_deg=5.2, name="JO22")
        )
        await settle(app, pilot)
        return app.settings.place

    where = run(place)
    assert (where.latitude_deg, where.longitude_deg, where.name) == (52.1, 5.2, "JO22")


def test_the_form_has_a_row_for_all_it_asks():
    async def rows(app, pilot, engine):
        return app.query_one(AnswerForm).rows, len(app.query(".answers"))

    wanted, made = run(rows, "feed")
    assert wanted == made >= 4
