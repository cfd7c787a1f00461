"""The list of presets on F2: keep, go, edit, delete, undo, filter; and what a damaged file allows."""

import pytest
import stage
import stand_in
from birdcage.base.presets import Preset, add_preset, load_presets
from birdcage.station.requests import Goto
from birdcage_tui.control.presets import PresetsPane
from textual.widgets import Input

WALL = Preset("Wall", 250.4, 20.5, "never below 20")
ASTRA = Preset("Astra 28.2E", 151.3, 27.2, "Ku")
PARK = Preset("Park", 0.0, 60.0)
BOTH = pytest.mark.parametrize("size", [(80, 24), (120, 36)], ids=str)


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "presets.toml"
    for preset in (WALL, ASTRA, PARK):
        add_preset(path, preset)
    return path


def run(test, path, name="idle", size=(120, 36)):
    return stage.run(test, name, size, key="f2", presets_file=path)


async def settled(app, pilot):
    await pilot.pause()
    app.paint()
    await pilot.pause()
    await pilot.pause()
    return stand_in.text_of(app)


async def fill(app, pilot, *values):
    """Type into the form that lies on top."""
    await pilot.pause()
    for field, value in zip(app.screen.query(Input), values, strict=True):
        if value is not None:
            field.value = value
    await pilot.press("enter")
    return await settled(app, pilot)


@BOTH
def test_the_list_is_shown_with_its_cursor_and_enter_goes_there(path, size):
    async def go(app, pilot):
        await pilot.press("p", "j")
        text = await settled(app, pilot)
        await pilot.press("enter")
        return text, app.station.asked_for(Goto), app.focused.id

    text, asked, focused = run(go, path, size=size)
    assert "▶ Astra 28.2E" in text
    assert "Wall" in text
    assert asked == [Goto(151.3, 27.2, "you")]
    assert focused == "presets"


def test_a_long_move_is_refused_with_its_reason_like_any_other(path):
    async def go(app, pilot):
        await pilot.press("p", "enter")
        return app.station.asked_for(Goto), await settled(app, pilot)

    asked, text = run(go, path, "lost")
    assert asked == []
    assert "does not answer" in text


def test_where_it_points_is_kept_under_a_name(path):
    async def keep(app, pilot):
        await pilot.press("a")
        return await fill(app, pilot, "Roof", None, None, "by hand")

    text = run(keep, path)
    assert load_presets(path).entries[-1] == Preset("Roof", 189.16, 42.87, "by hand")
    assert 'Saved "Roof" at 189.16°/42.87°.' in text
    assert "Roof" in text.split("Presets")[1]


@pytest.mark.parametrize(
    ("values", "says"),
    [
        (("", "1", "20", ""), "A name has 1 to 40 characters"),
        (("WALL", "1", "20", ""), 'A preset "WALL" exists.'),
        (("180 45", "1", "20", ""), '"180 45" reads as a direction'),
        (("S", "1", "20", ""), "reads as a direction"),
        (("Roof", "north", "20", ""), "Type azimuth and elevation in degrees"),
        (("Roof", "nan", "20", ""), "Type azimuth and elevation in degrees"),
        (("Roof", "1", "999", ""), "The elevation lies from"),
    ],
)
def test_what_cannot_be_kept_says_why_and_keeps_the_form(path, values, says):
    async def keep(app, pilot):
        await pilot.press("a")
        text = await fill(app, pilot, *values)
        return " ".join(text.split()), len(app.screen_stack)

    before = path.read_bytes()
    text, screens = run(keep, path)
    assert says in text
    assert screens == 2
    assert path.read_bytes() == before


def test_esc_keeps_nothing(path):
    async def leave(app, pilot):
        await pilot.press("a")
        await pilot.pause()
        await pilot.press(*"Roof", "escape")
        await pilot.pause()
        return len(app.screen_stack)

    assert run(leave, path) == 1
    assert len(load_presets(path).entries) == 3


def test_one_is_edited_in_its_place(path):
    async def edit(app, pilot):
        await pilot.press("p", "down", "e")
        return await fill(app, pilot, None, "160,5", "30", "moved")

    text = run(edit, path)
    assert load_presets(path).entries == (WALL, Preset("Astra 28.2E", 160.5, 30.0, "moved"), PARK)
    assert 'Changed "Astra 28.2E"' in text


def test_a_deleted_one_is_told_and_u_brings_it_back_where_it_was(path):
    async def delete(app, pilot):
        await pilot.press("p", "down", "d")
        gone = await settled(app, pilot)
        kept = load_presets(path).entries
        await pilot.press("u")
        back = await settled(app, pilot)
        await pilot.press("u")
        return gone, kept, back, await settled(app, pilot)

    gone, kept, back, again = run(delete, path)
    assert 'Deleted "Astra 28.2E". u restores it.' in gone.splitlines()[-3]
    assert kept == (WALL, PARK)
    assert 'Restored "Astra 28.2E".' in back
    assert load_presets(path).entries == (WALL, ASTRA, PARK)
    assert "No deleted presets." in again


@BOTH
def test_the_filter_narrows_by_name_and_note_and_esc_clears_it(path, size):
    async def find(app, pilot):
        await pilot.press("slash", *"ku")
        narrowed = await settled(app, pilot)
        await pilot.press("enter")
        await pilot.pause()
        chosen, focused = app.query_one(PresetsPane).chosen(), app.focused.id
        await pilot.press("enter")
        asked = app.station.asked_for(Goto)
        app.motions.under_way.clear()  # the dish has arrived: Esc is no STOP then
        await pilot.press("slash", "escape")
        return narrowed, chosen, focused, asked, await settled(app, pilot)

    narrowed, chosen, focused, asked, cleared = run(find, path, size=size)
    assert "Astra 28.2E" in narrowed
    assert "Wall" not in narrowed
    assert (chosen, focused) == (ASTRA, "presets")
    assert asked == [Goto(151.3, 27.2, "you")]
    assert "Wall" in cleared


def test_a_filter_that_finds_nothing_says_so(path):
    async def find(app, pilot):
        await pilot.press("slash", *"zzz", "enter")
        text = await settled(app, pilot)
        await pilot.press("enter", "e", "d")
        return text, app.station.asked_for(Goto), len(app.screen_stack)

    text, asked, screens = run(find, path)
    assert 'No preset matches "zzz".' in text
    assert (asked, screens) == ([], 1)
    assert len(load_presets(path).entries) == 3


@BOTH
def test_an_empty_list_says_which_key_fills_it(tmp_path, size):
    async def look(app, pilot):
        await pilot.press("p")
        await settled(app, pilot)
        return "".join(segment.text for strip in app.query_one(PresetsPane)._strips for segment in strip)

    assert "No presets. a saves this direction." in " ".join(run(look, tmp_path / "none", size=size).split())


@pytest.mark.parametrize("keys", [("a",), ("p", "e"), ("p", "d")])
def test_a_damaged_file_is_named_shown_as_far_as_it_is_good_and_not_written(path, keys):
    path.write_text(path.read_text().replace("az_deg = 151.3", 'az_deg = "east"'))
    before = path.read_bytes()

    async def change(app, pilot):
        text = await settled(app, pilot)
        await pilot.press(*keys)
        after = await settled(app, pilot)
        return text, after, len(app.screen_stack)

    text, after, screens = run(change, path, size=(200, 60))
    assert "Wall" in text
    assert "Park" in text
    assert "presets.toml" in text
    assert "presets.toml" in after.splitlines()[-3]
    assert screens == 1
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    "content", [b"\xff\xfe", b"[[[", b"preset = 3", b"[[preset]]\nname = 'a\x00b'", b"[[preset]]\nname = 7"]
)
def test_no_content_ends_the_app(tmp_path, content):
    path = tmp_path / "presets.toml"
    path.write_bytes(content)

    async def look(app, pilot):
        await pilot.press("p", "enter", "e", "d", "u", "a", "slash", "x")
        return await settled(app, pilot)

    assert "presets.toml" in run(look, path, size=(200, 60)).replace("\n", "")
    assert path.read_bytes() == content


def test_a_click_chooses_a_row_and_the_key_below_goes(path):
    async def click(app, pilot):
        await settled(app, pilot)
        pane = app.query_one(PresetsPane)
        await pilot.click(pane, offset=(4, 2))
        await settled(app, pilot)
        moved = app.station.asked_for(Goto)
        spot = next(region for region, name in pane.hot if name == "preset-go")
        await pilot.click(pane, offset=(spot.x + 1, spot.y))
        await pilot.pause()
        return moved, app.station.asked_for(Goto)

    assert run(click, path) == ([], [Goto(0.0, 60.0, "you")])


def test_a_presets_command_from_the_palette_works_while_the_rose_has_the_focus(path):
    async def choose(app, pilot):
        app.action_command("preset-delete")
        await settled(app, pilot)
        return load_presets(path).entries

    assert run(choose, path) == (ASTRA, PARK)


@BOTH
def test_esc_at_rest_goes_back_to_the_rose(path, size):
    async def back(app, pilot):
        await pilot.press("p", "escape")
        return app.focused.id, app.station.stops, await settled(app, pilot)

    focused, stops, text = run(back, path, size=size)
    assert (focused, stops) == ("rose", [])
    assert "engage" in text


def test_presets_are_marks_on_the_rose_and_words_for_the_go_to_line(path):
    async def look(app, pilot):
        text = await settled(app, pilot)
        await pilot.press("g", *"park", "enter")
        await pilot.pause()
        return text, app.station.asked_for(Goto)

    text, asked = run(look, path)
    assert text.count("◆") == 3
    assert asked == [Goto(0.0, 60.0, "you")]
