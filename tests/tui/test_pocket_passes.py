"""The pocket view picks a pass: listed, selected and followed by keys or by a finger alone, at every small size."""

from __future__ import annotations

import re

import pytest
import stand_in
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Jog, Pursue, Release
from birdcage_tui.pocket.keys import PocketKeys, StopBar
from birdcage_tui.pocket.passes import NextList, PocketOffer, PocketPasses
from desk_house import play

SIZES = [(40, 12), (50, 16), (60, 20), (79, 23)]
sizes = pytest.mark.parametrize("size", SIZES, ids=str)


async def to_list(house, *keys):
    """Home the dish, let the search end, and open the list."""
    await house.home()
    await house.press("f", *keys)
    await house.look()
    await house.look()


def pursuits(house):
    return [each for each in house.asked if isinstance(each, Pursue)]


async def tap(house, command):
    """Press the button of a command."""
    pane = house.app.query_one(PocketKeys)
    spot = next(region for region, name in pane.hot if name == command)
    await house.pilot.click(pane, offset=(spot.x + spot.width // 2, spot.y))
    await house.look()


@sizes
def test_a_pass_is_seen_selected_planned_and_followed(tmp_path, size):
    async def follow(house):
        await to_list(house)
        listed = stand_in.text_of(house.app)
        rows = house.app.query_one(NextList)
        await house.press("down")
        await house.look()
        moved, picked = stand_in.text_of(house.app), rows.chosen
        await house.press("enter")
        for _ in range(3):
            offered = await house.look()
        before = pursuits(house)
        stop = house.app.query_one(StopBar).region
        covered = [kind for kind in (NextList, PocketOffer, PocketKeys)
                   if house.app.query_one(kind).region.overlaps(stop)]  # fmt: skip
        await house.press("enter")
        await house.look()
        await house.look()
        return listed, moved, picked, offered, before, covered, pursuits(house), house.app.query_one(PocketPasses)

    listed, moved, picked, offered, before, covered, after, pane = play(tmp_path, follow, size)
    first, second = [row for row in listed.splitlines() if re.search(r"\d\d:\d\d +\S.*\d\d° +\S*m", row)][:2]
    assert first.startswith("▶")
    assert not second.startswith("▶")
    assert f"▶{second[1:6]}" in moved
    assert picked.name[:8] in second
    assert re.search(rf"{picked.max_el_deg:.0f}° +\d+m", second), "how high, and for how long in reach"
    assert re.search(rf"Enter follows {re.escape(picked.name)}.*: the dish goes to \d+°/\d+° ", offered)
    assert "S T O P" in offered
    assert covered == []
    assert before == [], "the first Enter only shows the plan"
    (pursue,) = [each for each in after if each.renews is None]
    assert abs(pursue.plan.passing.tca.timestamp() - picked.tca_s) < 60
    assert not pane.display, "the readings are back"


@sizes
def test_a_finger_alone_does_the_same(tmp_path, size):
    async def follow(house):
        await to_list(house)
        await tap(house, "pocket-back")
        closed = not house.app.query_one(PocketPasses).display
        await tap(house, "pocket-passes")
        await tap(house, "pocket-pass-down")
        await tap(house, "pocket-pass-up")
        rows = house.app.query_one(NextList)
        await house.pilot.click(rows, offset=(9, 2))
        picked = rows.chosen
        await tap(house, "pocket-pick")
        await house.look()
        await tap(house, "offer-follow")
        await house.look()
        return closed, picked, pursuits(house)

    closed, picked, asked = play(tmp_path, follow, size)
    assert closed
    assert asked[0].plan.aim.norad_id == picked.norad_id


def test_esc_leads_back_a_step_at_a_time_and_nothing_is_followed_or_stepped(tmp_path):
    async def back(house):
        await to_list(house, "down", "l")
        offered = house.app.query_one(PocketOffer).display
        await house.press("escape")
        await house.look()
        listed = house.app.query_one(PocketOffer).display, house.app.query_one(PocketPasses).display
        await house.press("escape")
        text = await house.look()
        await house.press("enter")
        await house.look()
        return offered, listed, text, house.asked, house.app.view().state.held

    offered, listed, text, asked, held = play(tmp_path, back, (40, 12))
    assert offered
    assert listed == (False, True)
    assert "cable" in text
    assert [each for each in asked if isinstance(each, Pursue | Jog)] == []
    assert held is None


def test_space_stops_what_is_followed_from_the_list_and_enter_releases_first(tmp_path):
    async def stop(house):
        await to_list(house, "enter")
        await house.look()
        await house.press("enter")
        for _ in range(3):
            await house.look(1.0)
        phase = house.app.view().state.pursuit.phase
        await house.press("f", "space")
        for _ in range(3):
            await house.look(1.0)
        held, text = house.app.view().state.held, await house.look()
        house.asked.clear()
        await house.press("enter")
        await house.look()
        return phase, held, text, [type(each) for each in house.asked if isinstance(each, Release | Pursue)]

    phase, held, text, asked = play(tmp_path, stop, (40, 12))
    assert phase is not Phase.OVER
    assert held is not None
    assert "HELD by you" in text
    assert "leaves in" in text, "the passes are seen below it"
    assert asked == [Release]


def test_the_list_makes_room_for_the_go_to_line_and_no_arrow_steps_the_dish_behind_it(tmp_path):
    async def elsewhere(house):
        await to_list(house, "g")
        shown = house.app.query_one(PocketPasses).display
        await house.press("escape")
        await house.look()
        await house.press("up")
        return shown, house.app.query_one(PocketPasses).display, [each for each in house.asked if isinstance(each, Jog)]

    assert play(tmp_path, elsewhere, (40, 12)) == (False, True, [])
