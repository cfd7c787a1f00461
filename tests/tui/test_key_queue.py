"""Keys that arrive together: each is dealt with where the one before it has led, and none ends the app."""

import asyncio
import threading
from types import SimpleNamespace

import horizon_stand_in
import pytest
import stand_in
from birdcage.base.presets import load_presets
from birdcage.station.requests import Goto, Home, Jog, Release
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.shell.key_queue import settled
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.status import BadDayRow
from burst import key_of, settle, typed, write
from stage import run
from textual.events import MouseDown


def after(*names, state="idle", look=lambda app: None, **options):
    """Write the keys at once; return the app, and what `look` finds on it while it runs."""

    async def body(app, pilot):
        write(app, *names)
        await settle(app)
        await pilot.pause()
        assert app.is_running
        return app, look(app)

    return run(body, state, **options)


@pytest.mark.parametrize(
    "names",
    [
        ("colon", "enter", "enter"),
        ("semicolon", "a", "s"),
        ("question_mark", "down", "enter", "enter"),
        ("f2", "p", "d", "enter", "enter", "enter"),
        ("f2", "D", "enter", "enter", "enter"),
        ("question_mark", "escape", "escape"),
        ("f7", "t", "escape", "escape"),
        ("H", "y", "y"),
        ("colon", "escape", "escape", "colon", "escape"),
        ("f5", "slash", "f5", "slash", "escape", "escape"),
    ],
    ids=" ".join,
)
def test_keys_in_one_write_end_neither_the_app_nor_leave_a_layer(names, kept):
    _, screens = after(*names, look=lambda app: [type(screen).__name__ for screen in app.screen_stack],
                       presets_file=kept, horizon=horizon_stand_in.File())  # fmt: skip
    assert screens == ["Ground"]


def test_what_is_typed_ahead_goes_where_the_key_before_it_leads():
    app, _ = after("g", *typed("200,40"), "enter")
    assert app.station.asked_for(Goto) == [Goto(200.0, 40.0, "you")]


def test_the_palette_searches_for_what_was_typed_before_enter_chooses():
    async def body(app, pilot):
        done, action_command = [], app.action_command
        app.action_command = lambda name: (done.append(name), action_command(name))
        write(app, "colon", *typed("jump"), "enter")
        await settle(app)
        return done

    assert run(body) == ["jump"]


def test_a_second_y_answers_nothing_else():
    app, _ = after("H", "y", "y", "y")
    assert len(app.station.asked_for(Home)) == 1


def test_a_key_for_a_page_waits_until_the_page_is_there():
    assert isinstance(after("f2", "R", look=lambda app: app.screen)[1], QuestionScreen)


def test_space_behind_the_enter_that_sends_the_dish_off_stops_it():
    async def body(app, pilot):
        await pilot.press("g", *typed("200,40"))
        write(app, "enter", "space")
        await settle(app)
        return len(app.station.asked_for(Goto)), app.station.stops

    assert run(body) == (1, ["you"])


def test_an_enter_that_was_read_before_space_does_not_let_go_of_held():
    async def body(app, pilot):
        stop = app.station.stop

        def hold(by):
            stop(by)
            app.station.state = stand_in.held(app.session.clock)

        app.station.stop = hold
        write(app, "enter", "space")
        await settle(app)
        stopped = app.station.stops, app.station.asked_for(Release)
        write(app, "enter")
        await settle(app)
        return stopped, app.station.asked_for(Release)

    assert run(body) == ((["you"], []), [Release("you")])


@pytest.mark.parametrize(
    ("names", "way"),
    [
        (("enter",), "space"),
        (("enter",), "ctrl+c"),
        (("f2", "enter"), "space"),
        (("colon", *"release", "enter"), "ctrl+c"),
    ],
)
def test_an_enter_under_way_that_stop_overtakes_does_not_let_go_of_held(names, way):
    async def body(app, pilot):
        keys, deal = app.keys, app.keys._deal

        async def overtaken(key):
            if key.key == "enter":
                keys.read(key_of(way))
            await deal(key)

        write(app, *names[:-1])
        await settle(app)
        keys._deal = overtaken
        write(app, names[-1])
        await settle(app)
        keys._deal = deal
        overtaken = app.station.stops, app.station.asked_for(Release)
        write(app, *names)
        await settle(app)
        return overtaken, app.station.asked_for(Release)

    assert run(body, "held") == ((["you"], []), [Release("you")])


def test_an_enter_that_is_taken_while_stop_goes_out_does_not_let_go_of_held():
    """The wire takes its time, and the app's thread goes on meanwhile."""

    async def body(app, pilot):
        taken, stop = threading.Event(), app.keys._stop

        def stopping():
            stop()
            assert taken.wait(10.0)

        app.keys._stop = stopping
        enter = key_of("enter")
        app.keys.read(enter)
        reader = threading.Thread(target=app.keys.read, args=(key_of("ctrl+c"),))
        reader.start()
        while not app.station.stops:
            await asyncio.sleep(0.001)
        await app.on_event(enter)
        await settle(app)
        taken.set()
        reader.join()
        return app.station.stops, app.station.asked_for(Release)

    assert run(body, "held") == (["you"], [])


@pytest.mark.parametrize("order", [("press", "ctrl+c"), ("ctrl+c", "press")])
def test_a_press_on_the_row_lets_go_of_held_only_after_the_stop_that_was_typed(order):
    async def body(app, pilot):
        x, y = app.screen.query_one(BadDayRow).region.offset
        press = MouseDown(None, x + 1, y, 0, 0, 1, False, False, False, x + 1, y)
        write(app, *(press if each == "press" else each for each in order))
        await settle(app)
        await pilot.pause()
        return app.station.stops, app.station.asked_for(Release)

    assert run(body, "held") == (["you"], [] if order[0] == "press" else [Release("you")])


def test_a_stop_typed_while_held_is_let_go_of_is_said_again():
    async def body(app, pilot):
        submit = app.station.submit

        def submitting(request):
            if isinstance(request, Release):
                app.keys.read(key_of("ctrl+c"))  # on the thread of the keys
            return submit(request)

        app.station.submit = submitting
        write(app, "enter")
        await settle(app)
        return app.station.asked_for(Release), app.station.stops

    assert run(body, "held") == ([Release("you")], ["you", "you"])


@pytest.mark.parametrize("key", ["enter", "click"])
def test_what_comes_after_stop_lets_go_of_held(key):
    async def body(app, pilot):
        await pilot.press("space")
        if key == "enter":
            await pilot.press("enter")
        else:
            await app.on_event(MouseDown(None, 1, 1, 0, 0, 1, False, False, False, 1, 1))  # as the driver reads it
        await pilot.pause()
        return app.station.asked_for(Release)

    assert run(body, "held") == [Release("you")]


def test_an_enter_that_waits_for_its_turn_is_dropped_once_a_stop_is_read():
    async def body(app, pilot):
        app.keys._settling = object()  # the last key is still being dealt with
        await app.on_event(key_of("enter"))
        app.keys.read(key_of("ctrl+c"))  # on the thread of the keys: the app's has not seen it yet
        app.keys._settling = None
        await app.keys._next()
        await pilot.pause()
        return app.station.stops, app.station.asked_for(Release)

    assert run(body, "held") == (["you"], [])


def test_what_waits_behind_another_key_is_dropped_by_stop():
    async def body(app, pilot):
        app.keys._settling = object()  # the last key is still being dealt with
        await app.on_event(key_of("left"))
        app.keys.read(stop := key_of("ctrl+c"))
        await app.on_event(key_of("right"))
        await app.on_event(stop)
        assert app.station.stops == ["you"]
        assert not app.keys._waiting
        app.keys._settling = None
        write(app, "up")
        await settle(app)
        return app.station.asked_for(Jog)

    assert run(body) == [Jog(0.0, 1.0, "you")]


def test_after_the_key_that_ends_the_app_no_key_moves_the_dish():
    async def body(app, pilot):
        write(app, "ctrl+q", "left", "question_mark", "enter")
        await pilot.pause()
        return app.station.asked_for(Jog), app.station.stops, app.return_code

    assert run(body) == ([], [], 0)


def test_a_page_that_never_comes_holds_no_key_back_for_long():
    async def body(app, pilot):
        await app.keys.take(key_of("minus"))
        app.run_worker(never(), group="page")
        await app.keys.take(key_of("g"))
        await pilot.pause(3.0)
        return app.query_one(GotoLine).is_open

    async def never():
        await asyncio.Event().wait()

    assert run(body)


def test_a_deleted_preset_costs_one_key_each(kept):
    after("f2", "p", "d", "d", presets_file=kept)
    assert len(load_presets(kept).entries) == 10


def test_a_layer_that_is_closing_with_something_in_its_queue_holds_nothing_up():
    """Ctrl+Q in mid-slew closes them so: waiting in a circle, the app would hang for good."""
    closing = SimpleNamespace(call_later=lambda _callback: False, message_queue_size=3)
    app = SimpleNamespace(
        screen_stack=[closing], screen=closing, focused=None, workers=(), call_later=lambda _callback: False
    )
    asyncio.run(asyncio.wait_for(settled(app), 20.0))


@pytest.mark.parametrize("opens", ["question_mark", "colon"])
@pytest.mark.parametrize("pages", ["pagedown", "pageup"])
def test_a_list_that_is_not_drawn_yet_takes_keys_that_turn_its_pages(opens, pages):
    after(opens, pages, pages)
