"""The map of the world and the dish: what it follows is named there, and when it can follow the selected pass."""

import re
from types import SimpleNamespace

import pytest
import sky_stand_in
from birdcage.sky.world import SubPoint
from birdcage.station.pursuit_state import Phase
from birdcage_tui.passes.world_map_ask import reach_span_text
from test_world_map import VIEW, drawn, followed, rows_of


def follows(norad_id, name):
    plan = SimpleNamespace(aim=SimpleNamespace(norad_id=norad_id, name=name))
    pursuit = SimpleNamespace(plan=plan, phase=Phase.FOLLOWING)
    return SimpleNamespace(settings=VIEW.settings, pointer="◉", state=SimpleNamespace(pursuit=pursuit))


@pytest.mark.parametrize("chosen", [7, 1], ids=["another", "the chosen one"])
def test_what_the_dish_follows_is_named_as_that_among_many(chosen):
    crowd = [SubPoint(f"CROWD {n}", 100 + n, 60.0 - n, 4.0 * n, 800.0, favourite=True) for n in range(40)]
    world = followed(20.0, 10.0, satellites=(*crowd, SubPoint("LEO 1 polar", 7, -20.0, -90.0, 800.0)))
    _, cells = drawn(world, view=follows(chosen, "DEMO LEO 1 polar"))
    text = "\n".join(rows_of(cells))
    assert text.count("following ") == 1
    assert f"following {'LEO 1 polar' if chosen == 7 else 'METEOR'}" in text


def test_a_pass_in_view_that_the_dish_cannot_follow_says_so():
    row = sky_stand_in.rows()[0]
    spans = ((row.aos_s + 60.0, row.aos_s + 120.0), (row.aos_s + 240.0, row.aos_s + 300.0))
    told = sky_stand_in.changed(row, reach=sky_stand_in.in_reach(*spans))
    never = sky_stand_in.changed(row, reach=sky_stand_in.in_reach())
    assert reach_span_text(never, row.aos_s) == "never in reach"
    assert re.fullmatch(r"in reach \d\d:\d\d-\d\d:\d\d", reach_span_text(told, row.aos_s))
    assert re.fullmatch(r"in reach to \d\d:\d\d", reach_span_text(told, row.aos_s + 90.0))
    assert reach_span_text(told, row.aos_s + 301.0) == "no longer in reach"
