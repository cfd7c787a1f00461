"""On the sky map a name stands in the row of its dot, one blank beside it, or else in the next row and close by."""

from __future__ import annotations

import pytest
import sky_stand_in
from birdcage_tui.drawing.polar import Polar
from birdcage_tui.panes.sky import SkyPane
from stage import run

SIZES = [(80, 24), (100, 30), (120, 36), (160, 48), (240, 70)]


async def distances(app, _pilot):
    """How many rows and blanks lie between each name that is written and its dot."""
    pane = app.query_one(SkyPane)
    view, cells = pane.view, pane._cells
    rows = ["".join(char or " " for char in row) for row in cells._chars]
    polar = Polar(cells.width, cells.height, view.settings.cell_aspect)
    found = {}
    for one in view.sky.up:
        x, y = polar.cell(one.az_deg, one.el_deg)
        spots = [(row.index(one.name), at) for at, row in enumerate(rows) if one.name in row]
        if spots and not one.fixed:
            end = next(at for at in range(spots[0][0], cells.width + 1) if rows[spots[0][1]][at : at + 2].strip() == "")
            blanks = max(spots[0][0] - x - 1, x - end, 0)
            found[one.name] = abs(spots[0][1] - y), blanks
    return found


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_each_name_stands_beside_its_dot_or_in_the_next_row(size):
    found = run(distances, "idle", size, sky=sky_stand_in.make())
    assert found
    assert all(rows <= 1 and blanks <= 2 for rows, blanks in found.values()), found
    beside = [name for name, (rows, _) in found.items() if rows == 0]
    assert beside, found
    assert size < SIZES[2] or len(beside) * 2 > len(found), found
