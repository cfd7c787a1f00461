"""The row of pages: where one is, where one can go; by the mouse too."""

from __future__ import annotations

import pytest
import stand_in
from birdcage_tui.widgets.footer import PageBar
from stage import run
from textual.widgets import ContentSwitcher

SIZES = [(100, 30), (120, 36), (160, 48)]
NAMES = "1 Dashboard 2 Control 3 Signal 4 System 5 Console 6 Camera 7 Passes 8 Setup 0 Survey"


def row_of(app):
    return app.query_one(PageBar)._strips[0]


def lit(app):
    """What stands on a ground of its own."""
    return {part.text.strip() for part in row_of(app) if part.style == app.query_one(PageBar).inks["accent-row"]}


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_pages_stand_in_a_row_and_the_present_one_is_lit(size):
    async def through(app, pilot):
        found = {}
        for key in ("f1", "f3", "f7", "f2"):
            await pilot.press(key)
            await pilot.pause()
            await pilot.pause()
            found[key] = lit(app)
        return " ".join(row_of(app).text.split()), found

    text, found = run(through, size=size)
    assert text == NAMES, "what this dish has no use for is left out: no positioner, no page for its motor"
    assert found == {"f1": {"1 Dashboard"}, "f3": {"3 Signal"}, "f7": {"7 Passes"}, "f2": {"2 Control"}}


def test_a_page_that_the_row_leaves_out_stands_there_while_it_is_seen():
    async def motor(app, pilot):
        await pilot.press("f9")
        await pilot.pause()
        await pilot.pause()
        app.paint()
        return lit(app), stand_in.text_of(app)

    here, text = run(motor, size=(120, 36))
    assert here == {"9 Motor"}
    assert "F9" not in text, "one name for the key, on the page and in the row"


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_click_on_a_name_goes_there(size):
    async def click(app, pilot):
        bar, seen = app.query_one(PageBar), []
        for name in ("passes", "dashboard"):
            region = next(region for region, command in bar.hot if command == f"page-{name}")
            await pilot.click(bar, offset=(region.x + region.width - 1, 0))
            await pilot.pause()
            await pilot.pause()
            seen.append(app.query_one("#pages", ContentSwitcher).current)
        return seen

    assert run(click, size=size) == ["page-passes", "page-dashboard"]


def test_the_console_is_lit_while_it_lies_over_a_page():
    async def over(app, pilot):
        await pilot.press("f5")
        await pilot.pause()
        await pilot.pause()
        app.paint()
        return lit(app)

    assert run(over, size=(120, 36)) == {"1 Dashboard", "5 Console"}


@pytest.mark.parametrize("size", [(80, 24), (99, 29)], ids=str)
def test_there_is_none_where_there_is_no_room(size):
    async def look(app, _pilot):
        return app.query_one(PageBar).display, stand_in.text_of(app).splitlines()[-1]

    shown, footer = run(look, size=size)
    assert not shown
    assert "1-0 pages" in footer


def test_the_footer_does_not_say_again_what_the_row_of_pages_says():
    async def look(app, _pilot):
        return stand_in.text_of(app).splitlines()[-1]

    assert "pages" not in run(look, size=(120, 36))
