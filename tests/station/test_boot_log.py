"""What the dish printed while it last started is kept, whoever had it restart."""

from __future__ import annotations

import json

import pytest
from birdcage.rotator.verdict import Grade
from birdcage.sim.g2.boot import BEFORE_HOMING
from birdcage.station.boot_log import MOST_LINES, BootLogKeeper
from birdcage.station.report import status_report
from birdcage.station.requests import AcknowledgeFault, AcquireLease, Raw, ReleaseLease
from birdcage.station.state import FaultReason

from .conftest import Bench

FIRST, LAST = BEFORE_HOMING[0][1], "Loc Startup: IDU NOT Present"


@pytest.fixture
def bench():
    bench = Bench("g2?seed=1&nvs20=1")
    bench.watch("position")
    return bench


def restart(bench):
    at = bench.clock.utc()
    bench.device.reboot()
    bench.step(30.0)
    return at


def test_nothing_is_known_of_a_start_that_was_not_heard(bench):
    bench.connect(10.0)
    assert bench.state.boot_log is None
    assert status_report(bench.state, 0.0)["boot_log"] is None


def test_a_restart_is_kept_from_its_first_mark_to_the_prompt(bench):
    bench.connect(10.0)
    at = restart(bench)
    assert bench.state.fault.reason is FaultReason.REBOOT
    log = bench.state.boot_log
    assert log.lines == (*(line for _s, line in BEFORE_HOMING), "Boot Complete", LAST)
    assert 0.0 <= (log.utc - at).total_seconds() < 2.0
    told = json.loads(json.dumps(status_report(bench.state, 0.0)))["boot_log"]
    assert told == {"utc": log.utc.isoformat(timespec="seconds"), "lines": list(log.lines)}
    bench.step(60.0)
    assert bench.state.boot_log == log, "it stands until the next restart"


def test_the_next_restart_takes_its_place(bench):
    bench.connect(10.0)
    restart(bench)
    first = bench.state.boot_log
    bench.do(AcknowledgeFault("you"))
    restart(bench)
    assert bench.state.boot_log.utc > first.utc
    assert bench.state.boot_log.lines == first.lines, "nothing of the first stands in the second"


def test_homing_that_fails_stands_in_it():
    bench = Bench("g2?seed=1&home_fails=1&nvs20=0")
    bench.connect(10.0)
    restart(bench)
    assert "EL Motor Home Failure" in " ".join(bench.state.boot_log.lines)


def test_a_start_that_is_under_way_when_the_station_begins_is_kept(bench):
    bench = Bench("g2?seed=1&boot=1&nvs20=1")
    bench.step(30.0)
    assert bench.state.boot_log.lines[-1] == LAST


def test_a_restart_that_a_person_has_typed_is_kept_too(bench):
    bench.connect(10.0)
    bench.do(AcquireLease("console"))
    for line in ("q", "reboot"):
        bench.do(Raw(line, "console", Grade.MOVES), 200.0)
    bench.do(ReleaseLease("console"))
    bench.step(5.0)
    lines = bench.state.boot_log.lines
    assert (lines[0], lines[-1]) == (FIRST, LAST)


def test_a_dish_that_prints_for_ever_fills_no_memory(bench):
    bench.connect(10.0)
    keeper = BootLogKeeper(bench.station._store)
    keeper.marked("Bootloader v1.01")
    for number in range(2 * MOST_LINES):
        keeper.hear(f"{number} {'x' * 1000}")
    assert len(bench.state.boot_log.lines) == MOST_LINES
    assert max(map(len, bench.state.boot_log.lines)) == 200
