"""The one table: no key means two things in one place, and what a page does is done there."""

import pytest
import stand_in
from birdcage.station.requests import Jog
from birdcage_tui.commands import COMMANDS, PAGES, for_key, in_force
from birdcage_tui.commands.jog import STEPS_DEG
from birdcage_tui.shell.live_context import LiveContext
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.help import HelpScreen
from birdcage_tui.widgets.jump import targets
from stage import run, run_each
from textual.widgets import ContentSwitcher, OptionList


def test_no_key_means_two_things_in_one_scope():
    taken = {}
    for command in COMMANDS:
        for scope in command.where or ("everywhere",):
            for key in command.keys:
                assert (scope, key) not in taken, f"{key}: {command.name} and {taken[scope, key]}"
                taken[scope, key] = command.name


def test_space_ctrl_c_and_esc_belong_to_stop_alone():
    for command in COMMANDS:
        assert not {"space", "ctrl+c", "escape"} & set(command.keys), command.name


def test_safety_stands_first_and_jog_keys_hold_where_the_dish_is_shown():
    assert in_force(["control"])[0].name == "stop"
    assert for_key("l", ["dashboard"]).name == "right"
    assert for_key("l", ["camera"]) is None


def test_what_a_frame_dims_is_what_its_key_is_refused_for():
    async def judge(app, pilot):
        view, live = app.view(), LiveContext(app.station.state, app)
        return [(command.refused(view), command.refused(live)) for command in COMMANDS]

    for judged in run_each(judge).values():
        assert [dimmed for dimmed, _ in judged] == [refused for _, refused in judged]


@pytest.mark.parametrize("key", ["left", "h"])
def test_ten_presses_of_a_jog_key_are_ten_steps(key):
    async def jog(app, pilot):
        await pilot.press("minus", *[key] * 10)
        return app.station.asked_for(Jog)

    asked = run(jog)
    assert [(jog.d_az_deg, jog.d_el_deg) for jog in asked] == [(-0.5, 0.0)] * 10


def test_the_step_goes_from_a_hundredth_to_ten_degrees_and_no_further():
    async def change(app, pilot):
        await pilot.press(*["minus"] * 8)
        small = app.motions.step_deg
        await pilot.press(*["plus"] * 12)
        return small, app.motions.step_deg

    assert run(change) == (STEPS_DEG[0], STEPS_DEG[-1]) == (0.01, 10.0)


def test_help_does_what_is_chosen():
    async def choose(app, pilot):
        await pilot.press("question_mark")
        await pilot.pause()
        rows = app.screen.query_one(OptionList)
        rows.highlighted = rows.get_option_index("page-system")
        await pilot.press("enter")
        await pilot.pause()
        await pilot.pause()
        return app.query_one("#pages", ContentSwitcher).current

    assert run(choose) == "page-system"


def test_jump_reaches_every_control_on_the_screen():
    async def jump(app, pilot):
        app.paint()
        places = targets(app.screen)
        assert {place.command for place in places} >= {"goto", "help", "home"}
        letter = next(place.label for place in places if place.command == "help")
        await pilot.press("semicolon")
        await pilot.pause()
        shown = stand_in.text_of(app)
        await pilot.press(letter)
        await pilot.pause()
        await pilot.pause()
        return shown, letter, stand_in.text_of(app)

    shown, letter, text = run(jump)
    assert f" {letter} " in shown.splitlines()[-1]
    assert "Help" in text


@pytest.mark.parametrize("size", [(80, 24), (100, 30), (160, 48)], ids=str)
def test_every_control_has_a_label_of_its_own_also_where_the_letters_run_out(size):
    async def jump(app, pilot):
        places = targets(app.screen)
        keys = next(bar for bar in app.screen.query(KeyBar))
        footer = [place for place in places if place.widget is keys]
        assert {command for _, command in keys.hot} == {place.command for place in footer}, "all of the last row"
        label = next(place.label for place in footer if place.command == "help")
        await pilot.press("semicolon")
        await pilot.pause()
        await pilot.press(*label)
        await pilot.pause()
        await pilot.pause()
        return [place.label for place in places], isinstance(app.screen, HelpScreen)

    names, is_open = run(jump, size=size, key="f2")
    assert size == (80, 24) or len(names) > 26
    assert not [each for each in names if not each.isalpha()], "a digit is the key of another page"
    assert len(set(names)) == len(names)
    assert not [one for one in names for other in names if one != other and other.startswith(one)]
    assert is_open


def test_the_second_letter_of_a_label_is_waited_for_and_the_rest_go():
    async def half(app, pilot):
        label = next(place.label for place in targets(app.screen) if len(place.label) == 2)
        await pilot.press("semicolon")
        await pilot.pause()
        await pilot.press(label[0])
        await pilot.pause()
        shown = [part.name for part in app.screen.query(".jump") if part.display]
        await pilot.press("semicolon")
        await pilot.pause()
        return label, shown, len(app.screen_stack)

    label, shown, layers = run(half, size=(160, 48), key="f2")
    assert label in shown
    assert {each[0] for each in shown} == {label[0]}
    assert layers == 1


def test_a_label_covers_the_key_that_it_stands_for_and_no_part_of_its_word():
    async def jump(app, pilot):
        await pilot.press("semicolon")
        await pilot.pause()
        return stand_in.text_of(app).splitlines()[-1]

    row = run(jump, size=(80, 24))
    assert row.rstrip().endswith(" pages")
    assert "0 pages" not in row


def test_pages_have_a_key_each():
    keys = {for_key(key, ["dashboard"]).name for number in range(1, 11) for key in (f"f{number}", str(number % 10))}
    assert keys == {f"page-{name}" for name, _, _ in PAGES}
