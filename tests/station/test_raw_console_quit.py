"""Quitting after a raw line that may have set the dish in motion: STOP is tried, and the farewell says what became."""

from __future__ import annotations

import time

import pytest
from birdcage.base.clock import RealClock
from birdcage.base.config import Settings
from birdcage.base.paths import Paths
from birdcage.sim.port import open_device
from birdcage.station.build import open_session
from birdcage.station.raw import CONSOLE, Grade
from birdcage.station.requests import Raw
from birdcage.station.state import LinkPhase

from .raw_console_bench import TalkBench

CUT = "cut its power"


def close(bench):
    farewell = bench.session.close()
    bench.clock.advance(2.0)
    return farewell


def test_a_raw_motion_that_is_not_foreseen_is_stopped():
    bench = TalkBench("g2?seed=1&az_speed=20")
    bench.in_raw_motion("a 0 170")
    before = bench.device.truth().az_deg
    farewell = close(bench)
    assert farewell.startswith("STOP was sent")
    assert bench.at_rest()
    assert before - 20 < bench.device.truth().az_deg < before


def test_a_raw_motion_that_has_ended_is_not_called_ended_after_so_short_a_look():
    bench = TalkBench("g2?seed=1")
    bench.type("a 0 170", confirmed=Grade.RUINS)
    bench.step(8)
    assert bench.state.raw_motion
    since = bench.clock.monotonic()
    assert close(bench).startswith("The dish may still be moving. No STOP has reached it")
    assert bench.moves_since(since) == []


def test_from_another_menu_it_is_stopped_too():
    bench = TalkBench("g2?seed=1&az_speed=5")
    bench.in_raw_motion("a 0 170")
    bench.type("q")
    bench.type("dvb")
    assert close(bench).startswith("STOP was sent")
    assert bench.at_rest()


def test_homing_by_hand_cannot_be_stopped_and_the_farewell_says_so():
    bench = TalkBench()
    bench.begin("h 0", confirmed=Grade.RUINS)
    bench.step(0.3)
    assert CUT in close(bench)


def test_a_raw_motion_on_a_line_that_went_silent():
    bench = TalkBench("g2?seed=1&az_speed=5")
    bench.in_raw_motion("a 0 170")
    bench.device.wire.to_host.silent = True
    assert CUT in close(bench)


def test_without_raw_motion_nothing_is_claimed():
    bench = TalkBench()
    bench.type("a")
    assert close(bench).startswith("The dish was last seen")


@pytest.mark.parametrize("latency_s", [0.001, 0.1])
def test_the_running_station_stops_it_within_its_time_or_says_that_it_did_not(tmp_path, latency_s):
    clock = RealClock()
    name = f"rawquit{latency_s}"
    device = open_device(
        f"g2?id={name}&az_speed=10&latency_min={latency_s}&latency_max={latency_s + 0.002}", clock=clock
    )
    session = open_session(
        port=f"sim:g2?id={name}", firmware="g2", baud=None, settings=Settings(), paths=Paths.in_folder(tmp_path),
        clock=clock,
    )  # fmt: skip
    station = session.station
    session.start()
    end = clock.monotonic() + 8
    while station.state.link.state is not LinkPhase.UP:
        assert clock.monotonic() < end
        clock.wait(None, clock.monotonic() + 0.02)
    station.submit(Raw("a 0 170", CONSOLE, confirmed=Grade.RUINS)).result(8)
    clock.wait(None, clock.monotonic() + 0.5)
    assert device.truth().moving
    began = time.monotonic()
    farewell = session.close()
    took_s = time.monotonic() - began
    clock.wait(None, clock.monotonic() + 0.5)
    rests_by = clock.monotonic() + 5.0  # by itself it would go on for 18 s
    while CUT not in farewell and device.truth().moving and clock.monotonic() < rests_by:
        clock.wait(None, clock.monotonic() + 0.05)
    assert device.truth().moving == (CUT in farewell)
    if latency_s > 0.05:
        assert CUT in farewell  # two readings alone take longer than quitting may
    assert took_s < 5.0  # it does not wait for the end of the motion
