"""`s` says what is true: moving, which way, at a limit, busy."""

from __future__ import annotations

import pytest
from birdcage.rotctld.rprt import Rprt
from birdcage.station.requests import AcquireLease

from .shared_bench import SharedBench, code_of


def moving_to(az, el):
    bench = SharedBench(more="az=-160&el=40")
    client = bench.join("client")
    client.set_position(az, el)
    bench.run(0.5)
    assert bench.state.motion is not None
    return bench, client


@pytest.mark.parametrize(
    ("to", "words"),
    [
        ((300.0, 40.0), ["MOVING", "MOVING_AZ", "MOVING_RIGHT"]),
        ((100.0, 40.0), ["MOVING", "MOVING_AZ", "MOVING_LEFT"]),
        ((300.0, 65.0), ["MOVING", "MOVING_AZ", "MOVING_RIGHT", "MOVING_EL", "MOVING_UP"]),
        ((200.0, 18.0), ["MOVING", "MOVING_EL", "MOVING_DOWN"]),
    ],
)
def test_it_says_which_axis_moves_and_which_way(to, words):
    _, client = moving_to(*to)
    assert list(client.status()) == words


def test_at_rest_between_the_limits_it_says_nothing():
    bench = SharedBench(more="az=-160&el=40")
    assert list(bench.join("client").status()) == []


@pytest.mark.parametrize(("el", "word"), [(90.0, "LIMIT_UP"), (0.0, "LIMIT_DOWN")])
def test_at_a_limit_it_says_so(el, word):
    bench, client = moving_to(300.0, el)
    bench.settle()
    assert list(client.status()) == [word]


def test_it_is_busy_while_somebody_else_has_control_or_it_is_held():
    bench = SharedBench(more="az=-160&el=40")
    client = bench.join("client")
    bench.do(AcquireLease("you"))
    assert list(client.status()) == ["BUSY"]
    bench.station.stop("you")
    bench.run(2.0)
    assert list(client.status()) == ["BUSY"]


def test_out_of_sight_nothing_is_said():
    bench = SharedBench()
    client = bench.join("client")
    bench.device.unplug()
    bench.run(2.0)
    assert code_of(client.status) is Rprt.EIO
