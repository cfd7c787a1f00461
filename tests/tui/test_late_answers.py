"""What answers late is about the dish that it was asked of, and does nothing to the one that is shown by then."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace
from types import SimpleNamespace

import pytest
import settings_stand_in
import stand_in
from birdcage.base.errors import ConfirmationNeeded
from birdcage.skymap.map_request import MapRequest
from birdcage.skymap.plan import MapFrame, MapPlan
from birdcage.station.requests import BeginTask, ReadSettings, Sync
from birdcage_tui.feeds.sky_add import AddOutcome
from birdcage_tui.shell import page_stage
from birdcage_tui.signal.replay import ReplayDesk
from birdcage_tui.widgets.dialogs import QuestionScreen
from birdcage_tui.widgets.fields_screen import FieldsScreen
from test_sync_told import UNTOLD
from test_two_dishes import other, run, stations

AROUND = MapRequest(MapPlan(-4.0, 4.0, -4.0, 4.0, 1.0, frame=MapFrame.TARGET), target="sun")
NEEDED = "It points elsewhere by its own word."


def noted(app):
    """Return the newest note of each dish."""
    return [dish.feeds.notes.last for dish in app.dishes.all]


def late(work, keys=("f3",)):
    """Return what `work(app, pilot)` leaves over, a call that is made once the other dish is shown; then what is so."""

    async def body(app, pilot):
        await pilot.press(*keys)
        await pilot.pause()
        answer = await work(app, pilot)
        await other(pilot)
        assert app.dishes.shown.tag == "2"
        answer()
        await pilot.pause()
        begun = [station.asked_for(BeginTask) for station in stations(app)]
        ways = [bool(dish.motions.under_way) for dish in app.dishes.all]
        return len(app.screen_stack), begun, ways, noted(app)

    return run(body, "idle", "idle", size=(120, 36))


def test_a_map_whose_way_is_found_late_begins_with_neither_dish():
    async def begin(app, _pilot):
        waiting = []
        app.maps.beside = waiting.append
        app.page._maps._send(AROUND, 60.0, "The map begins")
        assert app.motions.under_way
        return lambda: [work() for work in waiting]

    layers, begun, ways, notes = late(begin)
    assert (layers, begun, ways) == (1, [[], []], [False, False])
    assert notes == ["The other dish was shown first. No map was begun.", ""]


@pytest.mark.parametrize("what", ["list", "head", "lesson"])
def test_what_the_file_of_maps_says_late_is_asked_on_no_page(what):
    async def ask(app, _pilot):
        hands, told = app.page._maps, []
        app.maps.do_beside = lambda _read, tell: told.append(tell)
        match what:
            case "list":
                hands.do("map-list")
            case "head":
                app.maps.head("a-map", hands._ask_again)
            case _:
                hands._teach._compute("a-map", lambda: "", lambda _found: app.push_screen(QuestionScreen("", "", "")))
        return lambda: told[0]([])

    layers, _begun, _ways, notes = late(ask)
    assert layers == 1
    assert notes[0].startswith("The other dish was shown first.")
    assert notes[1] == ""


def test_recordings_that_are_read_late_are_listed_on_no_page(monkeypatch):
    recordings = [SimpleNamespace(readings=1)]

    async def ask(app, _pilot):
        told = []
        monkeypatch.setattr(app, "run_worker", lambda work, **_how: told.append(work))
        monkeypatch.setattr(app, "call_from_thread", lambda tell, *found: tell(*found))
        desk = ReplayDesk(app.page, None)
        desk._in_worker(lambda: recordings, desk._choose)
        monkeypatch.undo()
        monkeypatch.setattr(app, "call_from_thread", lambda tell, *found: tell(*found))
        return told[0]

    assert late(ask)[0::3] == (1, ["The recordings are read. R on F3 lists them.", ""])


def test_a_table_that_is_read_late_writes_nothing_to_the_other_dish():
    async def write(app, _pilot):
        settings_stand_in.fill(app, staged={38: "0"})
        feed, told = app.system.own_settings, []
        feed.now = replace(feed.now, read_at=-1e3)
        feed._ask = lambda request, _words, have: told.append((request, have))
        app.page.do("settings-write")
        assert [request for request, _ in told] == [ReadSettings()]
        return lambda: told[0][1](settings_stand_in.TABLE)

    layers, _begun, _ways, notes = late(write, ("f4", "n"))
    assert layers == 1
    assert notes == ["The dish's settings are read. Press the key again.", ""]


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (None, "Synced to azimuth 200.00°."),
        (ConfirmationNeeded(NEEDED), f"Press Y again: {NEEDED}"),
        (ValueError("No."), "No."),
    ],
    ids=["told", "asks", "refused"],
)
def test_the_answer_to_a_sync_is_noted_at_the_dish_that_was_told(error, words):
    async def sync(app, pilot):
        first = app.station
        first.state = replace(first.state, **UNTOLD)
        answer = Future()
        first.submit = lambda request: answer if isinstance(request, Sync) else Future()
        await pilot.press("Y")
        await pilot.pause()
        await pilot.press(*"200", "enter")
        await pilot.pause()
        return lambda: answer.set_result(None) if error is None else answer.set_exception(error)

    layers, _begun, _ways, notes = late(sync, ("f1",))
    assert (layers, notes) == (1, [words, ""])


@pytest.mark.parametrize("switched", [True, False])
def test_elements_that_could_not_be_read_are_asked_again_only_where_they_were_typed(switched):
    async def add(app, pilot):
        told = []
        app.sky.add_elements = lambda _text, tell: told.append(tell) or True
        app.questions.elements("MYSAT")
        await pilot.pause()
        await pilot.press("enter")
        await pilot.pause()
        if switched:
            await other(pilot)
        told[0](AddOutcome("Line 2 is wrong.", whole=False))
        await pilot.pause()
        return isinstance(app.screen, FieldsScreen), noted(app)

    assert run(add, "idle", "idle") == ((False, ["Line 2 is wrong.", ""]) if switched else (True, ["", ""]))


def test_a_step_of_the_setup_that_is_under_way_keeps_its_page():
    async def change(app, pilot):
        await pilot.press("8")
        await pilot.pause()
        engine = app.page.engine
        engine.change("home", busy="homing both axes")
        app.paint()
        await other(pilot)
        at_work = app.dishes.shown.tag, noted(app)
        engine.change("home", busy="")
        app.paint()
        await other(pilot)
        return *at_work, app.dishes.shown.tag

    words = "Setup is at work. Wait: homing both axes. Then O shows the other dish."
    assert run(change, "idle", "idle", size=(120, 36)) == ("1", [words, ""], "2")


def test_a_question_that_came_up_while_the_pages_were_removed_keeps_the_dish_that_it_is_about(monkeypatch):
    idle = page_stage.idle

    async def change(app, pilot):
        async def asking(pump):
            await idle(pump)
            if len(app.screen_stack) == 1:
                app.questions.home()

        monkeypatch.setattr(page_stage, "idle", asking)
        await other(pilot)
        return app.dishes.shown.tag, type(app.screen), app.page.scope, stand_in.text_of(app).count("Home the dish")

    tag, screen, scope, times = run(change, "idle", "idle")
    assert (tag, screen, scope, times) == ("1", QuestionScreen, "dashboard", 1)
