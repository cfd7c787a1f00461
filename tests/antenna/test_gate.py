"""The gate: what must never reach the wire."""

from __future__ import annotations

import math

import pytest
from birdcage.antenna.gate import MotionGate
from birdcage.base.errors import BelowFloor, MotionRefused, PositionUnknown
from birdcage.base.no_go import NoGoSector
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.values import Position
from hypothesis import given
from hypothesis import strategies as st


@pytest.fixture
def gate():
    gate = MotionGate(CARRYOUT_G2)
    gate.see(Position(180.0, 45.0))
    return gate


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize("axis", [0, 1])
def test_what_is_no_angle(gate, bad, axis):
    target = [180.0, 45.0]
    target[axis] = bad
    with pytest.raises(MotionRefused) as refused:
        gate.check(*target)
    assert refused.value.reason == "not_a_number"


@pytest.mark.parametrize(
    ("az", "el", "reason", "limit", "by"),
    [
        (361.5, 45, "az_limit", 360, 1.5),
        (-0.25, 45, "az_limit", 0, 0.25),
        (9999, 45, "az_limit", 360, 9639),
        (180, 70, "el_limit", 65, 5),
        (180, 17.5, "floor", 18, 0.5),
        (180, -45, "floor", 18, 63),
    ],
)
def test_limits_say_which_and_by_how_much(gate, az, el, reason, limit, by):
    with pytest.raises(MotionRefused) as refused:
        gate.check(az, el)
    assert (refused.value.reason, refused.value.limit_deg, refused.value.by_deg) == (reason, limit, pytest.approx(by))
    assert f"{by:.2f}" in str(refused.value)
    assert f"{limit:.2f}" in str(refused.value)


def test_the_nearest_elevation_is_one_that_the_caller_may_be_sent_to(gate):
    low, high = gate.el_limits_deg
    assert (gate.nearest_el_deg(-5.0), gate.nearest_el_deg(45.0), gate.nearest_el_deg(95.0)) == (low, 45.0, high)
    gate.update(floor_deg=30.0)
    assert gate.nearest_el_deg(20.0) == 30.0


def test_below_the_floor_is_a_value_error(gate):
    gate.update(floor_deg=30.0)
    with pytest.raises(ValueError, match=r"below the floor of 30\.00"):
        gate.check(180, 25)
    with pytest.raises(BelowFloor):
        gate.check(None, 25)


@pytest.mark.parametrize("reason", ["unread", "unhomed", "released"])
def test_an_unknown_position(gate, reason):
    gate.forget(reason)
    with pytest.raises(PositionUnknown) as refused:
        gate.check(180, 45)
    assert refused.value.reason == reason


def test_beyond_the_wrap(gate):
    gate.update(cable_min_deg=-200.0, cable_max_deg=20.0)
    gate.see(Position(0.0, 45.0))
    gate.count_cable()
    gate.check(170, 45)
    assert gate.cable_turns(170) == (-190.0,)
    with pytest.raises(MotionRefused) as refused:
        gate.check(90, 45)
    assert (refused.value.reason, refused.value.limit_deg, refused.value.by_deg) == ("wrap", -200.0, 70.0)


def test_a_user_widens_no_cable(gate):
    gate.update(cable_min_deg=-1000.0, cable_max_deg=1000.0)
    assert gate.cable_limits == (CARRYOUT_G2.cable.min_deg, CARRYOUT_G2.cable.max_deg)
    gate.see(Position(20.0, 45.0))
    gate.count_cable()
    assert gate.cable_turns(30) == (-330.0,)


def test_an_unknown_turn_of_a_short_cable_refuses_azimuths(gate):
    gate.update(cable_min_deg=-100.0, cable_max_deg=20.0)
    with pytest.raises(MotionRefused, match="turn is unknown"):
        gate.check(90, 45)
    gate.check(None, 40)


@given(st.lists(st.floats(0, 359.99), min_size=1, max_size=20))
def test_the_counted_cable_stays_within_its_range(azimuths):
    gate = MotionGate(CARRYOUT_G2)
    gate.see(Position(0.0, 45.0))
    gate.count_cable()
    for az in azimuths:
        turn = gate.cable_turns(az)[0] - gate.cable_deg
        start = gate.position.azimuth
        for share in (0.25, 0.5, 0.75, 1.0):
            gate.see(Position((start + turn * share) % 360.0, 45.0))
        assert CARRYOUT_G2.cable.min_deg - 1e-6 <= gate.cable_deg <= CARRYOUT_G2.cable.max_deg + 1e-6


def test_a_corner_through_a_no_go_sector(gate):
    gate.update(sectors=(NoGoSector(200.0, 220.0, 40.0),))
    gate.see(Position(180.0, 30.0))
    gate.count_cable()
    with pytest.raises(MotionRefused) as refused:
        gate.check(240, 60)
    assert refused.value.reason == "sector"
    gate.check(180, 60)
    gate.check(190, 25)
    gate.see(Position(180.0, 50.0))
    gate.check(240, 60)


def test_a_dish_inside_a_sector_may_leave_it_upwards(gate):
    gate.update(sectors=(NoGoSector(170.0, 190.0, 50.0),))
    gate.check(180, 60)
    with pytest.raises(MotionRefused):
        gate.check(180, 40)


@pytest.mark.parametrize(
    ("start", "goal", "may"),
    [
        (100.0, 104.0, True),
        (104.0, 100.0, True),
        (100.0, 190.0, True),  # meets no stop, whatever the turn
        (60.0, 239.9, False),  # as far as that, it might go either way
        (358.0, 2.0, False),  # across north
        (299.0, 296.0, False),  # across the stop at -423.33
        (297.9, 299.0, True),
        (23.0, 26.0, False),  # across the stop at 23.33
        (22.5, 22.0, False),  # too near to it to be sure
        (22.0, 10.0, True),
    ],
)
def test_an_unknown_turn_is_no_matter_where_no_stop_is_near(gate, start, goal, may):
    gate.update(sectors=(NoGoSector(250.0, 280.0, 40.0, "mast"),))
    gate.see(Position(start, 30.0))
    if may:
        gate.check(goal, 31)
        gate.check(goal, 29)
        return
    with pytest.raises(MotionRefused, match=r"turn of the cable is unknown.*other way round.*\(mast\).*home") as no:
        gate.check(goal, 31)
    assert no.value.reason == "sector"
    gate.see(Position(start, 40.0))
    gate.check(goal, 45)
    gate.see(Position(start, 30.0))
    gate.cable_deg = start - 360.0
    gate.check(goal, 31)


def test_the_short_way_through_a_sector_stays_closed(gate):
    gate.update(sectors=(NoGoSector(101.0, 102.0, 40.0),))
    gate.see(Position(100.0, 30.0))
    with pytest.raises(MotionRefused, match="passes through"):
        gate.check(104, 31)


@pytest.mark.parametrize(("reason", "words"), [("mast", "below 50° (mast),"), ("", "below 50°,")])
def test_a_refusal_says_what_stands_in_the_sector(gate, reason, words):
    gate.update(sectors=(NoGoSector(170.0, 190.0, 50.0, reason),))
    with pytest.raises(MotionRefused) as refused:
        gate.check(180, 40)
    assert words in str(refused.value)
