"""What a station keeps of its dish in the journal: faults as values, restarts, the link, replies, limits."""

from __future__ import annotations

import sqlite3
from datetime import UTC, date, datetime

import pytest
from birdcage.base.clock import VirtualClock
from birdcage.base.journal import Journal, read_journal
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database
from birdcage.station.record import keep_journal
from birdcage.station.requests import (
    AcknowledgeFault,
    Goto,
    Home,
    Read,
    Release,
    SaveSettings,
    SetSearch,
    WriteSettings,
)

from .conftest import Bench

NAME = "Carryout G2 (demo)"


class Kept:
    """A bench whose station keeps a journal."""

    def __init__(self, path, **more):
        self.bench = Bench(clock=VirtualClock(utc=datetime(2026, 11, 10, 12, tzinfo=UTC)), **more)
        self.path, self.journal = path, Journal(path)
        self.tally = keep_journal(self.bench.station, self.journal, lambda port: f"adapter of {port}")

    def rows(self, query):
        self.tally.write()
        assert self.journal.flush()
        if not self.path.exists():
            return []
        connection = sqlite3.connect(self.path)
        try:
            return connection.execute(query).fetchall()
        finally:
            connection.close()

    def incidents(self):
        return self.rows("SELECT kind, moving, dish, adapter FROM incident ORDER BY id")


@pytest.fixture
def kept(tmp_path):
    made = []

    def make(**more):
        made.append(Kept(tmp_path / "journal.sqlite", **more))
        return made[-1]

    yield make
    for each in made:
        each.journal.close()


def test_a_stall_that_the_dish_tells_of_is_kept_with_axis_and_direction(kept):
    here = kept()
    bench = here.bench.connect()
    bench.do(Goto(100, 40, "you"))
    future = bench.station.submit(Goto(100, 60, "you"))
    bench.step(0.3)
    bench.device.stall(1)
    bench.step(4)
    assert future.exception(0) is not None
    assert here.journal.flush()
    [entry] = read_journal(here.path)
    assert (entry.kind, entry.reason, entry.dish, entry.axis, entry.homing) == (
        "dish",
        "stall",
        NAME,
        "elevation",
        False,
    )
    assert entry.az_deg == pytest.approx(100, abs=0.3)
    assert 40 < entry.el_deg < 60


@pytest.mark.parametrize("axis", [0, 1])
def test_a_stall_that_is_only_seen_names_the_axis_that_is_short_of_its_target(kept, axis):
    here = kept()
    bench = here.bench.connect()
    bench.do(Goto(100, 40, "you"))
    bench.device.firmware.stalled = lambda _axis: None
    bench.station.submit(Goto(130, 60, "you"))
    bench.step(0.1)
    bench.device.stall(axis)
    bench.step(8)
    assert here.journal.flush()
    assert [(each.reason, each.axis) for each in read_journal(here.path)] == [("stall", ("azimuth", "elevation")[axis])]


def test_a_restart_is_kept_once_with_whether_the_dish_moved(kept):
    here = kept()
    bench = here.bench.connect()
    bench.device.reboot()
    bench.step(60)
    assert [row[:2] for row in here.incidents() if row[0] == "restart"] == [("restart", 0)]
    bench.do(AcknowledgeFault("you"))
    bench.do(Release("you"))
    bench.do(Home("you"), 90)
    assert here.rows("SELECT sentence FROM incident WHERE kind = 'homed'") == [("azimuth, elevation",)]
    bench.station.submit(Goto(200, 60, "you"))
    bench.step(1.0)
    bench.device.reboot()
    bench.step(60)
    restarts = [row for row in here.incidents() if row[0] == "restart"]
    assert restarts == [("restart", 0, NAME, "adapter of sim:test"), ("restart", 1, NAME, "adapter of sim:test")]


def test_what_goes_silent_and_comes_back_is_kept_and_what_never_answered_is_not(kept):
    here = kept()
    here.bench.device.wire.to_host.silent = True
    here.bench.step(20)
    assert here.incidents() == []
    here.bench.device.wire.to_host.silent = False
    here.bench.step(20)
    assert here.incidents() == []
    here.bench.watch("position")
    here.bench.device.wire.to_host.silent = True
    here.bench.step(20)
    here.bench.device.wire.to_host.silent = False
    here.bench.step(20)
    assert [row[:2] for row in here.incidents()] == [("silent", 0), ("back", 0)]


def test_replies_are_counted_by_day_and_adapter_and_a_dish_without_power_loses_none(kept):
    here = kept()
    bench = here.bench.connect()
    bench.watch("position", rate_hz=1.0)
    bench.step(30)
    (row,) = here.rows("SELECT dish, adapter, day, asked, unanswered FROM reply_day")
    asked = row[3]
    assert row[:3] == (NAME, "adapter of sim:test", "2026-11-10")
    assert row[4] == 0
    assert 30 < asked < 100
    bench.device.wire.to_host.silent = True
    bench.step(600)
    ((asked_then, unanswered),) = here.rows("SELECT asked, unanswered FROM reply_day")
    assert unanswered == 1, "of ten minutes of silence, the first line alone was lost"
    assert asked_then <= asked + 2


def test_a_limit_is_kept_again_only_when_it_has_changed(kept):
    here = kept()
    bench = here.bench.connect(10.0)
    bench.watch("position")
    bench.step(20)
    for floor in ("18.00", "18.00", "10.00"):
        bench.step(6)
        bench.device.firmware.board.nvram.write(101, floor)
        bench.do(Read(("floor",)))
    told = here.rows("SELECT name, value FROM told_setting WHERE name = 'floor' ORDER BY id")
    assert told == [("floor", "18.0"), ("floor", "10.0")]


def test_a_journal_of_an_older_birdcage_keeps_its_faults(tmp_path):
    path = tmp_path / "journal.sqlite"
    before = open_database(path, MIGRATIONS[:5])
    before.execute(
        "INSERT INTO fault (utc, kind, reason, sentence) VALUES ('2026-10-01T00:00:00.000+00:00', 'dish', 'stall', 'x')"
    )
    before.close()
    [entry] = read_journal(path)
    assert (entry.reason, entry.dish, entry.axis, entry.az_deg) == ("stall", "", "", None)
    assert entry.utc.date() == date(2026, 10, 1)


def test_settings_that_were_saved_are_kept_by_name(kept, tmp_path):
    here = kept(options={"backup_folder": tmp_path / "backups"})
    bench = here.bench.connect(10.0)
    bench.do(WriteSettings({38: "600"}, "you", agreed=True))
    bench.do(SaveSettings("you", agreed=True))
    bench.do(SetSearch(disabled=True, holder="you"))
    saved = here.rows("SELECT sentence FROM incident WHERE kind = 'saved' ORDER BY id")
    assert saved == [("Sleep Mode Timer Secs",), ("TV search at power-up",)]


def test_a_homing_that_is_cut_short_is_no_homing(kept):
    here = kept(address="g2?seed=1&unhomed=1")
    bench = here.bench.connect()
    bench.later(2.0, lambda: bench.station.stop("you"))
    future = bench.station.submit(Home("you"))
    bench.step(40)
    assert future.exception(0) is not None
    assert here.rows("SELECT sentence FROM incident WHERE kind = 'homed'") == []


def test_a_journal_that_cannot_be_kept_is_warned_of_until_it_can(kept):
    here = kept()
    here.path.mkdir()
    bench = here.bench.connect(10.0)
    assert here.journal.flush()
    bench.do(Read(("sleep_timer",)))
    bench.do(Goto(100, 40, "you"))
    assert bench.state.warnings["journal"].startswith("Faults are not being kept: ")
    here.path.rmdir()
    bench.device.reboot()
    bench.step(60)
    assert here.journal.flush()
    bench.do(Read(("version",)))
    assert "journal" not in bench.state.warnings
