"""Two dishes in one app: a row each, one on the pages, STOP for both."""

import asyncio
from dataclasses import replace

import pytest
import stand_in
from birdcage.base.clock import VirtualClock
from birdcage.base.errors import ConfigError
from birdcage.base.paths import Paths
from birdcage.station.events import HeldChanged, PositionRead
from birdcage.station.requests import Goto, Jog, Release, Unwatch, Watch
from birdcage_tui.feeds.settings import AppOptions
from birdcage_tui.main import parser
from birdcage_tui.run import _build_all as build_all
from birdcage_tui.shell.birdcage_app import BirdcageApp
from birdcage_tui.shown.view import YOU
from birdcage_tui.widgets.other_dish import OtherDishRow
from birdcage_tui.widgets.page import Page
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.status import BadDayRow, StopButton
from textual.widget import Widget

SIZES = ((80, 24), (120, 36), (160, 48))
PAGES = ("1", "2", "3", "4", "5", "7", "8")


def two(first="idle", second="travler", **settings):
    clock = VirtualClock()
    sessions = [stand_in.Session(stand_in.STATES[name](clock), clock) for name in (first, second)]
    options = AppOptions(place=stand_in.PLACE, setup=stand_in.setup_stand_in.Engine, **settings)
    return BirdcageApp(sessions[0], options, (sessions[1], replace(options)))


def run(test, *states, size=(80, 24), **settings):
    async def body():
        app = two(*states, **settings)
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return await test(app, pilot)

    return asyncio.run(body())


async def other(pilot):
    await pilot.press("O")
    await pilot.pause()
    await pilot.pause()


def rows(app):
    return stand_in.text_of(app).splitlines()


def stations(app):
    return [dish.station for dish in app.dishes.all]


def test_each_dish_has_a_row_and_the_key_shows_the_other():
    async def look(app, pilot):
        assert rows(app)[0].startswith(" 1 G2")
        assert rows(app)[1].startswith(" 2 Trav'ler")
        assert " O " in rows(app)[1]
        await other(pilot)
        assert rows(app)[0].startswith(" 2 Trav'ler")
        assert rows(app)[1].startswith(" 1 G2")
        await other(pilot)
        assert rows(app)[0].startswith(" 1 G2")

    run(look)


def test_the_second_can_be_the_first_that_is_shown():
    async def body():
        app = two()
        app.begin_with(2)
        async with app.run_test(size=(80, 24)) as pilot:
            await pilot.pause()
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return [row[:4] for row in rows(app)[:2]], app.station is stations(app)[1]

    assert asyncio.run(body()) == ([" 2 T", " 1 G"], True)


@pytest.mark.parametrize("key", ["space", "ctrl+c"])
def test_stop_reaches_both(key):
    async def stop(app, pilot):
        await pilot.press(key)
        assert [station.stops for station in stations(app)] == [[YOU], [YOU]]
        await other(pilot)
        await pilot.press(key)
        assert [station.stops for station in stations(app)] == [[YOU, YOU], [YOU, YOU]]

    run(stop)


def test_esc_stops_both_where_only_the_other_one_moves():
    async def stop(app, pilot):
        await pilot.press("escape")
        return [station.stops for station in stations(app)]

    assert run(stop, "idle", "slewing") == [[YOU], [YOU]]
    assert run(stop, "idle", "idle") == [[], []]


def test_the_red_corner_stops_both():
    async def stop(app, pilot):
        await pilot.mouse_down(StopButton)
        await pilot.pause()
        return [station.stops for station in stations(app)]

    assert run(stop) == [[YOU], [YOU]]


def test_enter_releases_the_one_that_is_shown_and_no_other():
    async def release(app, pilot):
        first, second = stations(app)
        await pilot.press("enter")
        assert (first.asked_for(Release), second.asked_for(Release)) == ([Release(YOU)], [])
        await other(pilot)
        await pilot.press("enter")
        assert (len(first.asked_for(Release)), second.asked_for(Release)) == (1, [Release(YOU)])

    run(release, "held", "held")


def test_the_row_of_what_is_wrong_releases_only_the_dish_that_it_told_of():
    async def press(app, pilot):
        row = app.screen.query_one(BadDayRow)
        row.post_message(BadDayRow.Pressed("2"))
        await pilot.pause()
        assert [station.asked_for(Release) for station in stations(app)] == [[], []]
        row.post_message(BadDayRow.Pressed("1"))
        await pilot.pause()
        assert [station.asked_for(Release) for station in stations(app)] == [[Release(YOU)], []]

    run(press, "held", "held")


def test_keys_move_the_one_that_is_shown():
    async def jog(app, pilot):
        first, second = stations(app)
        await pilot.press("2")
        await pilot.pause()
        await pilot.press("right")
        assert (len(first.asked_for(Jog)), second.asked_for(Jog)) == (1, [])
        await other(pilot)
        assert isinstance(app.page, Page)
        assert app.page.scope == "control", "the same page, of the other dish"
        await pilot.press("right")
        assert (len(first.asked_for(Jog)), len(second.asked_for(Jog))) == (1, 1)

    run(jog, "idle", "idle")


def test_a_go_to_line_that_was_open_moves_nothing():
    async def go(app, pilot):
        await pilot.press("g")
        await pilot.press(*"100 40")
        await pilot.mouse_down(OtherDishRow)
        await pilot.pause()
        await pilot.pause()
        assert app.dishes.shown.tag == "2"
        await pilot.press("enter")
        assert [station.asked_for(Goto) for station in stations(app)] == [[], []]

    run(go, "idle", "idle")


def test_a_question_is_answered_before_the_other_dish_can_be_shown():
    async def ask(app, pilot):
        await pilot.press("H")
        await pilot.pause()
        await pilot.press("O")
        app.show_other_dish()
        await pilot.pause()
        await pilot.pause()
        assert app.dishes.shown.tag == "1"
        assert len(app.screen_stack) == 2

    run(ask, "idle", "idle")


def test_the_station_of_the_other_reads_where_it_points_and_no_more():
    async def watches(app, pilot):
        first, second = stations(app)
        assert second.asked_for(Watch)[-1].features == {"position"}
        await pilot.press("3")
        await pilot.pause()
        page = first.asked_for(Watch)[-1]
        await other(pilot)
        assert Unwatch(page.watcher) in first.asked
        assert first.asked_for(Watch)[-1].features == {"position"}
        assert second.asked_for(Unwatch)

    run(watches, "idle", "idle")


def test_held_of_the_other_dish_stands_in_its_row():
    async def read(app, _pilot):
        return rows(app)[1]

    assert "HELD" in run(read, "idle", "held")


def test_a_dish_that_is_silent_does_not_keep_the_other_from_moving():
    async def move(app, pilot):
        assert "SILENT" in rows(app)[1]
        await pilot.press("2")
        await pilot.pause()
        await pilot.press("right")
        return len(app.station.asked_for(Jog))

    assert run(move, "idle", "silent") == 1


def test_what_happens_to_the_other_is_noted_there():
    async def hear(app, pilot):
        first, second = app.dishes.all
        event = HeldChanged(0.0, app.session.clock.utc(), None)
        second.station.listeners[0](event)
        await pilot.pause()
        assert [len(dish.feeds.notes.told) for dish in (first, second)] == [0, len(second.feeds.notes.told)]
        position = second.station.state.position
        second.station.listeners[0](PositionRead(0.0, app.session.clock.utc(), position))
        await pilot.pause()

    run(hear, "idle", "idle")


def in_a_list(widget):
    """Whether it lies in what can be scrolled."""
    return any(
        each.styles.overflow_y != "hidden"
        for each in widget.ancestors
        if each is not widget.screen and isinstance(each, Widget)
    )


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_all_widgets_are_inside_the_screen(size):
    async def inside(app, pilot):
        for dish in ("1", "2"):
            for key in PAGES:
                await pilot.press(key)
                await pilot.pause()
                await pilot.pause()
                screen = app.screen.region
                parts = (app.page, app.stage.open_sheet, *app.screen.query("TopRow, OtherDishRow, BadDayRow, KeyBar"))
                for part in parts:
                    if part is not None:
                        assert part.region.area, (dish, key, part)
                        assert screen.contains_region(part.region), (dish, key, part)
                for pane in app.page.query(Pane):
                    if pane.is_on_screen and pane.region.area and not in_a_list(pane):
                        assert screen.contains_region(pane.region), (dish, key, pane)
                if key == "5":
                    await pilot.press(key)
                    await pilot.pause()
            await other(pilot)

    run(inside, size=size)


def test_the_pocket_view_has_both_rows():
    async def look(app, pilot):
        assert rows(app)[0].startswith(" 1")
        assert rows(app)[1].startswith(" 2")
        await pilot.mouse_down(OtherDishRow)
        await pilot.pause()
        await pilot.pause()
        assert rows(app)[0].startswith(" 2")
        assert "S T O P" in "\n".join(rows(app)[2:]), "its bar for a thumb"
        await pilot.press("space")
        return [station.stops for station in stations(app)], "Keys need 40x13" in stand_in.text_of(app)

    assert run(look, size=(40, 12)) == ([[YOU], [YOU]], True)
    assert run(look, size=(40, 13)) == ([[YOU], [YOU]], False)


def test_one_dish_has_neither_row_nor_key():
    async def look(app, pilot):
        assert not app.screen.query(OtherDishRow)
        await pilot.press("O")
        await pilot.press("question_mark")
        await pilot.pause()
        return stand_in.text_of(app)

    async def body():
        app = stand_in.app_in("idle")
        async with app.run_test(size=(120, 48)) as pilot:
            await pilot.pause()
            return await look(app, pilot)

    assert "Other dish" not in asyncio.run(body())


def test_the_end_stops_and_closes_both():
    async def leave(app, pilot):
        await pilot.press("ctrl+q")
        await pilot.pause()
        return app

    app = run(leave, "slewing", "slewing")
    assert [station.stops for station in stations(app)] == [[YOU], [YOU]]
    words = app.dishes.end("quit", 0.0)
    assert [dish.session.closed for dish in app.dishes.all] == [1, 1]
    assert words.splitlines() == ["1  The dish's position is not known.", "2  The dish's position is not known."]


def test_help_lists_the_key_with_two_dishes():
    async def read(_app, pilot):
        await pilot.press("question_mark")
        await pilot.pause()
        return stand_in.text_of(_app)

    assert "Show the other dish on these pages." in run(read, size=(120, 60))


def test_what_is_typed_ahead_goes_to_the_dish_that_is_shown_then():
    async def ahead(app, pilot):
        await pilot.press("2")
        await pilot.pause()
        await pilot.press("O", "right", "O", "left")
        await pilot.pause()
        await pilot.pause()
        return [[jog.d_az_deg for jog in station.asked_for(Jog)] for station in stations(app)]

    assert run(ahead, "idle", "idle") == [[-1.0], [1.0]]


def built(*words, paths):
    return build_all(parser().parse_args(words), paths)


def test_the_demo_simulates_two_of_which_one_shows_itself(tmp_path):
    (first, its, _), (second, others, _) = built("--demo", "--also", "hal205", paths=Paths.in_folder(tmp_path))
    try:
        assert [session.station.state.port.partition("?")[0] for session in (first, second)] == ["sim:g2", "sim:hal205"]
        assert (its.tour, others.tour) == (True, False)
        assert first.clock is second.clock
    finally:
        for session in (first, second):
            session.close()


def test_the_second_dish_goes_by_its_own_file_and_not_by_variables(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_PORT", f"{tmp_path}/north")
    monkeypatch.setenv("BIRDCAGE_FIRMWARE", "g2")
    file = tmp_path / "south.toml"
    file.write_text(f'[dish]\nport = "{tmp_path}/south"\nfirmware = "hal205"\n[place]\nname = "South"\n')
    sessions = [each for each, *_ in built("--also", str(file), paths=Paths.in_folder(tmp_path / "home"))]
    try:
        assert [each.station.state.port for each in sessions] == [f"{tmp_path}/north", f"{tmp_path}/south"]
        assert [each.station.state.dish.name for each in sessions] == ["Carryout G2", "Trav'ler"]
    finally:
        for session in sessions:
            session.close()


def test_a_second_dish_at_the_same_port_is_refused(tmp_path, monkeypatch):
    monkeypatch.setenv("BIRDCAGE_PORT", f"{tmp_path}/north")
    monkeypatch.setenv("BIRDCAGE_FIRMWARE", "g2")
    file = tmp_path / "south.toml"
    file.write_text(f'[dish]\nport = "{tmp_path}/north"\n')
    with pytest.raises(ConfigError, match="Each dish needs a port of its own"):
        built("--also", str(file), paths=Paths.in_folder(tmp_path / "home"))
