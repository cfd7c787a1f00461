"""The picture of a map before it has colours: what was heard, what is a neighbour's, and what is neither."""

from __future__ import annotations

import numpy as np
import pytest
from birdcage.skymap.colour_maps import COLOUR_MAPS
from birdcage.skymap.plan import MapFrame, MapOrder, MapPlan
from birdcage_tui.drawing.themes import LOOKS, contrast
from birdcage_tui.signal.map_chart import MapChart
from birdcage_tui.signal.map_inks import ASCII, SHADES, colours_for, glyph, inks_of, next_colours, over, pair
from birdcage_tui.signal.map_raster import LEVELS, UNKNOWN, filled, raster

NAN = float("nan")
PLAN = MapPlan(0.0, 31.0, 10.0, 25.0, 1.0)


def grid_of(plan, heard):
    grid = np.full(plan.cells, NAN)
    for cell in plan.sequence[:heard]:
        grid[cell] = cell
    return grid.reshape(plan.rows, plan.columns)


def test_a_coarse_pass_lends_each_direction_the_value_of_its_nearest_neighbour():
    coarse = 2 * 4  # every eighth row and column
    shown = filled(PLAN, grid_of(PLAN, coarse))
    assert not np.isnan(shown).any()
    assert shown[0, 3] == 0.0
    assert shown[0, 5] == 8.0
    assert shown[7, 0] == 8 * 32


def test_what_was_heard_itself_goes_before_any_neighbour_and_a_finer_pass_before_a_coarser():
    shown = filled(PLAN, grid_of(PLAN, 8 + 1))
    cell = PLAN.sequence[8]
    row, column = divmod(cell, PLAN.columns)
    assert shown[row, column] == cell
    assert filled(PLAN, grid_of(PLAN, PLAN.cells))[5, 5] == 5 * 32 + 5


def test_maps_in_another_order_lend_nothing():
    plan = MapPlan(0.0, 31.0, 10.0, 25.0, 1.0, MapOrder.ROWS)
    assert int(np.isnan(filled(plan, grid_of(plan, 40))).sum()) == plan.cells - 40


def test_levels_tell_heard_from_neighbour_from_nothing():
    plan = MapPlan(0.0, 3.0, 10.0, 11.0, 1.0, MapOrder.ROWS)
    grid = np.array([[0.0, 5.0, 10.0, NAN], [NAN, NAN, NAN, NAN]])
    levels = raster(plan, grid, (4, 2), (0.0, 10.0))
    assert levels.tolist() == [[UNKNOWN] * 4, [0, LEVELS // 2, LEVELS - 1, UNKNOWN]]
    coarse = MapPlan(0.0, 31.0, 10.0, 25.0, 1.0)
    seen = raster(coarse, grid_of(coarse, 8), (32, 16), (0.0, 512.0))
    assert int((seen >= LEVELS).sum()) == coarse.cells - 8
    assert int(((seen >= 0) & (seen < LEVELS)).sum()) == 8


def test_of_directions_that_fall_into_one_pixel_the_loudest_is_seen():
    plan = MapPlan(0.0, 359.0, 5.0, 64.0, 1.0, MapOrder.ROWS)
    grid = np.zeros((60, 360))
    grid[30, 200] = 100.0
    levels = raster(plan, grid, (120, 60), (0.0, 100.0))
    assert levels.max() == LEVELS - 1
    assert np.argwhere(levels == LEVELS - 1).tolist() == [[59 - 30, 200 // 3]]


def test_a_pixel_and_the_cell_under_it_are_the_same_direction():
    plan = MapPlan(350.0, 380.0, 18.0, 50.0, 1.0)
    chart = MapChart.within(plan, 126, 32, 2.0)
    grid = np.arange(float(plan.cells)).reshape(plan.rows, plan.columns)
    levels = raster(plan, grid, (chart.width, 2 * chart.height), (0.0, float(plan.cells)))
    for x, y in ((0, 0), (chart.width - 1, chart.height - 1), (17, 3), (60, 20)):
        cell = chart.cell(x + 0.5, y + 0.25)
        assert levels[2 * y, x] == cell * LEVELS // plan.cells
    for cell in (0, 7, plan.cells - 1):
        assert chart.cell(*chart.spot_of(cell)) == cell


def test_azimuths_run_on_through_north_and_offsets_have_their_sign():
    chart = MapChart.within(MapPlan(350.0, 380.0, 18.0, 50.0, 1.0), 120, 30, 2.0)
    assert [chart.x_text(deg) for deg in chart.x_ticks(20)] == ["350°", "0°", "10°", "20°"]
    assert chart.x(chart.unrolled(5.0)) == pytest.approx(chart.x(365.0))
    around = MapChart.within(MapPlan(-5.0, 5.0, -5.0, 5.0, 0.5, frame=MapFrame.TARGET), 100, 30, 2.0)
    assert [around.x_text(deg) for deg in around.x_ticks(12)] == ["-4°", "-2°", "0°", "+2°", "+4°"]


def test_a_target_is_round_and_no_degree_is_thrice_as_long_as_the_other():
    around = MapChart.within(MapPlan(-5.0, 5.0, -5.0, 5.0, 0.5, frame=MapFrame.TARGET), 150, 30, 2.0)
    assert (around.width / around.height / 2.0) == pytest.approx(1.3, abs=0.1)
    sky = MapChart.within(MapPlan(0.0, 359.0, 18.0, 27.0, 1.0), 120, 40, 2.0)
    assert 2.0 * sky.height / 10 <= 3.1 * sky.width / 360


@pytest.mark.parametrize("theme", LOOKS)
@pytest.mark.parametrize("colours", COLOUR_MAPS)
def test_words_and_lines_are_legible_on_every_level(theme, colours):
    inks = inks_of(theme, colours_for(colours, theme))
    for ink in ("text", "strong", "target", "accent-strong"):
        least = 2.2 if theme == "night" else 2.6  # its text has 5 on its ground
        for level in range(-1, 2 * LEVELS):
            style = inks[over(ink, level)]
            assert contrast(style.color.get_truecolor().hex, style.bgcolor.get_truecolor().hex) >= least


@pytest.mark.parametrize("colours", COLOUR_MAPS)
def test_the_night_is_red_whatever_was_chosen(colours):
    inks = inks_of("night", colours_for(colours, "night"))
    for level in range(2 * LEVELS):
        red, green, blue = inks[pair(level, level)].bgcolor.get_truecolor()
        assert red >= green and red >= blue  # noqa: PT018 - one fact
        assert green <= 80
        assert blue <= 80


def test_what_was_not_heard_itself_is_nearer_to_the_ground():
    for theme, look in LOOKS.items():
        inks = inks_of(theme, colours_for("blue-yellow", theme))
        for level in (0, LEVELS // 2, LEVELS - 1):
            heard, lent = contrast(inks.colour(level), look.ground), contrast(inks.colour(level + LEVELS), look.ground)
            assert lent < heard or heard < 1.3


def test_the_glyphs_of_a_poor_terminal_rise_with_the_level():
    for ascii_only, ramp in ((True, ASCII), (False, SHADES)):
        told = [glyph(level, ascii_only=ascii_only) for level in range(LEVELS)]
        assert "".join(dict.fromkeys(told)) == ramp
        assert glyph(UNKNOWN, ascii_only=ascii_only) not in ramp


def test_the_colours_take_turns():
    names, now = [], ""
    for _ in COLOUR_MAPS:
        now = next_colours(now)
        names.append(now)
    assert sorted(names) == sorted(COLOUR_MAPS)
