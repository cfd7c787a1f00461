"""How far a motor test turns: never beyond a limit, a stop of the cable, or into a no-go sector."""

from __future__ import annotations

import pytest
from birdcage.antenna.gate import MotionBounds, MotionGate
from birdcage.base.geometry import wrap_360
from birdcage.base.no_go import NoGoSector
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.rotator.values import Position
from birdcage.station.clear_way import clear_way
from birdcage.tracking.steps import FindWay
from hypothesis import assume, given
from hypothesis import strategies as st

from .motor_bench import MotorBench

LOW, HIGH = -423.33, 23.33
SECTORS = st.lists(
    st.builds(NoGoSector, st.floats(0.0, 359.0), st.floats(0.0, 359.0), st.floats(10.0, 90.0)), max_size=2
)


def gate_at(cable_deg, el_deg, sectors=(), **bounds):
    gate = MotionGate(CARRYOUT_G2, MotionBounds(sectors=tuple(sectors), **bounds))
    gate.see(Position(wrap_360(cable_deg), el_deg))
    gate.remember_cable(cable_deg)
    return gate


def grid(low, high):
    return [low + (high - low) * n / 200 for n in range(201)]


@given(st.floats(LOW, HIGH), st.floats(18.0, 65.0), SECTORS, st.floats(-400.0, -180.0), st.floats(-170.0, 0.0))
def test_an_azimuth_stays_within_cable_and_sectors(cable_deg, el_deg, sectors, own_low, own_high):
    assume(own_low <= cable_deg <= own_high)
    found = clear_way(
        gate_at(cable_deg, el_deg, sectors, cable_min_deg=own_low, cable_max_deg=own_high), FindWay(0, 60.0), 0.0
    )
    if found.way_deg is None:
        assert found.refused
        return
    begin, end = found.way_deg
    assert 0.0 < end - begin <= 60.0
    assert own_low <= begin < end <= own_high
    for deg in grid(min(begin, cable_deg), max(end, cable_deg)):
        assert own_low - 1e-9 <= deg <= own_high + 1e-9
        assert not any(
            el_deg < each.el_below_deg and each.overlaps(wrap_360(deg), 0.0)
            for each in sectors if begin <= deg <= end
        )  # fmt: skip


@given(st.floats(0.0, 359.9), st.floats(LOW, HIGH))
def test_where_the_turn_is_unknown_the_way_is_safe_for_every_turn(az_deg, cable_deg):
    gate = MotionGate(CARRYOUT_G2)
    gate.see(Position(az_deg, 45.0))
    found = clear_way(gate, FindWay(0, 60.0), 0.0)
    if found.way_deg is None:
        return
    begin, end = found.way_deg
    for border in (0.0, LOW % 360.0, HIGH % 360.0):
        assert not begin <= border <= end
    for turn in (-720.0, -360.0, 0.0, 360.0):  # wherever the cable stands that shows these azimuths
        if LOW <= begin + turn <= HIGH:
            assert LOW <= end + turn <= HIGH


@given(st.floats(17.9, 65.1), st.floats(0.0, 359.0), SECTORS, st.floats(18.0, 40.0), st.floats(45.0, 65.0))
def test_an_elevation_stays_within_floor_ceiling_and_above_sectors(el_deg, az_deg, sectors, floor_deg, top_deg):
    gate = gate_at(-az_deg, el_deg, sectors, floor_deg=floor_deg, el_max_deg=top_deg)
    found = clear_way(gate, FindWay(1, 60.0), 0.0)
    if found.way_deg is None:
        return
    begin, end = found.way_deg
    assert floor_deg <= begin < end <= top_deg
    here = wrap_360(-az_deg)
    assert not any(begin < each.el_below_deg and each.overlaps(here, 0.0) for each in sectors)


@pytest.mark.parametrize(("cable_deg", "way"), [
    (-180.0, (-210.0, -150.0)), (0.0, (-37.17, 22.83)), (23.0, (-37.17, 22.83)), (-423.0, (-422.5, -362.5)),
])  # fmt: skip
def test_the_way_lies_about_the_dish_and_off_the_stops(cable_deg, way):
    found = clear_way(gate_at(cable_deg, 45.0), FindWay(0, 60.0), 0.0)
    assert found.way_deg == pytest.approx(way, abs=0.51)
    assert found.way_deg[0] >= LOW + 0.5
    assert found.way_deg[1] <= HIGH - 0.5


def test_home_has_room_though_the_turn_is_unknown():
    gate = MotionGate(CARRYOUT_G2)
    gate.see(Position(0.0, 45.0))
    begin, end = clear_way(gate, FindWay(0, 60.0), 0.0).way_deg
    assert 0.0 < begin % 360.0 < end % 360.0 < 360.0
    assert end - begin >= 59.0


@pytest.mark.parametrize("options", ["az=22", "az=-423", "az=-180&el=18", "az=-180&el=65", "az=0", "az=-360"])
def test_the_dish_never_leaves_its_range(options):
    bench = MotorBench(options)
    before = bench.device.truth()
    bench.begin(rounds=1)
    bench.look(22.0)
    assert bench.last.is_done, bench.last.why
    cables, heights = zip(*bench.seen, strict=True)
    assert min(cables) >= LOW
    assert max(cables) <= HIGH
    assert min(heights) >= 17.9
    assert max(heights) <= 65.1
    assert max(heights) - min(heights) > 40.0
    assert max(cables) - min(cables) > 55.0
    assert bench.device.truth().el_deg == pytest.approx(before.el_deg, abs=0.2)


def test_a_sector_beside_the_dish_is_not_entered():
    sector = NoGoSector(190.0, 230.0, 60.0, "mast")
    bench = MotorBench("az=-180&el=40", sectors=(sector,))
    bench.begin(axis="azimuth", rounds=1)
    bench.look(12.0)
    assert bench.last.is_done, bench.last.why
    assert max(cable % 360.0 for cable, _el in bench.seen) < 190.0
    assert bench.last.found["azimuth.way_deg"] == pytest.approx(60.0, abs=0.5)


def test_where_there_is_no_room_it_says_why_and_sends_nothing():
    everywhere = (NoGoSector(0.0, 178.0, 90.0), NoGoSector(182.0, 359.9, 90.0))
    bench = MotorBench("az=-180&el=40", sectors=everywhere)
    before = bench.clock.monotonic()
    bench.begin(axis="azimuth")
    ended = bench.end()
    assert not ended.is_done
    assert "to turn in from here, and a test needs 5°." in ended.why
    assert "no-go" in ended.why
    assert bench.moves_since(before) == []
