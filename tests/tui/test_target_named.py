"""The target alone is in its colour, named at its mark; hatching says what cannot be reached, and nothing else."""

import asyncio
from dataclasses import replace

import pytest
import sky_stand_in
import track_stage
import track_stand_in
from birdcage.sky.geostationary import slots_in_sight
from birdcage_tui.panes.next import NextPane
from birdcage_tui.panes.sky import SkyPane
from birdcage_tui.track.plot import TrackSky
from stage import run
from track_plans import geo

SIZES = [(80, 24), (120, 36), (160, 48), (240, 70)]
IN_ITS_COLOUR = ("target", "target-strong")


def cells_of(app, kind):
    cells = app.query_one(kind)._cells
    return ["".join(row) for row in cells._chars], cells._inks


def shown(scene, size, kind, *keys):
    async def play():
        app = track_stand_in.app_in(scene, sky=sky_stand_in.make())
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            await pilot.press(*keys)
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return cells_of(app, kind), app.query_one(kind).border_title

    return asyncio.run(play())


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_the_arc_is_quiet_while_nothing_is_the_target(size):
    async def inks(app, _pilot):
        return {ink for row in cells_of(app, SkyPane)[1] for ink in row}

    found = run(inks, "idle", size, sky=sky_stand_in.make(), state={"target_az_deg": None, "target_el_deg": None})
    assert not found & set(IN_ITS_COLOUR)


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize(("kind", "keys"), [(SkyPane, ("1",)), (TrackSky, ("2", "c"))], ids=("sky", "track"))
def test_the_target_is_named_beside_its_mark_at_every_size(size, kind, keys):
    (rows, inks), title = shown("craft-following", size, kind, *keys)
    mark = next(
        (x, y) for y, row in enumerate(rows) for x, char in enumerate(row) if char == "✕" and "✕ target" not in row
    )
    named = [(row.index("METEOR-M2 4"), y) for y, row in enumerate(rows) if "METEOR-M2 4" in row]
    assert len(named) == 1, "\n".join(rows)
    x, y = named[0]
    assert abs(y - mark[1]) <= 1, "\n".join(rows)
    assert -14 <= mark[0] - x <= 24, "\n".join(rows)
    assert inks[y][x] == "target-strong"
    assert "▨ cannot reach" in title
    assert "▨" not in "".join(rows), "the ends of the cable have a sign of their own"
    assert sum(row.count("║") for row in rows) >= 1
    assert "║ cable stop" in title or "║ stop" in title


def test_a_pass_in_reach_that_is_not_the_target_is_not_in_its_colour():
    async def inks(app, _pilot):
        return {ink for row in cells_of(app, NextPane)[1] for ink in row}

    assert not run(inks, "idle", (160, 48), sky=sky_stand_in.make()) & set(IN_ITS_COLOUR)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_a_target_of_old_elements_is_named_with_the_sign_of_those(size):
    async def play():
        up = tuple(replace(one, old=one.name == "METEOR-M2 4") for one in sky_stand_in.picture().up)
        app = track_stand_in.app_in("craft-following", sky=sky_stand_in.make(up=up))
        async with app.run_test(size=size) as pilot:
            await pilot.pause()
            app.paint()
            await pilot.pause()
            return "\n".join(cells_of(app, SkyPane)[0]), str(app.query_one(SkyPane).border_subtitle)

    text, legend = asyncio.run(play())
    assert "? METEOR-M2 4" in text
    assert "? " in legend
    assert "old" in legend


@pytest.mark.parametrize("size", [(120, 36), (160, 48)], ids=str)
def test_a_slot_that_is_followed_is_named_once(size):
    async def follow(app, pilot, _desk):
        place, state = app.settings.place, app.station.state
        in_sight = slots_in_sight(place.latitude_deg, place.longitude_deg, 18.0, 65.0)
        slot, az_deg, el_deg = next(each for each in in_sight if each[0].label == "119°W")
        plan = geo("119.0°W EchoStar", az_deg=az_deg, el_deg=el_deg)
        app.station.state = replace(
            state, pursuit=replace(state.pursuit, plan=plan), target_az_deg=az_deg, target_el_deg=el_deg
        )
        app.paint()
        await pilot.pause()
        return slot.label, "\n".join(cells_of(app, SkyPane)[0])

    label, text = track_stage.run(follow, "craft-geo", size, keys=("f1",), sky=sky_stand_in.make(up=()))
    assert text.count("119.0°W EchoStar") == 1, text
    assert label not in text, text
