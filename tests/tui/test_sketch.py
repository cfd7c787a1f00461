"""The horizon drawn: with the mouse, with the arrows, and what becomes of the line beside it."""

import re

import pytest
import stage
import stand_in
from birdcage.sky.horizon import HorizonMask
from birdcage.station.requests import Goto, Jog
from birdcage_tui.control.sketch import TOP_DEG, Sketch
from birdcage_tui.control.sketch_screen import SCALE, SketchPane
from horizon_stand_in import TREES, File

SIZES = [(80, 24), (120, 36), (160, 48), (200, 60)]


def run(test, size=(120, 36), file=None):
    return stage.run(test, "idle", size, key="f2", horizon=File() if file is None else file)


async def opened(app, pilot):
    await pilot.press("D")
    await pilot.pause()
    await pilot.pause()
    return app.screen.query_one(SketchPane)


async def closed(app, pilot, key):
    await pilot.press(key)
    await pilot.pause()
    await pilot.pause()
    return stand_in.text_of(app)


def test_what_was_drawn_replaces_the_line_there_and_nothing_elsewhere():
    sketch = Sketch(TREES, 72)
    sketch.line((20, 30.0), (26, 30.0))
    mask = sketch.mask()
    for column in range(20, 27):
        assert mask.at(sketch.azimuth(column)) == pytest.approx(30.0)
    for az_deg in (0, 40, 80, 95, 145, 189, 250, 300, 350):
        assert mask.at(az_deg) == pytest.approx(TREES.at(az_deg), abs=0.3)


def test_a_line_is_drawn_through_columns_that_the_mouse_jumps_over():
    sketch = Sketch(HorizonMask(), 72)
    sketch.line((10, 5.0), (20, 25.0))
    assert [sketch.heights[column] for column in (10, 15, 20)] == pytest.approx([5.0, 15.0, 25.0])
    assert len(sketch.mask().points) == 4  # both ends of the slope, and the flat line beside each


def test_heights_stay_in_the_picture_and_nothing_drawn_changes_nothing():
    sketch = Sketch(TREES, 72)
    assert sketch.mask() == TREES
    sketch.put(3, 80.0)
    sketch.put(4, -9.0)
    assert (sketch.heights[3], sketch.heights[4]) == (TOP_DEG, 0.0)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_drag_of_the_mouse_draws_the_tree_line(size):
    async def drag(app, pilot):
        pane = await opened(app, pilot)
        region = pane.content_region
        assert app.screen.region.contains_region(region)
        assert region.height >= 10
        row = region.height - 2 - round((region.height - 2) * 20.0 / TOP_DEG)
        start, end = SCALE + pane.sketch.columns // 4, SCALE + pane.sketch.columns // 2
        await pilot.mouse_down(pane, offset=(start, row))
        await pilot.hover(pane, offset=(end, row))
        await pilot.mouse_up(pane, offset=(end, row))
        text = await closed(app, pilot, "enter")
        return text, app.view().horizon.mask, app.station.asked_for(Jog) + app.station.asked_for(Goto)

    file = File(HorizonMask())
    text, mask, asked = run(drag, size, file)
    assert "Saved the drawn horizon" in text
    assert mask.at(135.0) == pytest.approx(20.0, abs=2.0)
    assert mask.at(300.0) == mask.at(30.0) == 0.0
    assert file.mask == mask
    assert asked == []


def test_arrows_draw_too_and_z_takes_it_back():
    async def draw(app, pilot):
        await opened(app, pilot)
        await pilot.press("right", "right", "up", "up", "up")
        await closed(app, pilot, "enter")
        drawn = app.view().horizon.mask
        return drawn, await closed(app, pilot, "z"), app.view().horizon.mask

    drawn, text, after = run(draw, file=File(HorizonMask()))
    assert max(el_deg for _, el_deg in drawn.points) == 3.0
    assert after == HorizonMask()
    assert "undid the last change" in text


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_axis_has_north_at_both_ends_also_under_the_cursor(size):
    async def axis(app, pilot):
        pane = await opened(app, pilot)
        rows = []
        for key in ("right", "left", "left"):
            await pilot.press(key)
            await pilot.pause()
            rows.append("".join(segment.text for segment in pane._strips[pane.size.height - 2])[SCALE:])
        return rows

    for row in run(axis, size=size):
        letters = re.sub("[^NESW]", "", row.replace("◉", ""))
        assert letters == "NESWN", row
        assert row[0] == "N"
        assert row.rstrip()[-1] == "N"


def test_esc_keeps_nothing():
    async def leave(app, pilot):
        await opened(app, pilot)
        await pilot.press("up", "up")
        await closed(app, pilot, "escape")
        return app.view().horizon.mask

    assert run(leave, file=File(TREES)) == TREES
