"""`M` moves while it is renewed, `K` goes to the named park position."""

from __future__ import annotations

import pytest
from birdcage.base.geometry import shortest_turn
from birdcage.base.no_go import NoGoSector
from birdcage.rotctld.rotor import MoveDirection
from birdcage.rotctld.rprt import Rprt
from birdcage.station.requests import AcquireLease
from birdcage.station.state import Activity

from .shared_bench import SharedBench, code_of

RIGHT, LEFT, UP, DOWN = MoveDirection.RIGHT, MoveDirection.LEFT, MoveDirection.UP, MoveDirection.DOWN


def driven(direction, seconds=1.0, **options):
    bench = SharedBench(more="az=-160&el=40", **options)
    client = bench.join("client")
    before = bench.state.position
    client.move(direction, 50)
    bench.run(seconds)
    return bench, client, before


@pytest.mark.parametrize(
    ("direction", "az", "el"),
    [(RIGHT, 1, 0), (LEFT, -1, 0), (UP, 0, 1), (DOWN, 0, -1), (LEFT | UP, -1, 1), (RIGHT | DOWN, 1, -1)],
)
def test_m_drives_both_axes_its_way(direction, az, el):
    bench, _, before = driven(direction)
    after = bench.state.position
    turned, rose = shortest_turn(before.az_deg, after.az_deg), after.el_deg - before.el_deg
    assert (turned > 1.0, turned < -1.0) == (az > 0, az < 0)
    assert (rose > 1.0, rose < -1.0) == (el > 0, el < 0)
    assert bench.state.holder == "client"


def test_without_another_m_it_rests_after_the_deadman_time():
    bench, _, _ = driven(RIGHT, 1.7, drive_s=2.0)
    assert bench.state.activity is Activity.FOLLOWING
    bench.run(2.5)
    assert bench.state.activity is Activity.IDLE
    sent = len(bench.sent_moves())
    bench.run(3.0)
    assert len(bench.sent_moves()) == sent


def test_it_never_pauses_while_it_lasts():
    bench, _, _ = driven(RIGHT, 0.5, drive_s=4.0)
    doing = set()
    for _ in range(30):
        bench.run(0.1)
        doing.add(bench.state.activity)
    assert doing == {Activity.FOLLOWING}


def test_with_another_m_it_goes_on():
    bench, client, _ = driven(UP, 1.5, drive_s=2.0)
    client.move(LEFT, -1)
    bench.run(1.5)
    assert bench.state.activity is Activity.FOLLOWING
    assert bench.state.position.az_deg < 195.0


@pytest.mark.parametrize("end", ["stop", "leave"])
def test_s_and_hanging_up_end_it_at_once_and_give_control_back(end):
    bench, client, _ = driven(RIGHT, 0.6)
    getattr(client, end)()
    bench.run(0.4)
    here = bench.state.position.az_deg
    bench.run(2.0)
    assert bench.state.holder is None
    assert bench.state.activity is Activity.IDLE
    assert abs(shortest_turn(here, bench.state.position.az_deg)) < 5.0
    assert not bench.state.tasks


def test_a_wish_ends_it():
    bench, client, _ = driven(RIGHT, 0.6)
    client.set_position(210.0, 45.0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(210.0, abs=0.1)
    assert bench.state.position.el_deg == pytest.approx(45.0, abs=0.1)


def test_nothing_is_driven_against_a_holder_or_stop_or_the_other_way_at_once():
    bench = SharedBench()
    client = bench.join("client")
    bench.do(AcquireLease("you"))
    assert code_of(client.move, RIGHT, 50) is Rprt.ERJCTED
    assert code_of(client.move, RIGHT | LEFT, 50) is Rprt.EINVAL
    assert code_of(client.move, MoveDirection(0), 50) is Rprt.EINVAL
    bench.station.stop("you")
    bench.run(2.0)
    assert code_of(client.move, RIGHT, 50) is Rprt.ERJCTED
    bench.run(2.0)
    assert not bench.sent_moves()


def test_stop_of_a_person_ends_a_drive_that_is_renewed():
    bench, client, _ = driven(RIGHT, 0.6)
    bench.station.stop("you")
    bench.run(3.0)
    sent = len(bench.sent_moves())
    assert code_of(client.move, RIGHT, 50) is Rprt.ERJCTED
    bench.run(2.0)
    assert len(bench.sent_moves()) == sent
    assert bench.state.activity is Activity.IDLE


def test_k_goes_to_the_park_position():
    bench = SharedBench(park=(222.0, 33.0))
    client = bench.join("client")
    client.park()
    bench.settle()
    assert bench.sent_moves() == ["a 0 222.00", "a 1 33.00"]
    assert "stow" not in bench.lines()
    assert bench.state.holder == "client"


def test_a_sector_that_ends_below_it_does_not_matter():
    bench = SharedBench(station={"sectors": (NoGoSector(200.0, 230.0, 20.0, "wall"),)}, park=(222.0, 33.0))
    client = bench.join("client")
    client.park()
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(222.0, abs=0.1)


@pytest.mark.parametrize(
    ("options", "station"),
    [
        ({}, {}),
        ({"park": (222.0, 33.0)}, {"sectors": (NoGoSector(200.0, 230.0, 40.0, "mast"),)}),
        ({"park": (222.0, 80.0)}, {}),
    ],
)
def test_without_a_park_position_or_out_of_reach_k_is_not_available(options, station):
    bench = SharedBench(station=station, **options)
    client = bench.join("client")
    assert code_of(client.park) is Rprt.ENAVAIL
    bench.run(2.0)
    assert not bench.sent_moves()


def test_a_park_that_is_not_carried_out_says_so():
    bench = SharedBench(park=(222.0, 33.0))
    client = bench.join("client")
    bench.do(AcquireLease("you"))
    assert code_of(client.park) is Rprt.ERJCTED
    bench.run(2.0)
    assert not bench.sent_moves()


def test_a_server_that_is_read_only_neither_drives_nor_parks():
    bench = SharedBench(read_only=True, park=(222.0, 33.0))
    client = bench.join("client")
    for call in (lambda: client.move(RIGHT, 50), client.park, client.enable_lna, lambda: client.send("ve")):
        assert code_of(call) is Rprt.ERJCTED
    bench.run(2.0)
    assert not bench.sent_moves()
