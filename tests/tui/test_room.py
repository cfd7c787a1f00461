"""Very large terminals: more is told, nothing lies outside, and no pane is mostly blank."""

from dataclasses import replace

import pytest
import sky_stand_in
import stand_in
from birdcage.base.presets import Preset, add_preset
from birdcage.station.requests import Goto, Release
from birdcage_tui.goto.goto_line import GotoLine
from birdcage_tui.panes.health import HealthPane
from birdcage_tui.panes.next import NextPane
from birdcage_tui.widgets.pane import Pane
from stage import read, run
from textual.widgets import Input
from track_stage import run as run_track

LARGE = [(200, 60), (240, 70)]


def blank_area(pane):
    """Cells of the largest block of rows at the top, the bottom or between, on which nothing stands."""
    rows = ["".join(row).strip() for row in pane._cells._chars]
    longest = run_of = 0
    for row in rows:
        run_of = 0 if row else run_of + 1
        longest = max(longest, run_of)
    return longest * pane.size.width


@pytest.mark.parametrize("size", LARGE, ids=str)
@pytest.mark.parametrize("key", ["f1", "f2"])
@pytest.mark.parametrize("name", ["idle", "slewing", "travler"])
def test_a_large_terminal_has_no_blank_block_and_all_of_it_inside(size, key, name, tmp_path):
    async def look(app, pilot):
        panes = [pane for pane in app.page.walk_children(Pane) if pane.is_on_screen and pane.region.area]
        return [(type(pane).__name__, pane.region, blank_area(pane)) for pane in panes], app.screen.region

    found, screen = run(look, name, size, key=key, sky=sky_stand_in.make(), presets_file=tmp_path / "none.toml")
    assert len(found) >= 4
    for what, region, blank in found:
        assert screen.contains_region(region), what
        assert blank <= 0.55 * region.area or blank < screen.area / 40, (what, region, blank)


def test_the_link_has_its_last_minutes_beside_its_figures_where_there_is_room():
    async def hear(app, pilot):
        clock, state = app.session.clock, app.station.state
        for reply in range(120):
            clock.advance(1.0)
            slow = 0.048 if reply == 60 else 0.012
            link = replace(state.link, last_reply=clock.monotonic(), round_trip_s=slow)
            app.station.state = replace(state, link=link)
            app.news(app.dishes.shown)
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), "".join(map("".join, app.query_one(HealthPane)._cells._chars[-5:]))

    text, strip = run(hear, size=(240, 70))
    assert "Link up for 3m, no stray bytes. Slowest reply 48 ms in the last 119s" in text
    assert sum("\u2800" < char <= "\u28ff" for char in strip) > 20
    assert "Slowest reply" not in run(hear, size=(160, 48))[0]


def test_no_time_is_told_of_a_link_that_is_down():
    assert "Slowest reply" not in run(read, "lost", (240, 70))
    assert "Link up for" not in run(read, "lost", (240, 70))


def test_passes_have_a_heading_and_their_elevation_where_there_is_room():
    async def rows(app, pilot):
        return ["".join(row) for row in app.query_one(NextPane)._cells._chars]

    lines = run(rows, size=(240, 70), sky=sky_stand_in.make())
    heading = next(y for y, line in enumerate(lines) if "In reach now and next" in line)
    assert any("\u2800" < char <= "\u28ff" for char in lines[heading + 2]), lines[heading + 2]
    assert not any(
        "\u2800" < char <= "\u28ff" for line in run(rows, size=(160, 48), sky=sky_stand_in.make()) for char in line
    )


def test_azimuth_stands_under_its_first_digit():
    position = {"az_deg": 10.53, "dish_az_deg": 10.53}

    async def rows(app, pilot):
        app.station.state = replace(app.station.state, position=replace(app.station.state.position, **position))
        app.paint()
        await pilot.pause()
        return ["".join(row) for row in app.query_one("#pointing")._cells._chars]

    lines = run(rows, size=(160, 48))
    label = next(line for line in lines if "azimuth" in line)
    digits = min(len(line) - len(line.lstrip()) for line in lines[:5] if line.strip())
    assert abs(label.index("azimuth") - digits) <= 2


@pytest.fixture
def presets(tmp_path):
    add_preset(tmp_path / "presets.toml", Preset("Wall", 250.4, 20.5))
    return tmp_path / "presets.toml"


def test_sun_moon_and_slots_stand_under_the_presets_and_enter_opens_the_goto_line(presets):
    async def choose(app, pilot):
        await pilot.press("p", "down")
        app.paint()
        await pilot.pause()
        text = stand_in.text_of(app)
        await pilot.press("enter")
        await pilot.pause()
        return text, app.query_one(GotoLine).query_one(Input).value, app.station.asked_for(Goto)

    text, typed, asked = run(choose, size=(200, 60), key="f2", sky=sky_stand_in.make(), presets_file=presets)
    assert "▶ Sun" in text
    assert "Moon" in text
    assert "101°W DIRECTV 101" in text
    assert typed == "sun"
    assert asked == [], "nothing moves before Enter in that line"


def test_a_direction_of_the_sky_is_neither_edited_nor_deleted(presets):
    async def try_it(app, pilot):
        await pilot.press("p", "down", "d")
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return stand_in.text_of(app), [preset.name for preset in app.presets.entries]

    text, names = run(try_it, size=(200, 60), key="f2", sky=sky_stand_in.make(), presets_file=presets)
    assert "Sun is no preset." in text
    assert names == ["Wall"]


def test_held_enter_on_a_direction_of_the_sky_releases_first(presets):
    async def press(app, pilot):
        await pilot.press("p", "down", "enter")
        await pilot.pause()
        return app.query_one(GotoLine).is_open, app.station.asked_for(Release)

    is_open, released = run(press, "held", (200, 60), key="f2", sky=sky_stand_in.make(), presets_file=presets)
    assert not is_open
    assert len(released) == 1


def test_what_was_told_takes_the_rows_of_passes_and_never_less_than_half():
    async def tell(app, pilot):
        few = stand_in.text_of(app)
        for number in range(60):
            app.note(f"Command {number} is done.")
        app.paint()
        await pilot.pause()
        return few, stand_in.text_of(app)

    few, many = run(tell, size=(240, 70), key="f2", sky=sky_stand_in.make())
    assert few.count("in reach") > 25
    assert many.count("is done.") >= 16
    assert "In reach now and next" in many


def test_names_of_passes_come_before_the_words_behind_their_figures():
    assert "METEOR-M2 4" in run(read, size=(200, 60), key="f2", sky=sky_stand_in.make())


@pytest.mark.parametrize("size", LARGE, ids=str)
def test_the_third_axis_leaves_air_above_the_arrows(size):
    async def regions(app, pilot):
        return (
            app.query_one("#turn-skew").region,
            app.query_one("#jog").region,
            app.query_one("#horizon").region,
            (app.query_one("#control-upper").region),
        )

    skew, jog, last, around = run(regions, "travler", size, key="f2")
    assert jog.y == skew.bottom + 1
    assert last.bottom < around.bottom


def test_the_error_of_the_last_minute_stands_beside_the_digits_while_the_dish_follows():
    async def pointing(app, _pilot, _desk):
        return ["".join(row) for row in app.query_one("#pointing")._cells._chars]

    rows = run_track(pointing, size=(240, 70), keys=("f1",))
    assert "error  max 0.0" in rows[0]
    assert sum("\u2800" < char <= "\u28ff" for row in rows[1:6] for char in row) > 20
    assert not any("error  max" in row for row in run_track(pointing, "craft-waiting", (240, 70), ("f1",)))
    assert not any("error  max" in row for row in run_track(pointing, size=(120, 36), keys=("f1",)))


def test_what_is_not_known_has_no_degree_sign_on_f2():
    async def digits(app, pilot):
        return ["".join(row) for row in app.query_one("#readout")._cells._chars]

    assert "°" not in "".join(run(digits, "not-homed", (240, 70), key="f2")[:5])


def test_the_keys_of_the_horizon_begin_where_the_others_do():
    text = run(read, size=(100, 30), key="f2")
    columns = {
        next(row for row in text.splitlines() if key in row).index(key) for key in ("H home", "v speed", "m mark  M")
    }
    assert len(columns) == 1
