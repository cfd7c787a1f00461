from __future__ import annotations

import sqlite3
import threading
from datetime import UTC, datetime

import pytest
from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import StoreError
from birdcage.base.journal import Journal, read_journal
from birdcage.base.journal_rows import JournalEntry
from birdcage.base.store import open_database

ONE = ("CREATE TABLE a (x INTEGER)",)
TWO = ("ALTER TABLE a ADD COLUMN y INTEGER", "INSERT INTO a VALUES (1, 2)")
NOON = datetime(2026, 3, 20, 12, tzinfo=UTC)


def test_migrations_run_once_in_order(tmp_path):
    path = tmp_path / "new" / "x.sqlite"
    open_database(path, [ONE]).close()
    for _ in range(2):
        connection = open_database(path, [ONE, TWO])
        assert connection.execute("SELECT * FROM a").fetchall() == [(1, 2)]
        assert connection.execute("PRAGMA journal_mode").fetchone() == ("wal",)
        connection.close()


def test_a_migration_that_fails_leaves_the_version_before(tmp_path):
    path = tmp_path / "x.sqlite"
    open_database(path, [ONE]).close()
    with pytest.raises(StoreError, match=r"x\.sqlite"):
        open_database(path, [ONE, ("INSERT INTO a VALUES (7)", "no sql at all")])
    connection = open_database(path, [ONE])
    assert connection.execute("SELECT count(*) FROM a").fetchone() == (0,)
    connection.close()


def test_a_database_of_a_newer_program_is_refused(tmp_path):
    path = tmp_path / "x.sqlite"
    open_database(path, [ONE, TWO]).close()
    with pytest.raises(StoreError, match="newer birdcage") as refused:
        open_database(path, [ONE])
    assert refused.value.reason == "newer"


def test_a_damaged_database_is_named(tmp_path):
    path = tmp_path / "x.sqlite"
    path.write_bytes(b"this is not a database, whatever its name says" * 100)
    with pytest.raises(StoreError, match="damaged") as refused:
        open_database(path, [ONE])
    assert refused.value.reason == "damaged"


def test_eight_threads_migrate_one_file(tmp_path):
    path = tmp_path / "x.sqlite"
    errors = []

    def work():
        try:
            connection = open_database(path, [ONE, TWO])
            connection.execute("INSERT INTO a VALUES (5, 5)")
            connection.close()
        except (StoreError, sqlite3.Error) as error:
            errors.append(error)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert errors == []
    connection = open_database(path, [ONE, TWO])
    assert connection.execute("SELECT count(*) FROM a").fetchone() == (9,)
    connection.close()


def test_the_journal_keeps_faults_across_restarts(tmp_path):
    path = tmp_path / "state" / "journal.sqlite"
    assert read_journal(path) == []
    stall = JournalEntry(NOON, "stall", "az_stall", "Azimuth stalled at 93 deg.")
    for entry in (stall, JournalEntry(NOON, "link", "lost", "The adapter is gone.")):
        journal = Journal(path)
        journal.append(entry)
        assert journal.flush()
        journal.close()
        assert journal.problem is None
    latest, first = read_journal(path)
    assert first == stall
    assert latest.reason == "lost"


def test_a_journal_that_cannot_be_kept_says_so(tmp_path):
    (tmp_path / "state").write_text("a file where a folder belongs")
    journal = Journal(tmp_path / "state" / "journal.sqlite")
    journal.append(JournalEntry(NOON, "link", "lost", "The adapter is gone."))
    assert journal.flush()
    assert "not being kept" in journal.problem
    journal.close()


def test_a_full_queue_never_waits_and_counts_what_it_drops():
    gate, handled = threading.Event(), []

    def handle(items, dropped):
        gate.wait(5)
        handled.append((items, dropped))

    writer = BackgroundWriter("test", handle, size=2)
    writer.offer("first")
    while writer._waiting:
        pass
    assert [writer.offer(n) for n in range(5)] == [True, True, False, False, False]
    gate.set()
    assert writer.close()
    assert handled == [(["first"], 0), ([0, 1], 3), ([], 0)]
    assert writer.offer("late") is False


def test_a_file_that_another_one_is_just_making_is_tried_again(tmp_path, monkeypatch):
    tries, real = [], sqlite3.connect

    class Contended(sqlite3.Connection):
        def execute(self, sql, *more):
            if sql.startswith("PRAGMA journal_mode"):
                tries.append(sql)
                if len(tries) < 3:
                    error = sqlite3.OperationalError("database is locked")
                    error.sqlite_errorcode = sqlite3.SQLITE_BUSY
                    raise error
            return super().execute(sql, *more)

    monkeypatch.setattr(sqlite3, "connect", lambda *args, **more: real(*args, factory=Contended, **more))
    open_database(tmp_path / "x.sqlite", [ONE]).close()
    assert len(tries) == 3
