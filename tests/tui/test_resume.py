"""After STOP or a step by hand one key goes on with the pass, autotrack included; the line says where the dish goes."""

from __future__ import annotations

import re

import pytest
import stand_in
from birdcage.base.paths import Paths
from birdcage.sky.catalogue import Catalogue
from birdcage.station.pursuit_state import Phase
from birdcage.station.requests import Home, Pursue, Release, ReleaseLease
from birdcage_tui.panes.next_steps import next_steps
from desk_house import play

SIZES = [(80, 24), (120, 36)]


async def follow(house):
    """Have NOAA 20, which is up and in reach, followed."""
    house.session.station.submit(Home("you"))
    house.session.step(60.0)
    await house.look()
    await house.press("f2", "c", "slash")
    await house.type("noaa 20")
    await house.press("enter")
    await house.look()
    await house.press("f", "enter", "f1")
    for _ in range(12):
        await house.look(1.0)
    assert house.app.view().state.pursuit.phase is Phase.FOLLOWING
    house.asked.clear()


def sent(house):
    asked = [each for each in house.asked if isinstance(each, Pursue | Release | ReleaseLease)]
    return [type(each) for each in asked if getattr(each, "renews", None) is None]


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_after_stop_one_key_releases_and_goes_on_and_the_line_names_it(tmp_path, size):
    async def stop(house):
        await follow(house)
        await house.press("space")
        for _ in range(3):
            held = await house.look(1.0)
        quiet, held = sent(house), f"{held} {next_steps(house.app.view())}"
        await house.press("U")
        for _ in range(8):
            await house.look(1.0)
        state = house.app.view().state
        return held, quiet, sent(house), state.held, state.pursuit

    held, quiet, asked, latch, pursuit = play(tmp_path, stop, size)
    assert re.search(
        r"HELD by you .* Enter release: nothing moves then U resume NOAA 20 \(JPSS-1\) \(\d:\d\d left\): dish moves to "
        r"\d+°/\d+°", held,
    ), held  # fmt: skip
    assert "birdcage sends no motion until you press Enter or U." in held
    assert quiet == []
    assert asked == [Release, Pursue]
    assert latch is None
    assert pursuit.phase is Phase.FOLLOWING
    assert pursuit.plan.aim.norad_id == 43013


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_after_a_step_by_hand_one_key_gives_control_back_and_goes_on(tmp_path, size):
    async def step(house):
        await follow(house)
        await house.press("right")
        for _ in range(3):
            text = await house.look(1.0)
        phase = house.app.view().state.pursuit.phase
        quiet = sent(house)
        await house.press("U")
        for _ in range(8):
            await house.look(1.0)
        return text, phase, quiet, sent(house), house.app.view().state.pursuit

    text, phase, quiet, asked, pursuit = play(tmp_path, step, size)
    assert phase is Phase.YIELDED
    assert re.search(r"U resume NOAA 20 \(JPSS-1\) \(\d:\d\d left\): dish moves to \d+°/\d+°", text), text
    assert quiet == []
    assert asked[:2] == [ReleaseLease, Pursue]
    assert pursuit.phase is Phase.FOLLOWING


def test_autotrack_that_stop_has_switched_off_goes_on_too(tmp_path):
    async def stop(house):
        with Catalogue(Paths.in_folder(tmp_path).catalogue) as catalogue:
            catalogue.set_favourite(43013)
        house.session.station.submit(Home("you"))
        house.session.step(60.0)
        await house.look(6.0)
        await house.press("f2", "c", "A", "enter")
        for _ in range(20):
            await house.look(1.0)
        on = house.app.track.now.autotrack, house.app.view().state.pursuit.phase
        await house.press("space")
        for _ in range(3):
            held = await house.look(1.0)
        off = house.app.track.now.autotrack
        house.asked.clear()
        await house.press("U")
        for _ in range(8):
            await house.look(1.0)
        return on, held, off, house.app.track.now.autotrack, sent(house), house.app.view().state.pursuit.phase

    on, held, off, again, asked, phase = play(tmp_path, stop, (120, 36))
    assert on == (True, Phase.FOLLOWING)
    assert re.search(r"U resume \S.* \+ autotrack \(\d:\d\d left\): dish moves to", held), held
    assert off is False
    assert again is True
    assert asked == [Release, Pursue], "autotrack does not ask for the same pass a second time"
    assert phase is Phase.FOLLOWING


@pytest.mark.parametrize("keys", [("f2", "c", "x"), ("f2", "c", "f")])
def test_what_was_left_by_a_person_or_is_followed_is_not_offered(tmp_path, keys):
    async def leave(house):
        await follow(house)
        await house.press(*keys)
        for _ in range(3):
            text = await house.look(1.0)
        house.asked.clear()
        await house.press("U")
        await house.look()
        return text, sent(house)

    text, asked = play(tmp_path, leave)
    assert "U resume" not in text
    assert asked == []


def test_the_pocket_view_has_a_button_that_resumes(tmp_path):
    async def stop(house):
        await follow(house)
        await house.press("space")
        await house.look(3.0)
        await house.pilot.resize_terminal(40, 12)
        await house.look(1.0)
        row = stand_in.text_of(house.app).splitlines()[10]
        await house.pilot.click(offset=(row.index("U resume"), 10))
        for _ in range(8):
            await house.look(1.0)
        return row, sent(house)

    row, asked = play(tmp_path, stop, (80, 24))
    assert "Enter release" in row
    assert asked == [Release, Pursue]
