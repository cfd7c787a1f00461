"""The console over a page: where it lies, what its keys do, and STOP."""

from dataclasses import replace

import pytest
from birdcage_tui.console.entry import ConsoleInput, FindInput
from birdcage_tui.console.log import LogView
from birdcage_tui.panes.pointing import PointingPane
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.status import BadDayRow, TopRow
from console_desk import desk
from textual.widgets import ContentSwitcher

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "lost"])
def test_it_lies_inside_the_screen_and_covers_neither_status_nor_footer(name, size):
    async def regions(at):
        await at.look()
        app = at.app
        parts = [*app.stage.sheet.query("*")]
        rows = {kind: app.query_one(kind).region for kind in (TopRow, BadDayRow, KeyBar)}
        seen = [(part, part.region) for part in parts if part.display]
        return app.stage.sheet.region, seen, rows, app.query_one("#stage").region

    whole, parts, rows, stage = desk(regions, name, size)
    assert stage.contains_region(whole)
    assert whole.height == pytest.approx(stage.height * 2 / 3, abs=1)
    assert whole.bottom == stage.bottom
    for part, region in parts:
        assert region.area > 0, part
        assert whole.contains_region(region), part
    for kind, region in rows.items():
        assert region.area > 0
        assert not region.overlaps(whole), kind


@pytest.mark.parametrize("size", SIZES[:1], ids=str)
def test_every_key_of_the_log_can_be_clicked_at_every_size(size):
    async def clicked(at):
        hot = {command for _, command in at.app.stage.sheet._keys.hot}
        await at.press("i")
        await at.look()
        return hot, {command for _, command in at.app.stage.sheet._keys.hot}

    log, line = desk(clicked, size=size)
    assert log >= {"console-type", "console-find", "console-stamps", "console-hex", "console-save", "page-console"}
    assert line >= {"console-complete", "console-older", "console-recall", "console-end-line", "page-console"}


def test_no_text_field_has_the_focus_on_arrival_and_the_page_above_goes_on():
    async def arrive(at):
        focused = at.app.focused
        before = await at.look()
        position = at.app.station.state.position
        at.state(position=replace(position, az_deg=22.22))
        text = await at.look()
        assert at.app.query_one(PointingPane).is_on_screen
        return focused, before, text

    focused, before, text = desk(arrive)
    assert isinstance(focused, LogView)
    assert before.splitlines()[4:9] != text.splitlines()[4:9], "the digits above changed"
    assert "WATCH" in text


@pytest.mark.parametrize("key", ["f5", "5", "escape"])
def test_at_rest_it_closes_and_gives_the_focus_back(key):
    async def close(at):
        await at.press(key)
        await at.pilot.pause()
        return at.app.stage.sheet.is_open, at.app.focused, at.app.stage.scopes()[0].scope

    assert desk(close) == (False, None, "dashboard")


def test_escape_stops_first_while_the_dish_moves():
    async def stop(at):
        await at.press("escape")
        return at.app.station.stops, at.app.stage.sheet.is_open

    assert desk(stop, "slewing") == (["you"], True)


def test_digits_are_typed_and_function_keys_change_the_page_under_the_open_console():
    async def digits(at):
        await at.type("1234")
        typed = at.line.value
        await at.press("f4")
        await at.pilot.pause()
        return typed, at.app.query_one("#pages", ContentSwitcher).current, at.app.stage.sheet.is_open, at.app.focused

    typed, page, is_open, focused = desk(digits)
    assert (typed, page, is_open) == ("1234", "page-system", True)
    assert isinstance(focused, ConsoleInput)


def test_letters_in_the_log_do_not_step_the_dish():
    async def press(at):
        at.app.station.asked.clear()
        await at.press("h", "l", "left", "right", "k", "j")
        return list(at.app.station.asked)

    assert desk(press) == []


# STOP.


def test_space_stops_in_the_log_and_types_in_the_line_and_the_search():
    async def space(at):
        await at.press("space")
        in_log = len(at.app.station.stops)
        await at.type("a 1")
        await at.press("escape", "slash")
        await at.press("x", "space", "y")
        return in_log, at.line.value, at.app.query_one(FindInput).value, len(at.app.station.stops)

    assert desk(space) == (1, "a 1", "x y", 1)


def test_after_a_go_to_from_the_log_escape_still_closes_the_console():
    async def go(at):
        await at.press("g", "escape")
        await at.look()
        open_still, focused = at.app.stage.sheet.is_open, at.app.focused
        await at.press("escape")
        return open_still, focused, at.app.stage.sheet.is_open

    open_still, focused, is_open = desk(go)
    assert open_still
    assert isinstance(focused, LogView)
    assert not is_open


def test_a_terminal_that_becomes_small_folds_it_away_and_space_stops():
    async def small(at):
        await at.press("i")
        await at.pilot.resize_terminal(60, 20)
        await at.pilot.pause()
        await at.press("space")
        await at.press("f5")
        text = await at.look()
        await at.pilot.resize_terminal(80, 24)
        await at.pilot.pause()
        return at.app.station.stops, text, await at.look()

    stops, small, large = desk(small)
    assert stops == ["you"]
    assert "Console" not in small
    assert "╭─ Console  WATCH" in large
