"""A layer closes once, and only when it lies on top."""

from birdcage_tui.commands import BY_NAME
from birdcage_tui.widgets.dialogs import Dialog, Layer, QuestionScreen
from birdcage_tui.widgets.help import HelpScreen
from birdcage_tui.widgets.palette import CommandProvider, Palette
from stage import run
from textual.command import CommandPalette


def test_a_second_answer_closes_nothing_and_is_told_to_nobody():
    async def body(app, pilot):
        answers, question = [], QuestionScreen("Title", "Words", "yes")
        app.push_screen(question, answers.append)
        await pilot.pause()
        question.dismiss(True)
        question.dismiss(False)
        await pilot.pause()
        return answers, len(app.screen_stack), app.is_running

    assert run(body) == ([True], 1, True)


def test_a_layer_under_another_one_stays_and_so_does_the_other():
    async def body(app, pilot):
        below, above = QuestionScreen("Below", "Words", "yes"), QuestionScreen("Above", "Words", "yes")
        answers = []
        app.push_screen(below, answers.append)
        app.push_screen(above, answers.append)
        await pilot.pause()
        below.dismiss(True)
        await pilot.pause()
        return app.screen_stack[1:] == [below, above], answers

    assert run(body) == (True, [])


def test_every_layer_is_one():
    assert issubclass(Dialog, Layer)
    assert issubclass(HelpScreen, Layer)
    assert Palette.dismiss is Dialog.dismiss is Layer.dismiss is not CommandPalette.dismiss


def test_a_palette_does_one_command():
    async def body(app, pilot):
        await pilot.press("colon")
        (provider,) = [each for each in app.screen._providers if isinstance(each, CommandProvider)]
        provider._do(BY_NAME["step-up"])
        provider._do(BY_NAME["step-up"])
        return app.motions.step_deg

    assert run(body) == 2.0


def test_both_keys_of_the_palette_open_the_one_that_leaves_row_1_alone():
    async def body(app, pilot):
        await pilot.press("ctrl+p")
        first = type(app.screen)
        await pilot.press("ctrl+p")
        return first, len(app.screen_stack)

    assert run(body) == (Palette, 2)
