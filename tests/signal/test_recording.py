"""What is recorded of the signal can be read again, whatever happens to program and disk meanwhile."""

from __future__ import annotations

import csv
import re
import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from types import SimpleNamespace

import pytest
from birdcage.base.errors import StoreError
from birdcage.base.store import open_database
from birdcage.rotator.feature import Reading
from birdcage.signal import recording as module
from birdcage.signal.recording import MIGRATIONS, RecordedReading, SignalRecorder, row_of
from birdcage.signal.recordings import csv_lines, list_recordings, read_recording
from birdcage.signal.source import SignalReading
from birdcage.signal.tuner import TUNER_FACTS
from birdcage.station.pursuit_state import Phase

from tests.station.conftest import Bench

NOON = datetime(2026, 11, 24, 12, 0, tzinfo=UTC)


def row(index=0, **changes):
    plain = RecordedReading(
        NOON + timedelta(seconds=index), 180.5, 42.25, 500.0 + index, 1.5, 10, None, 7.5, True, "V", "119W", "idle"
    )
    return replace(plain, **changes)


def recorded(path, rows, settings=None, *, demo=False):
    recorder = SignalRecorder(path, TUNER_FACTS, settings or {"feed": "stock-ku"}, demo=demo)
    for each in rows:
        recorder.add(each)
    recorder.close()
    return recorder


def test_every_reading_comes_back_as_it_was(tmp_path):
    path = tmp_path / "signal.sqlite"
    rows = [
        row(0),
        row(1, az_deg=None, el_deg=None, snr_db=None, lock=None, polarisation=None, target=""),
        row(2, lock=False, scatter=None, n=None),
    ]
    recorder = recorded(path, rows)
    assert (recorder.problem, recorder.kept, recorder.number) == ("", 3, 1)
    (told,) = list_recordings(path)
    assert (told.number, told.source, told.unit, told.readings) == (1, "tuner", "counts", 3)
    assert (told.begun, told.ended, told.settings) == (NOON, NOON + timedelta(seconds=2), {"feed": "stock-ku"})
    assert read_recording(path, 1) == rows


def test_a_reading_is_kept_with_what_the_receiver_last_said():
    bench = Bench().connect(6.0)
    now, state = bench.clock.monotonic(), bench.state
    told = {"snr": Reading(8.5, "dB", now - 5.0, NOON), "lock": Reading(True, "", now - 500.0, NOON)}
    reading = SignalReading(444.0, "counts", now, bench.clock.utc(), "tuner", 0.2)
    kept = row_of(reading, TUNER_FACTS, replace(state, readings=told), now)
    assert (kept.snr_db, kept.lock, kept.dwell_s) == (8.5, None, 0.2), "what is old is not known"
    assert (kept.n, kept.scatter) == (None, None), "it was not told"
    counted = row_of(replace(reading, n=10, scatter=0.65), TUNER_FACTS, state, now)
    assert (counted.n, counted.scatter) == (10, 0.65)
    assert (kept.az_deg, kept.el_deg) == (state.position.az_deg, state.position.el_deg)


@pytest.mark.parametrize(
    ("phase", "owner", "target"),
    [(Phase.FOLLOWING, "", "NOAA 19"), (Phase.OVER, "", ""), (Phase.OVER, "you", "you"),
     (Phase.WAITING, "monitor", "")],
)  # fmt: skip
def test_a_target_is_what_the_dish_follows_and_none_that_it_has_left(phase, owner, target):
    bench = Bench().connect(6.0)
    pursuit = SimpleNamespace(plan=SimpleNamespace(aim=SimpleNamespace(name="NOAA 19")), phase=phase)
    state = replace(bench.state, pursuit=pursuit, signal_owners={"tuner": owner} if owner else {})
    now = bench.clock.monotonic()
    reading = SignalReading(444.0, "counts", now, bench.clock.utc(), "tuner", 0.2)
    assert row_of(reading, TUNER_FACTS, state, now).target == target


def test_as_csv_it_says_what_it_is_and_names_of_enemies_stay_in_their_cell(tmp_path):
    path = tmp_path / "signal.sqlite"
    recorded(path, [row(0, target='a,"b"\n\x1b[2J'), row(1, lock=None)], {"where": "x"}, demo=True)
    lines = list(csv_lines(list_recordings(path)[0], read_recording(path, 1)))
    assert lines[0] == "# DEMO: a simulated dish, not a real one"
    assert lines[1] == "# source: tuner, unit: counts"
    assert "# where: x" in lines
    assert "# az_deg, el_deg: true degrees; value, scatter: counts; dwell_s: seconds; snr_db: dB" in lines
    assert all(line.isprintable() for line in lines)
    header, first, second = list(csv.reader(line for line in lines if not line.startswith("#")))
    told = dict(zip(header, first, strict=True))
    assert (told["utc"], told["value"], told["lock"], told["target"][:5]) == (
        "2026-11-24T12:00:00.000Z",
        "500.0",
        "1",
        'a,"b"',
    )
    assert dict(zip(header, second, strict=True))["lock"] == ""


def test_the_oldest_recordings_make_room(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_READINGS", 10)
    path = tmp_path / "signal.sqlite"
    recorded(path, [row(index) for index in range(6)])
    recorded(path, [row(1000 + index) for index in range(6)])
    recorded(path, [row(2000)])
    assert [(each.number, each.readings) for each in list_recordings(path)] == [(3, 1), (2, 6)]


def test_one_that_is_full_says_so_and_keeps_what_it_has(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_READINGS", 3)
    recorder = SignalRecorder(tmp_path / "signal.sqlite", TUNER_FACTS, {}, demo=False)
    for index in range(3):
        recorder.add(row(index))
    recorder._writer.flush(2.0)
    assert recorder.problem == "The recording is full with 3 readings. They are kept; begin another one."
    recorder.add(row(4))
    recorder.close()
    assert list_recordings(tmp_path / "signal.sqlite")[0].readings == 3


def test_a_file_of_something_else_is_said_and_left_as_it_is(tmp_path):
    path = tmp_path / "signal.sqlite"
    path.write_bytes(b"no database at all " * 100)
    recorder = recorded(path, [row()])
    assert "is damaged" in recorder.problem
    assert path.read_bytes().startswith(b"no database")


@pytest.mark.parametrize(
    ("make", "said"),
    [
        ("CREATE TABLE theirs (a)", "is a database of another program"),
        ("PRAGMA user_version = 99", "was written by a newer birdcage (version 99"),
        (f"CREATE TABLE theirs (a); PRAGMA user_version = {len(MIGRATIONS)}", "no such table"),
    ],
)  # fmt: skip
def test_a_database_of_others_is_said_and_left_as_it_is(tmp_path, make, said):
    path = tmp_path / "signal.sqlite"
    with closing(sqlite3.connect(path)) as theirs:
        theirs.executescript(f"PRAGMA journal_mode = WAL; {make};")
    before = path.read_bytes()
    assert said in recorded(path, [row()]).problem
    with pytest.raises(StoreError, match=re.escape(said)):
        list_recordings(path)
    assert path.read_bytes() == before


def test_one_of_before_is_taken_over_and_its_numbers_are_unknown(tmp_path):
    path = tmp_path / "signal.sqlite"
    with closing(open_database(path, module.MIGRATIONS[:1])) as old:
        old.execute("INSERT INTO recording VALUES (4, ?, ?, 'tuner', 'counts', '{}', 0)", [NOON.isoformat()] * 2)
        old.execute(
            "INSERT INTO reading VALUES (4, ?, 1, 2, 500, NULL, 1, NULL, 7, 1, 'V', '119W', 'idle')",
            [NOON.isoformat()],
        )
    (reading,) = read_recording(path, 4)
    assert (reading.value, reading.n, reading.scatter, reading.target) == (500.0, None, None, "119W")
    recorded(path, [row(5)])
    assert [each.number for each in list_recordings(path)] == [5, 4]


BESIDE = """
import sys
from pathlib import Path
sys.path[:0] = sys.argv[2:]
from tests.signal.test_recording import SignalRecorder, TUNER_FACTS, row
recorder = SignalRecorder(Path(sys.argv[1]), TUNER_FACTS, {}, demo=False)
for index in range(300):
    recorder.add(row(index, value=1000.0 + index, target="theirs"))
    if index % 10 == 0:
        recorder._writer.flush(10.0)
recorder.close(10.0)
print(recorder.problem or recorder.kept)
"""


def test_two_programs_record_at_the_same_time_and_each_has_its_own(tmp_path):
    path = tmp_path / "signal.sqlite"
    recorded(path, [])
    beside = subprocess.Popen([sys.executable, "-c", BESIDE, path, *sys.path], stdout=subprocess.PIPE, text=True)
    ours = SignalRecorder(path, TUNER_FACTS, {}, demo=False)
    for index in range(300):
        ours.add(row(index))
        if index % 10 == 0:
            ours._writer.flush(10.0)
    ours.close(10.0)
    said, _ = beside.communicate(timeout=60)
    assert (said.strip(), ours.problem, ours.kept) == ("300", "", 300)
    mine = next(each.number for each in list_recordings(path) if each.targets == ("119W",))
    assert {each.number for each in list_recordings(path)} == {1, 2}
    assert [each.value for each in read_recording(path, mine)] == [500.0 + index for index in range(300)]
    assert [each.value for each in read_recording(path, 3 - mine)] == [1000.0 + index for index in range(300)]


def test_what_another_program_records_now_makes_no_room(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "MOST_READINGS", 5)
    path = tmp_path / "signal.sqlite"
    theirs = SignalRecorder(path, TUNER_FACTS, {}, demo=False)
    for index in range(4):
        theirs.add(row(index))
    theirs._writer.flush(5.0)
    recorded(path, [row(2), row(3)])
    recorded(path, [row(4)])
    monkeypatch.setattr(module, "MOST_READINGS", 100)
    theirs.add(row(5))
    theirs.close()
    assert theirs.problem == ""
    assert [(each.number, each.readings) for each in list_recordings(path)] == [(3, 1), (2, 2), (1, 5)]


ON_A_FULL_DISK = """
import resource, sys, time
from pathlib import Path
sys.path[:0] = sys.argv[2:]
from tests.signal.test_recording import SignalRecorder, TUNER_FACTS, row
recorder = SignalRecorder(Path(sys.argv[1]), TUNER_FACTS, {}, demo=False)
recorder.add(row(0))
recorder._writer.flush(5.0)
resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))
for index in range(1, 6000):
    recorder.add(row(index))
    if index % 100 == 0:
        recorder._writer.flush(5.0)
recorder.close()
print(recorder.problem)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no such limit there")
def test_a_full_disk_ends_it_with_a_message_and_keeps_what_was_measured(tmp_path):
    path = tmp_path / "signal.sqlite"
    done = subprocess.run(
        [sys.executable, "-c", ON_A_FULL_DISK, path, *sys.path], capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("The recording has stopped: "), done.stdout
    kept = int(done.stdout.split(" readings are kept")[0].rsplit(maxsplit=1)[-1])
    assert kept > 50
    assert list_recordings(path)[0].readings == kept


KILLED = """
import sys, time
from pathlib import Path
sys.path[:0] = sys.argv[2:]
from tests.signal.test_recording import SignalRecorder, TUNER_FACTS, row
recorder = SignalRecorder(Path(sys.argv[1]), TUNER_FACTS, {}, demo=False)
for index in range(10_000):
    recorder.add(row(index))
    recorder._writer.flush(5.0)
    print(index, flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal there")
def test_killed_in_the_middle_it_has_all_that_was_on_disk(tmp_path):
    path = tmp_path / "signal.sqlite"
    child = subprocess.Popen([sys.executable, "-c", KILLED, path, *sys.path], stdout=subprocess.PIPE, text=True)
    told = [child.stdout.readline() for _ in range(60)]
    child.send_signal(signal.SIGKILL)
    child.wait(10)
    child.stdout.close()
    rows = read_recording(path, 1)
    assert len(rows) >= len(told)
    assert [each.value for each in rows] == [500.0 + index for index in range(len(rows))]
    with sqlite3.connect(path) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchone() == ("ok",)
    connection.close()


def test_nothing_recorded_yet_is_no_error(tmp_path):
    assert list_recordings(tmp_path / "signal.sqlite") == []
