"""F8: a person looks ahead, and neither the present step nor what was typed changes by it."""

import pytest
import setup_stand_in
import stand_in
from birdcage_tui.setup.form import ChoiceButton
from setup_stage import press, run, settle
from textual.widgets import Input


@pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)
def test_looking_ahead_shows_what_a_step_will_ask_and_changes_nothing(size):
    async def look(app, pilot, engine):
        await press(app, pilot, "down")
        text = stand_in.text_of(app)
        for words in ("Stock LNB", "L-band helix", "Another feed", "stow allowed"):
            assert words in text, words
        assert "Preview. Current step: 4 Home. Esc goes back." in " ".join(text.replace("│", " ").split())
        assert "Enter  Go to this step" in text
        assert "Enter  Stock LNB" not in text, "a key that does nothing yet is not named"
        assert all(box.disabled for box in app.page.query(Input))
        await pilot.click(next(button for button in app.query(ChoiceButton) if button.choice.name == "feed-1"))
        await press(app, pilot, "tab")
        assert engine.asked == [], "its answers are not taken before it is the present step"
        assert not isinstance(app.focused, Input)
        await press(app, pilot, "escape")
        assert app.page.step.name == "home"
        assert "Area is clear: home" in stand_in.text_of(app)
        assert (engine.current, engine.asked) == ("home", [])

    run(look, size=size)


def test_a_step_that_is_only_looked_at_is_skipped_without_leaving_the_present_one():
    async def skip(app, pilot, engine):
        await press(app, pilot, "down", "down", "s")
        assert engine.asked == [("skip", "limits"), ("go", "home")]
        assert engine.current == "home"

    run(skip)


def test_the_engine_going_on_does_not_pull_away_who_looks_at_another_step():
    async def look(app, pilot, engine):
        await press(app, pilot, *["down"] * 5)
        engine.change("home", busy="", mark=setup_stand_in.DONE)
        engine.current = "feed"
        await settle(app, pilot)
        assert app.page.step.name == "place"
        assert "▶ ○ 5  Feed" in stand_in.text_of(app)
        await press(app, pilot, "escape")
        assert app.page.step.name == "feed"

    run(look, "busy")


def test_what_was_typed_is_there_again_after_looking_at_another_step_until_it_is_sent():
    async def look(app, pilot, engine):
        def held():
            return next(box.value for box in app.page.query(Input) if box.name == "typed/pitch_deg")

        await press(app, pilot, "enter", *"1.5", "escape", "down")
        assert not [box for box in app.page.query(Input) if box.name == "typed/pitch_deg"]
        await press(app, pilot, "up")
        assert held() == "1.5"
        await press(app, pilot, "enter", *"2", "enter")
        assert engine.asked == [("level", "typed", {"pitch_deg": "1.5", "roll_deg": "2"})]
        await press(app, pilot, "down", "up")
        assert held() == "", "it was sent"

    run(look, "level")


def test_while_the_dish_moves_b_leads_back_to_the_current_step_and_esc_is_said_to_stop():
    async def look(app, pilot, engine):
        await press(app, pilot, "down", "down")
        text = " ".join(stand_in.text_of(app).replace("│", " ").split())
        await press(app, pilot, "b")
        return text, app.page.step.name, engine.asked

    text, step, asked = run(look, state="slewing", size=(120, 36))
    assert "Preview. Current step: 4 Home. b goes back. Esc stops the dish." in text
    assert "Esc goes back" not in text
    assert (step, asked) == ("home", [])
