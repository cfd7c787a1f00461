"""Move times of a Trav'ler: the measured law (`docs/reference/travler.md`, *Times*)."""

from __future__ import annotations

import itertools

import pytest
from birdcage.sim.hal.mechanics import move_time, rate_for
from birdcage.sim.motion import plan
from hypothesis import given
from hypothesis import strategies as st

TABLE = {0.3: 0.3, 0.7: 0.5, 2: 1.2, 3: 2.5, 5: 4.2, 10: 6.4, 20: 8.6, 45: 11.3, 90: 13.5, 180: 15.7, 270: 17, 360: 18}
AXES = {"0": ("AZ", "az=0"), "1": ("EL", "el=0"), "2": ("SK", "sk=0")}


def test_the_law_is_the_table():
    for turn, seconds in TABLE.items():
        assert move_time(turn) == pytest.approx(seconds, abs=0.1)


def test_no_glitch_between_one_and_two_degrees():
    turns = [index / 1000 for index in range(1, 5000)]
    assert all(move_time(b) >= move_time(a) for a, b in itertools.pairwise(turns))
    assert move_time(1.5) == pytest.approx(0.85, abs=0.01)


@given(st.floats(0.01, 455.0), st.floats(25.0, 400.0))
def test_a_motion_takes_the_time_of_the_law(turn, accel):
    motion = plan(0.0, 0.0, 0.0, turn, rate_for(turn, accel), accel)
    assert motion.end_s == pytest.approx(move_time(turn), abs=1e-6)
    places = [motion.at(motion.end_s * index / 50)[0] for index in range(51)]
    assert all(b >= a - 1e-9 for a, b in itertools.pairwise(places))


@pytest.mark.parametrize("turn", [3, 5, 10, 20, 45])
@pytest.mark.parametrize("motor", list(AXES))
def test_the_table_on_the_console(hal, motor, turn):
    name, start = AXES[motor]
    dish = hal(f"{start}&latency_min=0&latency_max=0")
    dish.ask("motor", "MOT>")
    begun = dish.now
    dish.ask(f"a {motor} {turn}" if motor != "1" else f"a 1 {turn + 15}", "MOT>")
    seconds = TABLE[turn] if motor != "1" else move_time(turn + 15)
    dish.clock.advance(seconds - 0.11 - (dish.now - begun))
    assert dish.device.truth().moving
    dish.clock.advance(0.21)
    assert not dish.device.truth().moving
    assert f"{name} =" in dish.ask("a", "MOT>")


def test_speed_and_acceleration_may_be_given_instead(hal):
    dish = hal("az=0&speed=5&accel=20&latency_min=0&latency_max=0")
    dish.ask("motor", "MOT>")
    begun = dish.now
    dish.ask("a 0 10", "MOT>")
    dish.clock.advance(2.25 - 0.05 - (dish.now - begun))  # 10 degrees at 5, and 0.25 s to speed up
    assert dish.device.truth().moving
    dish.clock.advance(0.1)
    assert not dish.device.truth().moving
