"""Whole sessions of the programs that people use, over a real socket."""

from __future__ import annotations

import pytest
from birdcage.station.network_state import NetworkProgram

from tests.rotctld.net_bench import NetBench
from tests.rotctld.stand_ins import Gpredict, SatDump, SatnogsClient


@pytest.fixture
def bench():
    bench = NetBench().connect()
    bench.run(2.0)
    yield bench
    bench.close()


def pass_at(step):
    """A made-up pass: rises in the south-west, a degree and a half a second at most."""
    return 200.0 + 1.2 * step, 25.0 + 0.4 * step


def test_gpredict_follows_a_pass_and_gets_every_answer_whole(bench):
    gpredict = Gpredict(bench, threshold_deg=1.0)
    for step in range(40):
        gpredict.cycle(*pass_at(step))
    assert gpredict.engaged
    assert all(reply.count(b"\n") == 2 for reply in gpredict.heard)
    wanted = pass_at(39)
    assert gpredict.position == pytest.approx(wanted, abs=4.0)
    client = bench.network.clients[0]
    assert (client.program, client.errors) == (NetworkProgram.GPREDICT, 0)
    assert gpredict.ask(b"S\n") == b"RPRT 0\n"
    bench.run(2.0)
    assert bench.state.holder is None
    assert bench.state.held is None


def test_gpredict_points_below_the_floor_before_the_pass_and_stays_engaged(bench):
    gpredict = Gpredict(bench)
    for _ in range(20):
        gpredict.cycle(120.0, 0.0)
    assert gpredict.engaged
    assert gpredict.position[0] == pytest.approx(120.0, abs=0.2)
    assert gpredict.position[1] == pytest.approx(bench.state.el_min_deg, abs=0.2)


def test_gpredict_is_still_engaged_after_ten_seconds_without_cable(bench):
    gpredict = Gpredict(bench)
    for step in range(5):
        gpredict.cycle(*pass_at(step))
    bench.device.unplug()
    for step in range(12):
        gpredict.cycle(*pass_at(step))
    bench.device.plug()
    for step in range(20):
        gpredict.cycle(*pass_at(step))
    assert gpredict.engaged
    assert gpredict.position == pytest.approx((bench.state.position.az_deg, bench.state.position.el_deg), abs=3.0)


def test_gpredict_beside_somebody_who_has_control_is_ignored_and_stays_engaged(bench):
    other = bench.join()
    other.ask(b"P 100 40\n")
    bench.run(1.0)
    gpredict = Gpredict(bench)
    for step in range(10):
        gpredict.cycle(*pass_at(step))
    assert gpredict.engaged
    assert gpredict.position == pytest.approx((100.0, 40.0), abs=0.2)
    assert bench.network.clients[1].ignored > 3


def test_a_flip_of_gpredict_is_pointed_at_from_the_other_side(bench):
    gpredict = Gpredict(bench)
    for _ in range(25):
        gpredict.cycle(20.0, 130.0)
    assert gpredict.position == pytest.approx((200.0, 50.0), abs=0.2)


def test_satnogs_observes_and_hangs_up(bench):
    satnogs = SatnogsClient(bench)
    for step in range(0, 60, 3):
        satnogs.cycle(*pass_at(step))
    assert satnogs.cycle(*pass_at(57)) == pytest.approx(pass_at(57), abs=4.1)
    assert b"P 200.000000 25.000000\n" in satnogs.sent
    assert bench.network.clients[0].program is NetworkProgram.SATNOGS
    satnogs.close()
    bench.run(5.0)
    assert bench.state.holder is None
    assert bench.network.clients == ()


def test_satdump_reads_each_answer_with_one_receive(bench):
    satdump = SatDump(bench)
    for step in range(20):
        assert satdump.cycle(*pass_at(step)).count(b"\n") == 2
    assert bench.network.clients[0].program is NetworkProgram.SATDUMP


def test_look4sat_never_reads_and_is_obeyed(bench):
    phone = bench.join()
    for step in range(20):
        az_deg, el_deg = pass_at(step)
        phone.send(f"\\set_pos {az_deg:.1f} {el_deg:.1f}\n".encode())
        bench.run(1.0)
    assert bench.state.position.az_deg == pytest.approx(pass_at(19)[0], abs=4.0)
    assert bench.network.clients[0].program is NetworkProgram.LOOK4SAT
