"""F2, what is seen: everything lies inside the screen, and says what it should."""

import itertools
import re
from dataclasses import replace
from functools import partial

import pytest
import stage
import stand_in
from birdcage.base.no_go import NoGoSector
from birdcage.rotator.facts import CableTurn
from birdcage.station.events import End, MoveEnded
from birdcage.station.requests import Goto
from birdcage_tui.control.control_layout import sizes
from birdcage_tui.control.tape import span_for
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.shown.options import SitePlace
from birdcage_tui.widgets.footer import KeyBar
from birdcage_tui.widgets.pane import Pane
from birdcage_tui.widgets.status import BadDayRow, StatusLine, StopButton
from stage import read
from textual.widgets import Input

SIZES = [(80, 24), (100, 30), (120, 36), (160, 48), (200, 60)]
PARTS = ["rose", "elevation", "readout", "digits", "jog", "actions", "cable", "last"]
KEYS = {"home", "engage", "release-motors", "stow", "speeds", "left", "right", "up", "down", "step-up", "step-down"}

run, run_each = partial(stage.run, key="f2"), partial(stage.run_each, key="f2")


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_every_part_is_inside_the_screen_and_over_no_other(size):
    async def regions(app, pilot):
        parts = [*PARTS, *(["presets"] if size[0] >= 100 else [])]
        widgets = [app.query_one(f"#{part}") for part in parts]
        widgets += [app.query_one(kind) for kind in (StatusLine, StopButton, BadDayRow, KeyBar)]
        return {str(widget): (widget.region, widget.content_size) for widget in widgets}, app.screen.region

    for name, (found, screen) in run_each(regions, size=size).items():
        for what, (region, inside) in found.items():
            assert screen.contains_region(region), f"{name}: {what} {region} is not inside {screen}"
            assert inside.area > 0, (name, what)
        for (what, (region, _)), (other, (second, _)) in itertools.combinations(found.items(), 2):
            assert not region.overlaps(second), f"{name}: {what} lies over {other}"


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("name", ["idle", "not-homed", "fault"])
def test_every_key_of_the_page_is_a_mouse_target_that_can_be_seen(name, size):
    async def targets(app, pilot):
        seen = set()
        for pane in app.query(Pane):
            inside = pane.content_region
            for spot, command in pane.hot:
                if inside.contains_region(spot.translate(inside.offset)) and pane.is_on_screen:
                    seen.add(command)
        return seen

    assert run(targets, name, size) >= KEYS


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_no_pane_is_blank_and_no_word_is_cut(size):
    async def blank(app, pilot):
        empty = []
        for pane in app.query("ControlPage Pane").results(Pane):
            text = "".join(segment.text for strip in pane._strips for segment in strip)
            if pane.is_on_screen and pane.region.area and not text.strip():
                empty.append(str(pane))
        return empty, stand_in.text_of(app)

    empty, text = run(blank, "slewing", size)
    assert empty == []
    for words in ("SLEWING 40.6° to go, 0.6 s", "home", "engage", "release", "stow", "°/s", "CCW 303° left",
                  "CW 143° left", "target", "N", "E", "S", "W"):  # fmt: skip
        assert words in text, text


def test_the_rose_has_the_focus_on_arrival_and_no_text_field():
    async def focus(app, pilot):
        return app.focused.id

    assert run(focus) == "rose"


def without(**lacking):
    return {"dish": replace(stand_in.CARRYOUT_G2, **lacking)}


BAD_DAYS = {
    "not-homed": ("NOT HOMED", "H homes it", "---.--", "turn unknown: H homes the dish"),
    "lost": ("LINK LOST", "old"),
    "silent": ("SILENT", "the dish is silent"),
    "opening": ("NOT READ YET",),
    "late": ("NO REPLY", "2.3s"),
    "held": ("HELD",),
}


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_bad_day_has_a_word_and_no_invented_number(size):
    for name, text in run_each(read, tuple(BAD_DAYS), size).items():
        for word in BAD_DAYS[name]:
            assert word in text, (name, text)
        if name in ("not-homed", "opening"):
            assert not re.search(r"\b189(?!\.22°)", text), name  # 101°W stands there, in the list of the sky
            assert "◉" not in text, name


def test_the_scale_tells_a_tenth_of_a_degree():
    async def nudge(app, pilot):
        pane = app.query_one("#rose")
        ticks = pane.size.height - 2

        def row(az_deg):
            state = app.station.state
            app.station.state = replace(state, position=replace(state.position, az_deg=az_deg), target_az_deg=None)
            app.paint()
            return "".join(segment.text for segment in pane._strips[ticks])

        return [row(189.1), row(189.2), row(189.3)]

    rows = run(nudge)
    assert len(set(rows)) == 3


def test_the_scale_reaches_further_where_there_is_room():
    assert [span_for(width, 3) for width in (30, 46, 74)] == [3.0, 5.0, 5.0]


def test_the_scales_say_which_way_the_target_is():
    off = {"target_az_deg": 188.86, "target_el_deg": 43.07}
    text = run(read, size=(160, 48), state=off)
    assert "target 0.30° CCW" in text
    assert "target 0.20° up" in text
    assert "on target" in run(read, size=(160, 48))


@pytest.mark.parametrize("size", [(80, 24), (100, 30), (120, 36)], ids=str)
def test_an_empty_list_of_presets_says_how_one_is_made(size, tmp_path):
    key = "f2" if size[0] >= 100 else "f2,p"

    async def look(app, pilot):
        for each in key.split(",")[1:]:
            await pilot.press(each)
            await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app)

    text = run(look, size=size, presets_file=tmp_path / "none.toml")
    assert "No presets. a saves this direction." in text


def test_the_frame_of_the_cable_says_that_its_turn_is_of_the_last_session_and_not_cable_twice():
    text = run(read, size=(120, 36), state={"turn": CableTurn.REMEMBERED})
    rows = text.splitlines()
    top = next(y for y, row in enumerate(rows) if "─ Cable ─" in row)
    assert "remembered" not in text
    assert "turn from the last session" in "".join(rows[top : top + 5])
    assert "cable" not in "".join(rows[top : top + 5])
    assert "cable, remembered CCW" in run(read, state={"turn": CableTurn.REMEMBERED})


def test_limits_target_and_stops_are_drawn():
    text = run(read, "slewing", (120, 36))
    for mark in ("◉", "✕", "+", "▨", "65°", "18°"):
        assert mark in text


def test_a_no_go_sector_changes_the_rose():
    sector = {"no_go_sectors": (NoGoSector(60.0, 100.0, 30.0),)}
    rows = [row.split("│")[1] for row in run(read, size=(120, 36)).splitlines() if row.startswith("│")]
    other = [row.split("│")[1] for row in run(read, size=(120, 36), state=sector).splitlines() if row.startswith("│")]
    assert rows != other


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_no_go_sector_says_why_on_the_rose(size):
    rows = run(read, size=size, state={"no_go_sectors": (NoGoSector(20.0, 60.0, 35.0, "mast"),)}).splitlines()
    assert any("mast" in row.split("│")[1] for row in rows if row.startswith("│"))
    if size[1] >= 36:
        assert any("mast below 35°" in row.split("│")[1] for row in rows if row.startswith("│"))


def test_an_offset_shows_a_second_needle_with_its_angle():
    text = run(read, size=(120, 36), state={"az_offset_deg": 12.4})
    assert "dish 189.2°" in text
    assert "azimuth true" in text


def test_the_sun_stands_on_the_rim_when_it_is_up_and_the_place_is_known():
    async def look(app, pilot):
        before = stand_in.text_of(app)
        app.settings = replace(app.settings, place=SitePlace(40.0, 10.0))
        app.paint()
        await pilot.pause()
        return before, stand_in.text_of(app)

    dark, bright = run(look)
    assert "☼" not in dark
    assert "☼" in bright


def test_the_cable_says_what_the_target_leaves():
    text = run(read, "slewing", (160, 48))
    assert "-120.0° from home" in text
    assert "at the target -160.6°: CCW 263°, CW 184° left" in text


def test_a_dish_without_a_stop_says_so():
    assert "no stop" in run(read, state=without(cable=None))


def test_a_click_on_the_rose_types_the_azimuth_and_moves_nothing():
    async def click(app, pilot):
        pane = app.query_one("#rose")
        await pilot.click(pane, offset=(pane.size.width - 4, (pane.size.height - 3) // 2 + 1))
        await pilot.pause()
        typed = app.query_one(GotoLine).query_one(Input).value
        pending = app.station.asked_for(Goto)
        await pilot.press("enter")
        await pilot.pause()
        return typed, pending, app.station.asked_for(Goto), app.focused.id

    typed, pending, asked, focused = run(click, size=(120, 36))
    assert typed.startswith("az=")
    assert abs(float(typed[3:]) - 90.0) < 4.0
    assert pending == []
    assert asked == [Goto(float(typed[3:]), 42.87, "you")]
    assert focused == "rose"


def test_the_last_row_tells_what_the_last_command_did():
    async def end(app, pilot):
        clock = app.session.clock
        for listener in app.station.listeners:
            listener(MoveEnded(clock.monotonic(), clock.utc(), End.ARRIVED, "arrived", app.station.state.position))
        await pilot.pause(0.2)
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app).splitlines()[-2]

    assert "12:00:00Z  Arrived at 189.16°/42.87°." in run(end)


@pytest.mark.parametrize("width", [80, 99, 100, 120, 149, 150, 200])
@pytest.mark.parametrize("height", [18, 19, 21, 24, 27, 33, 45, 57])
def test_the_columns_fill_the_width_and_nothing_is_squeezed_away(width, height):
    found = sizes(width, height)
    inside = height - found.cable - 1
    assert found.rose + found.elevation + 26 <= width
    assert found.rose >= 20
    assert found.elevation >= 16
    hands = found.digits + found.jog + found.actions
    assert found.readout >= 4
    if found.roomy:
        assert found.readout + hands + 2 + 3 <= inside, "a row of presets and their keys"
    else:
        assert found.readout + hands + 2 <= inside


@pytest.mark.parametrize("size", [(120, 36), (160, 48)], ids=str)
def test_what_was_done_stands_once_and_what_was_done_before_it_has_its_own_pane(size):
    async def tell(app, pilot):
        app.say("The first.")
        app.session.clock.advance(5.0)
        app.say("The second.")
        await pilot.pause()
        return stand_in.text_of(app).splitlines()

    rows = run(tell, size=size)
    assert "12:00:05Z  The second." in rows[-3]
    assert sum("The second." in row for row in rows) == 1
    assert sum("12:00:00Z  The first." in row for row in rows) == (size[0] >= 160)


def test_a_sentence_is_dated_when_it_was_said_and_not_when_the_page_was_opened():
    async def tell(app, pilot):
        await pilot.press("f1")
        app.say("Said on the dashboard.")
        app.session.clock.advance(60.0)
        await pilot.press("f2")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app).splitlines()[-2]

    assert "12:00:00Z  Said on the dashboard." in run(tell)
