"""Page keys pressed faster than a page is made: what a person sees at the end is what the last key says."""

import asyncio

import pytest
import stand_in
from birdcage.station.requests import Watch
from birdcage_tui.commands import COMMANDS, PAGES
from birdcage_tui.pages.register import MADE
from birdcage_tui.shell import page_stage
from burst import settle, write
from textual.widgets import ContentSwitcher

NAMES = {name for name, _, _ in PAGES}


@pytest.fixture
def slow_control(monkeypatch):
    """The control page takes its time on the first visit, as on a small computer."""
    make = page_stage.make_page

    def made(name):
        page = make(name)
        if name == "control":
            compose = page._compose

            async def late():
                await asyncio.sleep(0.2)
                await compose()

            page._compose = late
        return page

    monkeypatch.setattr(page_stage, "make_page", made)


def after(*keys, size=(80, 24)):
    """What is seen after keys that all came before the first was dealt with: page, pages, console, what is watched."""

    async def body():
        app = stand_in.app_in("idle")
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            write(app, *keys)
            await settle(app)  # however long the pages take: it waits for them, not for a time
            await pilot.pause(0.5)
            switcher = app.query_one("#pages", ContentSwitcher)
            return (
                switcher.current,
                [page.id for page in switcher.children if page.display],
                app.stage.sheet is not None and app.stage.sheet.is_open,
                app.station.asked_for(Watch)[-1].watcher,
                stand_in.text_of(app),
            )

    return asyncio.run(body())


def test_a_page_key_pressed_twice_at_once_shows_the_page(slow_control):
    current, seen, _, watched, text = after("f2", "f2")
    assert (current, seen, watched) == ("page-control", ["page-control"], "page-control")
    assert "PRESETS" in text.upper()


@pytest.mark.parametrize(("last", "name"), [("f1", "dashboard"), ("f3", "signal"), ("f8", "setup")])
def test_of_two_page_keys_at_once_the_last_wins(slow_control, last, name):
    current, seen, _, watched, _ = after("f2", last)
    assert (current, seen, watched) == (f"page-{name}", [f"page-{name}"], f"page-{name}")


@pytest.mark.parametrize(("keys", "is_open"), [(("f5",), True), (("f5", "f5"), False), (("f5", "f5", "f5"), True)])
def test_the_console_opens_and_closes_as_often_as_its_key_is_pressed(keys, is_open):
    assert after(*keys)[2] is is_open


@pytest.mark.parametrize("command", [command for command in COMMANDS if command.where], ids=lambda one: one.name)
def test_a_command_of_a_scope_says_on_which_page_it_is(command):
    assert (command.page or command.where[0]) in NAMES | MADE.keys() | {"pocket", "dishes"}
