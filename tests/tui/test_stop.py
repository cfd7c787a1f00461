"""STOP: every key that means it, from everywhere, before anything else."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
import stand_in
from birdcage.station.requests import AcknowledgeFault, Goto, Release
from birdcage_tui.shell.stopping import stop_first
from birdcage_tui.widgets.status import BadDayRow, StopButton
from stage import run
from textual.driver import Driver
from textual.events import Key
from textual.widgets import Input


def test_space_types_in_a_text_field_and_ctrl_c_stops_there():
    async def typing(app, pilot):
        await pilot.press("g")
        field = app.query_one(Input)
        assert app.focused is field
        await pilot.press("1", "space", "2")
        assert field.value == "1 2"
        assert app.station.stops == []
        await pilot.press("ctrl+c")
        assert app.station.stops == ["you"]

    run(typing)


def test_esc_stops_first_while_moving_and_closes_a_layer_only_at_rest():
    async def moving(app, pilot):
        await pilot.press("question_mark")
        await pilot.pause()
        await pilot.press("escape")
        await pilot.pause()
        assert app.station.stops == ["you"]
        assert len(app.screen_stack) == 2, "the layer stays: the key was spent on STOP"
        app.station.state = stand_in.at_rest(app.session.clock)
        await pilot.press("escape")
        await pilot.pause()
        assert app.station.stops == ["you"]
        assert len(app.screen_stack) == 1

    run(moving, "slewing")


def test_the_mouse_stops_on_the_press():
    async def press(app, pilot):
        await pilot.mouse_down(StopButton)
        await pilot.pause()
        assert app.station.stops == ["you"]

    run(press)


def test_stop_comes_before_any_painting():
    async def order(app, pilot):
        seen = []
        app.station.stop = lambda by: seen.append("stop")
        paint, take = app.paint, app.keys.take
        app.paint = lambda: (seen.append("paint"), paint())
        app.keys.take = lambda event: (isinstance(event, Key) and seen.append("key"), take(event))[1]
        await pilot.press("space")
        await pilot.pause(0.2)
        assert seen[seen.index("key") + 1] == "stop", "frames before the key are painted as ever"

    run(order, "slewing")


def test_the_reading_thread_stops_before_the_event_loop_hears_of_it():
    sent = []

    class Wire(Driver):
        def __init__(self, app):
            self._app = app

        def send_message(self, message):
            sent.append((message.key, list(app.stops)))

        def start_application_mode(self): ...
        def disable_input(self): ...
        def stop_application_mode(self): ...
        def write(self, data): ...

    app = SimpleNamespace(stops=[], read=[])
    app.keys = SimpleNamespace(read=lambda key: (app.read.append(key.key), app.stops.append("you")))
    driver = stop_first(Wire)(app)
    driver.send_message(Key("space", " "))
    assert sent == [("space", ["you"])]
    assert app.read == ["space"]


def test_a_key_that_the_reading_thread_spent_is_not_spent_twice():
    async def twice(app, pilot):
        event = Key("space", " ")
        app.keys.read(event)
        assert app.station.stops == ["you"]
        await app.on_event(event)
        assert app.station.stops == ["you"]

    run(twice)


def test_enter_releases_held_and_acknowledges_a_fault_first():
    async def enter(app, pilot):
        await pilot.press("enter")
        return app.station.asked

    assert Release("you") in run(enter, "held")
    assert AcknowledgeFault("you") in run(enter, "fault")
    assert not [r for r in run(enter, "idle") if isinstance(r, Release | AcknowledgeFault)]


def test_the_row_is_a_mouse_target_of_enter():
    async def press(app, pilot):
        app.paint()
        await pilot.pause()
        await pilot.mouse_down(BadDayRow)
        await pilot.pause()
        return app.station.asked

    assert Release("you") in run(press, "held")


@pytest.mark.parametrize("name", ["held", "lost", "silent", "not-homed", "fault", "opening"])
def test_no_go_to_and_no_step_when_the_dish_cannot_take_one(name):
    async def go(app, pilot):
        await pilot.press("left", "up", "g", *"180", "space", *"40", "enter")
        await pilot.pause()
        return app.station.asked, stand_in.text_of(app)

    asked, text = run(go, name)
    assert not [r for r in asked if type(r).__name__ in ("Goto", "Jog")]
    assert "▲ Refused: " in text, "what was typed stays, with the reason"
    assert "180 40" in text


def test_esc_is_no_stop_at_rest_after_a_move_of_your_own_and_is_one_before_it_began():
    async def esc(app, pilot):
        app.station.state = replace(app.station.state, holder="you")
        await pilot.press("g", "escape")
        at_rest, closed = list(app.station.stops), not app.query_one("GotoLine").is_open
        await pilot.press("left", "escape")
        return at_rest, closed, app.station.stops

    assert run(esc, "idle") == ([], True, ["you"])


def test_go_to_sends_what_was_typed_and_gives_the_focus_back():
    async def go(app, pilot):
        await pilot.press("g", *"231.4 44", "enter")
        await pilot.pause()
        assert app.focused is None
        return app.station.asked_for(Goto)

    assert run(go) == [Goto(231.4, 44.0, "you")]


@pytest.mark.parametrize("typed", ["231", "north up", "1 2 3", "nan 5"])
def test_go_to_refuses_what_is_no_direction(typed):
    async def go(app, pilot):
        await pilot.press("g")
        app.query_one(Input).value = typed
        await pilot.press("enter")
        return app.station.asked_for(Goto), app.focused

    asked, focused = run(go)
    assert asked == []
    assert isinstance(focused, Input)


@pytest.mark.parametrize(("name", "stops"), [("slewing", ["you"]), ("idle", [])])
def test_quit_stops_first_if_anything_moves(name, stops):
    async def quit_it(app, pilot):
        await pilot.press("ctrl+q")
        await pilot.pause()
        return app.station.stops

    assert run(quit_it, name) == stops
