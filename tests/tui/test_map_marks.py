"""What lies on a map stands where it is: horizon, Sun, satellites with names that keep apart, the beam."""

from __future__ import annotations

from datetime import UTC, datetime
from itertools import pairwise

import pytest
import stand_in
from birdcage.base.beam import Beam
from birdcage.sky.horizon import HorizonMask
from birdcage.sky.sun import sun
from birdcage.skymap.plan import MapPlan
from birdcage_tui.drawing.canvas import Braille
from birdcage_tui.signal.map_chart import MapChart
from birdcage_tui.signal.map_marks import (
    MARK,
    NamedSpot,
    draw_beam,
    draw_horizon,
    draw_names,
    draw_sun_path,
    slots_over,
    sun_path,
)
from birdcage_tui.signal.map_overlay import MapOverlay

PLAN = MapPlan(120.0, 240.0, 10.0, 60.0, 1.0)
NOON = datetime(2026, 3, 20, 18, 20, tzinfo=UTC)


def on_chart(width=121, height=34, plan=PLAN):
    chart = MapChart.within(plan, width, height, 2.0)
    return chart, MapOverlay(chart.width, chart.height)


def names_in(overlay, spots):
    """Return the rows and columns of each name that stands whole."""
    rows = [
        "".join(overlay.signs.get((x, y), (" ", ""))[0] for x in range(overlay.width)) for y in range(overlay.height)
    ]
    found = {}
    for spot in spots:
        label = spot.label.replace("°", "")
        for y, row in enumerate(rows):
            at = f" {row} ".find(f" {label} ")
            if at >= 0:
                found[label] = (y, at, len(label))
    return found


def test_every_satellite_in_the_region_is_marked_where_it_stands():
    chart, overlay = on_chart()
    seen = [each for each in slots_over(stand_in.PLACE) if chart.holds(*chart.spot(each.az_deg, each.el_deg))]
    draw_names(overlay, chart, slots_over(stand_in.PLACE), 2.6)
    marked = {spot for spot, (sign, _ink) in overlay.signs.items() if sign == MARK}
    assert marked == {tuple(map(int, chart.spot(each.az_deg, each.el_deg))) for each in seen}
    assert len(names_in(overlay, seen)) == len(seen) > 5


@pytest.mark.parametrize("width", [40, 60, 121])
def test_names_never_lie_on_one_another_and_the_first_ones_lie_far_apart(width):
    chart, overlay = on_chart(width, 8 if width == 40 else 20)
    crowd = [NamedSpot(f"{each}W", 140.0 + each * 0.9, 30.0 + 10.0 * (each % 2) / 10.0) for each in range(90)]
    draw_names(overlay, chart, crowd, 2.6)
    found = names_in(overlay, crowd)
    assert found
    places = sorted(found.values())
    for (y, x, length), (other_y, other_x, _) in pairwise(places):
        assert y != other_y or other_x > x + length, "a gap is between them"
    assert max(x for _, x, _ in places) - min(x for _, x, _ in places) > chart.width // 3


def test_the_horizon_is_as_high_as_it_is_at_each_azimuth():
    chart, overlay = on_chart()
    mask = HorizonMask([(120.0, 20.0), (180.0, 40.0), (240.0, 20.0), (0.0, 12.0)])
    draw_horizon(overlay, chart, mask)
    for az_deg in (130.0, 180.0, 220.0):
        x, y = (int(each) for each in chart.spot(az_deg, mask.at(az_deg)))
        assert any((x, row) in overlay.signs for row in (y - 1, y, y + 1))
        assert (x, y + 4) not in overlay.signs
    chart, overlay = on_chart()
    draw_horizon(overlay, chart, HorizonMask([(180.0, 40.0)]))
    assert not overlay.signs, "one point is no line"


def test_the_suns_path_goes_by_where_the_sun_stands():
    chart, overlay = on_chart()
    path = sun_path(stand_in.PLACE, NOON)
    draw_sun_path(overlay, chart, path)
    x, y = chart.spot(*sun(NOON, stand_in.PLACE.latitude_deg, stand_in.PLACE.longitude_deg))
    assert chart.holds(x, y)
    assert any((int(x) + dx, int(y) + dy) in overlay.signs for dx in (-1, 0, 1) for dy in (-1, 0, 1))
    columns = sorted({x for x, _ in overlay.signs})
    assert columns[0] <= 2
    assert columns[-1] >= chart.width - 3, "it enters at one side and leaves at the other"


def test_the_suns_path_through_north_draws_no_line_across_the_map():
    plan = MapPlan(0.0, 359.0, 0.0, 60.0, 1.0)
    chart, overlay = on_chart(120, 30, plan)
    draw_sun_path(overlay, chart, [(350.0, 30.0), (355.0, 30.0), (5.0, 30.0), (10.0, 30.0)])
    assert all(x < 6 or x > 114 for x, _ in overlay.signs)


def test_the_beam_is_wider_in_azimuth_the_higher_it_looks():
    chart, _ = on_chart()

    def span(el_deg):
        canvas = Braille(chart.width, chart.height)
        draw_beam(canvas, chart, chart.spot(180.0, el_deg), Beam(6.0, 6.0), el_deg)
        columns, rows = zip(*((x, y) for x, y, _sign, _ink in canvas.signs()), strict=True)
        return max(columns) - min(columns) + 1, max(rows) - min(rows) + 1

    low, high = span(15.0), span(55.0)
    assert low[0] == pytest.approx(6.2 / 121 * chart.width, abs=1.5)
    assert high[0] == pytest.approx(10.5 / 121 * chart.width, abs=1.5)
    assert low[1] == pytest.approx(6.0 / 51 * chart.height, abs=1.5)


def test_rows_lie_as_far_apart_as_they_were_heard():
    chart, _ = on_chart(plan=MapPlan(120.0, 240.0, 10.0, 60.0, 1.0, y_step_deg=5.0))
    assert chart.tall_deg == 55.0
    assert chart.low_deg == 7.5
