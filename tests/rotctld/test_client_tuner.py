"""`R n`, `L` and `D`: the dish's own tuner, and who else may be using it."""

from __future__ import annotations

import pytest
from birdcage.rotctld.rotor import SignalCounts
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.station.requests import Read
from birdcage.station.state import Activity

from .shared_bench import SharedBench, code_of


@pytest.fixture
def bench():
    return SharedBench()


def answer(bench, future, seconds=20.0):
    bench.wait_for(future, seconds)
    return future.result(0)


def reads(bench):
    return [line for line in bench.lines() if line.startswith("rssi ")]


@pytest.mark.parametrize(("asked", "lines", "told"), [(10, 1, 10), (1, 1, 10), (11, 2, 20), (30, 3, 30)])
def test_it_is_read_as_often_as_asked_and_says_how_often(bench, asked, lines, told):
    client = bench.join("client")
    counts = answer(bench, client.read_signal(asked))
    assert counts.reads == told
    assert len(reads(bench)) == lines
    assert 100 < counts.average < 4000
    assert 100 < counts.current < 4000
    bench.run(3.0)
    client.set_position(100.0, 40.0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(100.0, abs=0.1)


def test_a_great_number_is_cut(bench):
    client = bench.join("client")
    assert answer(bench, client.read_signal(100_000), 60.0).reads == 100


def test_while_somebody_else_uses_it_their_readings_are_told_and_nothing_is_asked(bench):
    client = bench.join("client")
    bench.station.own_signal("tuner", "monitor")
    assert code_of(client.read_signal, 10) is Rprt.ERJCTED
    assert code_of(client.enable_lna) is Rprt.ERJCTED
    bench.do(Read(("rssi",)))
    seen, before = bench.state.readings["rssi"], len(reads(bench))
    counts = answer(bench, client.read_signal(10))
    assert counts == SignalCounts(10, round(seen.value), round(seen.value))
    bench.run(11.0)
    assert code_of(client.read_signal, 10) is Rprt.ERJCTED, "an old reading is none"
    assert len(reads(bench)) == before
    assert "lnbdc odu" not in bench.lines()


def test_in_motion_it_is_refused(bench):
    client = bench.join("client")
    client.set_position(180.0, 40.0)
    bench.run(0.5)
    with pytest.raises(RotctldError) as refused:
        answer(bench, client.read_signal(10))
    assert refused.value.code is Rprt.ERJCTED
    assert bench.state.activity is Activity.SLEWING


def test_the_supply_of_the_lnb_is_switched_on_by_its_own_command_only(bench):
    client = bench.join("client")
    assert tuple(client.abilities()) == ("rssi", "lna")
    assert "lnbdc odu" not in bench.lines()
    assert answer(bench, client.enable_lna()) is None
    assert bench.lines().count("lnbdc odu") == 1
    bench.run(2.0)
    client.position()


def test_out_of_reach_it_says_so(bench):
    client = bench.join("client")
    bench.device.unplug()
    bench.run(2.0)
    with pytest.raises(RotctldError) as refused:
        answer(bench, client.read_signal(10))
    assert refused.value.code is Rprt.EIO


@pytest.mark.parametrize("firmware", ["hal205", "carryout"])
def test_a_dish_without_a_tuner_has_no_such_thing(firmware):
    bench = SharedBench(firmware)
    client = bench.join("client")
    assert tuple(client.abilities()) == ()
    assert code_of(client.read_signal, 10) is Rprt.EIO
    assert code_of(client.enable_lna) is Rprt.EIO
