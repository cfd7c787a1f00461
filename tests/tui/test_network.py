"""The Network tab: who may move the dish, exact in each state, and no half of it blank."""

from __future__ import annotations

import re

import pytest
import sky_stand_in
import track_stage
from stage import read, run

SIZES = [(80, 24), (100, 30), (120, 36), (160, 48), (240, 70)]


async def network(app, pilot):
    await pilot.press("N")
    for _ in range(3):
        await pilot.pause()
        app.paint()
    await pilot.pause()
    return await read(app, pilot)


def flat(text):
    return re.sub(r"[\s│]+", " ", text)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_it_says_who_has_control_who_may_take_it_and_how_it_is_stopped_from_a_shell(size):
    text = flat(run(network, "slewing", size, key="f2", sky=sky_stand_in.make()))
    for words in ("Control", "You, at this terminal.", "Who may move it", "Tracker", "Console", "birdcage stop",
                  "birdcage hold", "birdcage release", "The server for Gpredict"):  # fmt: skip
        assert words in text, words


@pytest.mark.parametrize("size", SIZES[1:], ids=str)
def test_no_half_of_the_page_is_blank(size):
    rows = run(network, "slewing", size, key="f2", sky=sky_stand_in.make()).splitlines()[4:-3]
    words = [row.replace("│", " ") for row in rows]
    assert sum(bool(row.strip()) for row in words) >= 0.7 * len(words), "\n".join(rows)
    for half in (slice(0, size[0] // 2), slice(size[0] // 2, None)):
        assert any(row[half].strip() for row in words)


@pytest.mark.parametrize("size", SIZES, ids=str)
def test_held_it_says_what_enter_sets_in_motion(size):
    text = flat(run(network, "held", size, key="f2"))
    assert "Refused Gpredict 3 times. Enter releases it: Gpredict may move it to 231.4/44.0." in text


def test_while_a_pass_is_followed_it_names_it_with_its_error_and_what_comes_next():
    async def to_network(app, pilot, _desk):
        return await network(app, pilot)

    text = flat(track_stage.run(to_network, size=(120, 36)))
    assert re.search(r"Following METEOR-M2 4 error ±?\d\.\d\d°, for tracker\.", text), text
    assert "In reach" in text or "in 0" in text or "eiling" in text
