"""The shared dish on each machine that exists: at the wire, where the dish moves."""

from __future__ import annotations

import pytest
from birdcage.rotctld.rotor import MoveDirection
from birdcage.rotctld.rprt import Rprt
from birdcage.station.state import Activity

from .shared_bench import SharedBench, code_of

MACHINES = ("g2", "hal205", "hal000", "pro", "carryout")
TRAVLER = "Winegard Trav'ler RS-485 Rotor"
NAMES = {
    "g2": "Carryout G2",
    "hal205": TRAVLER,
    "hal000": TRAVLER,
    "pro": "Winegard Trav'ler Pro Rotor",
    "carryout": "Carryout of 2003",
}


@pytest.mark.parametrize("firmware", MACHINES)
def test_a_wish_is_carried_out_and_told(firmware):
    bench = SharedBench(firmware)
    one, other = bench.join("one", "other")
    if bench.state.awaits_first_move:
        assert code_of(one.position) is Rprt.EIO
    one.set_position(160.0, 40.0)
    other.set_position(100.0, 30.0)
    bench.settle(200.0)
    truth = bench.device.truth()
    assert (truth.az_deg % 360.0, truth.el_deg) == pytest.approx((160.0, 40.0), abs=0.1)
    assert one.position() == other.position() == pytest.approx((160.0, 40.0), abs=0.1)
    assert bench.view("other").ignored == 1
    one.set_position(166.0, 2.0)
    bench.settle(200.0)
    truth = bench.device.truth()
    assert truth.az_deg % 360.0 == pytest.approx(166.0, abs=0.1)
    assert truth.el_deg == pytest.approx(bench.state.el_min_deg, abs=0.1)
    assert one.name() == NAMES[firmware]


@pytest.mark.parametrize("firmware", MACHINES)
def test_s_ends_the_motion_as_far_as_the_dish_can_be_stopped_and_holds_nothing(firmware):
    bench = SharedBench(firmware)
    client = bench.join("client")
    client.set_position(200.0, 40.0)
    bench.settle(200.0)
    client.set_position(330.0, 40.0)
    bench.run(0.8 if firmware == "g2" else 2.0)
    assert bench.state.activity is Activity.SLEWING
    client.stop()
    bench.settle(200.0)
    assert (bench.state.holder, bench.state.held, bench.state.fault) == (None, None, None)
    assert 201.0 < bench.device.truth().az_deg % 360.0 < 325.0, "the silent slew, too, ends at once"


@pytest.mark.parametrize("firmware", MACHINES)
def test_a_persons_stop_keeps_clients_from_moving_it(firmware):
    bench = SharedBench(firmware)
    client = bench.join("client")
    client.set_position(200.0, 40.0)
    bench.settle(200.0)
    bench.station.stop("you")
    bench.run(5.0)
    sent = bench.sent_moves()
    for number in range(5):
        client.set_position(210.0 + number, 40.0)
        assert code_of(client.move, MoveDirection.UP, 50) is Rprt.ERJCTED
        bench.run(1.0)
    assert bench.sent_moves() == sent
    assert bench.view("client").ignored == 10


@pytest.mark.parametrize("firmware", ["hal205", "carryout"])
def test_in_a_silent_slew_the_modelled_position_is_told_and_nothing_is_asked(firmware):
    bench = SharedBench(firmware)
    client = bench.join("client")
    client.set_position(100.0, 40.0)
    bench.settle(200.0)
    client.set_position(200.0, 40.0)
    bench.run(2.0)
    before, lines = client.position()[0], len(bench.lines())
    bench.run(1.0)
    after = client.position()[0]
    assert 100.0 < before < after < 200.0
    assert len(bench.lines()) == lines
    assert after == pytest.approx(bench.device.truth().az_deg, abs=12.0)


@pytest.mark.parametrize("firmware", ["g2", "hal205"])
def test_m_drives_it_and_it_rests_by_itself(firmware):
    bench = SharedBench(firmware)
    client = bench.join("client")
    client.set_position(200.0, 40.0)
    bench.settle(200.0)
    client.move(MoveDirection.RIGHT, 50)
    bench.run(4.0)
    bench.settle(100.0)
    assert 202.0 < bench.state.position.az_deg < 350.0
    assert bench.state.activity is Activity.IDLE
    client.leave()
    bench.run(1.0)
    assert bench.state.holder is None


@pytest.mark.parametrize("firmware", ["g2", "hal205"])
def test_a_stream_over_north_never_turns_all_the_way_back(firmware):
    bench = SharedBench(firmware)
    client = bench.join("client")
    client.set_position(350.0, 40.0)
    bench.settle(200.0)
    seen = []
    for step in range(20):
        client.set_position((350.0 + step) % 360.0, 40.0)
        for _ in range(10):
            bench.run(0.1)
            seen.append(bench.device.truth().az_deg % 360.0)
    bench.settle(100.0)
    assert bench.device.truth().az_deg % 360.0 == pytest.approx(9.0, abs=0.1)
    assert all(az > 340.0 or az < 20.0 for az in seen)
