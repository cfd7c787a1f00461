"""Ports that talk, but not as a dish should: told within 2 s, never a position that was not read."""

from __future__ import annotations

import pytest
from birdcage.station.events import PositionRead
from birdcage.station.state import LinkPhase

from .conftest import Bench


def garble(wire):
    wire.to_host.garble = 1.0


def lose_half(wire):
    wire.to_host.drop = 0.5


def go_mute(wire):
    wire.to_host.silent = True


def take_nothing(wire):
    wire.to_dish.silent = True


@pytest.mark.parametrize("fault", [garble, lose_half, go_mute, take_nothing])
def test_a_bad_port_from_the_start(fault):
    bench = Bench()
    fault(bench.device.wire)
    bench.watch("position")
    bench.step(2.1)
    assert bench.state.link.state is LinkPhase.SILENT
    assert bench.state.link.detail
    assert bench.state.position is None
    bench.step(30)
    true = bench.device.truth()
    for event in bench.events:
        if isinstance(event, PositionRead):
            assert event.position.az_deg == pytest.approx(true.az_deg, abs=0.1)


@pytest.mark.parametrize("fault", [garble, lose_half, go_mute, take_nothing])
def test_a_port_that_turns_bad_and_good_again(fault):
    bench = Bench().connect()
    bench.watch("position", rate_hz=1)
    bench.step(3)
    fault(bench.device.wire)
    last = bench.state.link.last_reply
    bench.step(3.5)
    told = bench.state.link.state is LinkPhase.SILENT or bench.clock.monotonic() - bench.state.link.last_reply > 2.0
    assert told or bench.state.link.last_reply > last
    bench.device.wire.to_host.garble = bench.device.wire.to_host.drop = 0.0
    bench.device.wire.to_host.silent = bench.device.wire.to_dish.silent = False
    bench.step(20)
    assert bench.state.link.state is LinkPhase.UP
    assert bench.state.position_lost is None
    assert bench.state.position.az_deg == pytest.approx(bench.device.truth().az_deg, abs=0.1)


def test_what_came_tells_the_causes_apart():
    details = {}
    for fault in (garble, go_mute):
        bench = Bench()
        fault(bench.device.wire)
        bench.step(2.1)
        details[fault] = bench.state.link.detail
    assert details[garble] != details[go_mute]
    assert "baud" in details[garble]
    assert "power" in details[go_mute]
