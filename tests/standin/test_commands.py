"""Every command on a dish that shares no code with our simulator, in many makes: held against the dish's own record.

Nothing crashes, no sentence is false, nothing leaves its limits, STOP stops or says that it did not, the dish ends
where it was sent, and no `q` reaches the root menu.
"""

from __future__ import annotations

import random

import pytest

from tests.shared.night import by_night

from .covering import HEALTHY, STRANGE, drawn, pairwise, singles
from .stories import EVENING, FOLLOWING, tell

SOME = (
    {},
    {"eol": "\n", "colour": True, "decimals": 0, "latency_s": 0.05, "jitter_s": 0.4, "pieces": True},
    {"eol": "\r", "prompts": "spaced", "chatter_s": 0.3, "chatter_in_reply": 0.3, "root_q": "dies"},
    {"eol": "\n\r", "echo_while_busy": True, "wire_s": 0.1, "unknown_text": "", "overshoot_deg": 0.05},
    {"second_same": "queue", "second_other": "queue", "az_speed": 12.0, "el_speed": 8.0, "move_answer": "np"},
    {"second_same": "refuse", "second_other": "refuse", "homed": False, "unhomed_as": "hundredths"},
    {"second_same": "abort", "second_other": "abort", "half_duplex": True, "homed": False, "unhomed_as": "negative"},
    {"second_other": "ignore", "move_answer": "empty", "az_speed": 30.0, "el_speed": 4.0, "accel": 60.0},
    {"second_same": "block", "second_other": "block", "az_speed": 12.0, "sleep_s": 45.0, "move_answer": "OK"},
    {"query_blocks": True, "jitter_s": 0.08, "echo_while_busy": True, "homed": False, "decimals": 1},
    {"az_speed": 30.0, "el_speed": 4.0, "accel": 60.0},  # runs past its STOP target, and comes back
    {"takes_moves": False, "echo": "lower", "latency_s": 0.6, "tracker": True, "root_q": "unknown"},
)
"""Of the fast set; the soak has every two values of two switches, and hundreds drawn at random."""
COARSE = {"eol": "\n", "echo_while_busy": True, "decimals": 0, "az_speed": 30.0, "el_speed": 4.0, "accel": 60.0}
ODD = ({"echo": "off"}, {"prompts": "none"}, {"prompts": "renamed"}, {"loss": 0.02}, {"latency_s": 12.0})


@pytest.mark.parametrize("habits", SOME, ids=str)
def test_an_evening_at_a_dish_in_good_order(terminal, habits):
    assert tell(terminal(**habits)) == []


@pytest.mark.parametrize("habits", ODD, ids=str)
def test_an_evening_at_a_dish_out_of_order(terminal, habits):
    assert tell(terminal(**habits), strict=False) == []


def test_two_equal_readings_in_whole_degrees_are_no_rest(terminal):
    hand = terminal(**COARSE, az_deg=0.0, el_deg=30.0)
    said = hand.run("move", "--az", "200", "--el", "60", interrupted=True)
    place = hand.dish.where()
    hand.wait(30.0)
    assert "tands still" in said.text
    assert hand.dish.where() == pytest.approx(place)


def test_following_a_direction(terminal):
    assert tell(terminal(pieces=True, colour=True), FOLLOWING) == []


@pytest.mark.soak
@pytest.mark.parametrize("habits", by_night(singles(HEALTHY) + pairwise(HEALTHY), 8), ids=str)
@pytest.mark.parametrize("story", [EVENING, FOLLOWING], ids=["evening", "following"])
def test_every_two_habits_meet(terminal, habits, story):
    assert tell(terminal(**habits), story) == []


@pytest.mark.soak
@pytest.mark.parametrize("habits", by_night(singles(STRANGE) + pairwise(STRANGE), 6), ids=str)
def test_every_two_disorders_meet(terminal, habits):
    assert tell(terminal(**habits), strict=False) == []


@pytest.mark.soak
@pytest.mark.parametrize("seed", by_night(range(300), 6))
def test_habits_drawn_at_random(terminal, seed):
    rng = random.Random(seed)
    assert tell(terminal(**drawn(HEALTHY, rng), seed=seed)) == []
