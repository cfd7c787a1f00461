"""What the station asks the dish for while it rests."""

from __future__ import annotations

from itertools import pairwise

import pytest
from birdcage.rotator.facts import CableTurn
from birdcage.sim.port import SimPort
from birdcage.station.requests import Goto, Home, Unwatch, Watch
from birdcage.station.state import Activity, TvSearch

from .conftest import Bench


def test_a_position_query_is_one_command_on_the_wire(bench):
    bench.watch("position", rate_hz=1)
    bench.step(12)
    before = len(bench.lines())
    bench.step(5.5)
    sent = bench.lines()[before:]
    assert set(sent) == {"a"}
    assert 4 <= len(sent) <= 6


def test_nothing_is_asked_when_nobody_looks(bench):
    before = len(bench.lines())
    bench.step(30)
    assert bench.lines()[before:] == []


def test_unwatching_ends_it(bench):
    bench.watch("position", "rssi", rate_hz=5)
    bench.step(20)
    bench.station.submit(Unwatch("test"))
    bench.step(1)
    before = len(bench.lines())
    bench.step(30)
    assert bench.lines()[before:] == []


def test_rest_traffic_stays_within_three_commands_a_second():
    bench = Bench(options={"survey": False}).connect()
    bench.watch("position", "rssi", "health", rate_hz=10)
    bench.step(20)
    times = [at for at, _line in bench.received()]
    start = bench.clock.monotonic()
    bench.step(60)
    times = [at for at, _line in bench.received() if at > start]
    for first in times:
        assert sum(first <= at < first + 10 for at in times) <= 30
    visits = [at for at, line in bench.received() if at > start and line == "dvb"]
    assert len(visits) > 8
    assert all(later - earlier >= 4.99 for earlier, later in pairwise(visits))
    assert "rssi" in bench.state.readings


def test_no_excursion_while_moving():
    bench = Bench("g2?seed=1&az_speed=2").connect()
    bench.watch("position", "rssi", rate_hz=10)
    bench.step(12)
    bench.station.submit(Goto(60, 45, "you"))
    bench.step(0.5)
    start = bench.clock.monotonic()
    bench.step(15)
    assert bench.state.activity is Activity.SLEWING
    assert {line for at, line in bench.received() if at > start} == {"a"}


def test_a_motion_interrupts_an_excursion_at_once():
    bench = Bench().connect()
    bench.watch("rssi", rate_hz=1)
    while bench.state.menu != "dvb":
        bench.step(0.02)
    start = bench.clock.monotonic()
    bench.station.submit(Goto(60, 45, "you"))
    bench.step(0.3)
    assert any(line.startswith("a 0") and at - start < 0.2 for at, line in bench.received() if at > start)


def test_the_survey_reads_identity_limits_and_search(bench):
    bench.watch("position")
    bench.step(10)
    assert bench.state.firmware_version == "02.02.48"
    assert (bench.state.el_min_deg, bench.state.el_max_deg) == (18.0, 65.0)
    assert bench.state.search is TvSearch.OFF
    assert bench.state.readings["nvs.20"].value == "TRUE"
    assert bench.state.turn is CableTurn.UNKNOWN


def test_the_dish_s_own_limits_count():
    bench = Bench()
    port = SimPort(bench.device, "earlier")
    for line in ("nvs", "e 101 25", "s", "q", "mot"):
        port.write(line.encode() + b"\r")
        bench.clock.advance(2)
    bench.device.power_cycle()
    bench.clock.advance(60)
    assert b"Boot Complete" in port.read()
    bench.connect()
    bench.do(Home("you"), seconds=60)
    bench.watch("position")
    bench.step(15)
    assert bench.state.el_min_deg == 25.0
    with pytest.raises(ValueError, match=r"floor of 25\.00"):
        bench.do(Goto(180, 20, "you"))


def test_two_watchers_the_keener_one_counts(bench):
    bench.station.submit(Watch("slow", frozenset({"position"}), 0.1))
    bench.station.submit(Watch("fast", frozenset({"position"}), 1.0))
    bench.step(1)
    start = bench.clock.monotonic()
    bench.step(10)
    assert 8 <= sum(at > start and line == "a" for at, line in bench.received()) <= 12


def test_the_position_is_polled_from_the_first_second_on():
    """Also while excursions to the tuner begin: one of them, with its reads, is the longest gap."""
    bench = Bench()
    bench.watch("position", "rssi", "health")
    bench.step(4)
    read = [event.at for event in bench.events if type(event).__name__ == "PositionRead"]
    assert len(read) >= 4
    assert max(later - earlier for earlier, later in pairwise(read)) < 1.5
