"""`w`: a harmless line, and control goes back at once."""

from __future__ import annotations

import pytest
from birdcage.rotctld.rprt import RotctldError, Rprt
from birdcage.station.requests import AcquireLease

from .shared_bench import SharedBench, code_of


@pytest.fixture
def bench():
    return SharedBench(more="az=-160&el=40")


def test_a_harmless_line_is_answered_and_the_dish_goes_on(bench):
    client = bench.join("client")
    client.set_position(210.0, 40.0)
    bench.settle()
    future = client.send("a")
    bench.wait_for(future)
    assert any("210" in line for line in future.result(0)), future.result(0)
    bench.run(3.0)
    assert bench.state.holder == "client"
    age = bench.clock.monotonic() - bench.state.position.at
    assert age < 2.0, "the position is read again"
    client.set_position(220.0, 40.0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(220.0, abs=0.1)


def test_a_free_dish_is_free_again_afterwards(bench):
    client = bench.join("client")
    bench.wait_for(client.send("a"))
    bench.run(1.0)
    assert bench.state.holder is None


@pytest.mark.parametrize("line", ["a 0 100", "h 0", "reboot", "no such thing", "a 0 1\ra 0 2", "stow"])
def test_a_line_that_is_not_harmless_is_not_sent(bench, line):
    client = bench.join("client")
    before = bench.state.position.az_deg
    future = client.send(line)
    bench.wait_for(future)
    with pytest.raises(RotctldError) as refused:
        future.result(0)
    assert refused.value.code is Rprt.ERJCTED
    bench.run(5.0)
    assert line.split("\r")[0] not in bench.lines()
    assert bench.state.holder is None
    assert bench.state.position.az_deg == pytest.approx(before, abs=0.05)


def test_a_persons_console_is_left_alone(bench):
    client = bench.join("client")
    bench.do(AcquireLease("console"))
    assert code_of(client.send, "a") is Rprt.ERJCTED
    bench.do(AcquireLease("you", take_over=True))
    assert code_of(client.send, "a") is Rprt.ERJCTED
    assert bench.state.holder == "you"


def test_in_motion_nothing_is_sent_and_the_motion_goes_on(bench):
    client = bench.join("client")
    client.set_position(300.0, 40.0)
    bench.run(0.5)
    future = client.send("a")
    bench.wait_for(future)
    with pytest.raises(RotctldError):
        future.result(0)
    bench.settle()
    assert bench.state.position.az_deg == pytest.approx(300.0, abs=0.1)
    assert bench.state.holder == "client"
