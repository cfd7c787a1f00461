"""The palette: our frame, one line an entry with its key, and what cannot be done now last, with its reason."""

from __future__ import annotations

import asyncio

import pytest
import stand_in
from birdcage_tui.commands import BY_NAME, COMMANDS
from stage import run
from stand_in import text_of
from textual.command import CommandList
from textual.widgets import Input


def entries(*keys, name="idle", size=(120, 36), key=None):
    """What the palette lists, in its order, and the screen."""

    async def body(app, pilot):
        await pilot.press("colon", *keys)
        await pilot.pause(0.5)
        rows = app.screen.query_one(CommandList)
        return [str(rows.get_option_at_index(index).prompt) for index in range(rows.option_count)], text_of(app)

    return run(body, name, size=size, key=key)


def test_each_command_has_one_line_that_begins_with_its_key():
    lines, _ = entries()
    assert len(lines) == len(COMMANDS)
    assert not [line for line in lines if "\n" in line]
    stop = BY_NAME["stop"]
    assert lines[0] == f"   Space  {stop.title}  {stop.help}"
    assert "     m  Mark the horizon (Control)  Not now: " in "\n".join(lines)


@pytest.mark.parametrize("keys", [(), ("h", "o")])
def test_what_cannot_be_done_now_is_last_with_its_reason(keys):
    lines, _ = entries(*keys, name="held")
    refused = ["Not now: " in line for line in lines]
    assert any(refused)
    assert not all(refused)
    assert refused == sorted(refused), lines
    assert any(line.endswith("Home the dish …  Not now: STOP is latched. Enter releases it.") for line in lines)


def test_what_is_typed_finds_pages_and_whole_words_first_and_nothing_that_lacks_it():
    lines, _ = entries(*"pass", key="f7")
    titles = [line[10:] for line in lines]
    assert titles[0].startswith("Passes  "), titles
    assert all("pass" in title.casefold() for title in titles)
    able = [title for title in titles if "Not now: " not in title]
    cursor = [title.startswith(("Pass above", "Pass below", "First pass")) for title in able]
    assert any(cursor)
    assert cursor == sorted(cursor), able


def test_letters_that_no_title_holds_in_one_piece_are_an_abbreviation():
    lines, _ = entries(*"nthm")
    assert any("Next theme" in line for line in lines)


@pytest.mark.parametrize("size", [(80, 24), (120, 36), (40, 12)])
def test_it_stands_in_our_frame_under_row_1(size):
    _, text = entries(size=size)
    rows = text.splitlines()
    assert "STOP" in rows[0]
    assert any("╭─ All commands ─" in row for row in rows)
    assert "🔎" not in text


@pytest.mark.parametrize(("typed", "says"), [((), "Backspace closes"), (("p",), "Backspace closes if empty")])
def test_while_the_dish_moves_it_says_what_backspace_does_with_what_is_typed(typed, says):
    async def body(app, pilot):
        await pilot.press("colon", *typed)
        app.paint()
        await pilot.pause()
        return text_of(app)

    text = run(body, "slewing", size=(80, 24))
    assert f"Enter runs it, {says}, Esc or Ctrl+C stops the dish" in text


def test_a_frame_painted_while_the_palette_is_taken_apart_ends_nothing():
    async def body():
        app = stand_in.app_in("idle")
        async with app.run_test() as pilot:
            await pilot.press("colon")
            await app.screen.query_one(Input).remove()
            app.paint()
            await pilot.pause()
            return app.is_running

    assert asyncio.run(body())
