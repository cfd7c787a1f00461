"""The map of the sky on the Track tab: the target's name beside its mark and the dish's."""

import re
from dataclasses import replace

import pytest
import stand_in
from birdcage_tui.track.plot import TrackSky, target_place
from track_stage import run


@pytest.mark.parametrize("size", [(80, 24), (160, 48)], ids=str)
def test_the_name_of_the_target_keeps_off_the_dish_wherever_that_stands(size):
    async def around(app, pilot, _desk):
        found = []
        view = app.view()
        az_deg, el_deg = target_place(view)
        where = app.query_one(TrackSky).content_region
        for aside_deg in (-12.0, -8.0, -4.0, 0.0, 4.0, 8.0, 12.0):
            for above_deg in (-8.0, -4.0, 0.0, 4.0, 8.0):
                state = app.station.state
                place = replace(state.position, az_deg=(az_deg + aside_deg) % 360.0, el_deg=el_deg + above_deg)
                app.station.state = replace(state, position=place)
                app.paint()
                await pilot.pause()
                rows = [
                    row[where.x : where.right] for row in stand_in.text_of(app).splitlines()[where.y : where.bottom]
                ]
                found.append("\n".join(rows))
        return found

    for text in run(around, "craft-keyhole", size=size):
        assert "◉" in text, text
        assert not re.search(r"\w◉|◉\w", text), text
        assert "SUOMI NPP" in text
