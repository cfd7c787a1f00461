"""What a key is said to do is what it does: while the dish can't be moved, its offers name what mends that."""

from __future__ import annotations

import pytest
import sky_stand_in
import stand_in
from birdcage.station.requests import Release
from birdcage_tui.widgets.dialogs import QuestionScreen
from desk_house import play
from stage import run

UNHOMED = "sim:g2?seed=1&unhomed=1"


def footer(text):
    return text.splitlines()[-1]


async def last_row(app, _pilot):
    return footer(stand_in.text_of(app))


async def to_offer(house):
    for _ in range(8):
        await house.look(1.0)
    await house.press("f7", "f")
    for _ in range(4):
        await house.look()


def test_the_footer_offers_homing_in_place_of_following_while_the_dish_is_not_homed(tmp_path):
    async def offer(house):
        await to_offer(house)
        row = footer(stand_in.text_of(house.app))
        bar = house.app.query_one("KeyBar")
        spot = next(region for region, name in bar.hot if name == "home")
        await house.pilot.click("KeyBar", offset=(spot.x + 1, 0))
        await house.look()
        return row, house.app.screen, [name for _, name in bar.hot]

    row, screen, hot = play(tmp_path, offer, port=UNHOMED)
    assert " H home first " in row
    assert "follow" not in row
    assert hot.count("home") == 1
    assert isinstance(screen, QuestionScreen), "a click homes, as the key does"


def test_the_tab_says_that_homing_comes_before_following(tmp_path):
    async def tab(house):
        await to_offer(house)
        await house.press("escape")
        return await house.look()

    text = play(tmp_path, tab, (160, 48), port=UNHOMED)
    assert "follow it now" not in text
    assert "H homes the dish first, then f" in text


@pytest.mark.parametrize(
    ("state", "keys", "offered", "lacks"),
    [
        ("idle", (), " f follow ", "first"),
        ("not-homed", (), " f targets ", "follow"),
        ("not-homed", ("f7",), " f plan ", "follow"),
        ("not-homed", ("f2", "n"), " H home first ", "nudge"),
        ("held", ("f7",), " f plan ", "follow"),
        ("held", ("f2", "p"), " Enter release ", "Enter go"),
        ("held", ("f2", "n"), " Enter release ", "nudge"),
        ("fault", ("f2", "p"), " Enter acknowledge ", "Enter go"),
        ("refused", ("f2", "p"), " Enter own limits ", "Enter go"),
        ("travler-not-homed", ("f2", "n"), " not homed ", "home first"),
        ("silent", ("f2", "n"), " no answer ", "nudge"),
    ],
)
def test_the_footer_says_what_is_the_case(state, keys, offered, lacks, kept):
    async def go(app, pilot):
        await pilot.press(*keys)
        await pilot.pause()
        app.paint()
        await pilot.pause()
        return await last_row(app, pilot)

    row = run(go, state, (160, 48), sky=sky_stand_in.make(), presets_file=kept)
    assert offered in row
    assert lacks not in row


def test_enter_does_what_the_footer_says_while_held(kept):
    async def go(app, pilot):
        await pilot.press("f2", "p", "enter")
        return app.station.asked

    assert [each for each in run(go, "held", presets_file=kept) if isinstance(each, Release)]
