"""Keeps readings of the signal in `signal.sqlite`, a row each, on disk within a second, and bounded."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import astuple, dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import StoreError
from birdcage.base.store import open_database
from birdcage.rotator.feature import LOCK, SNR
from birdcage.signal.heard_from import heard_from
from birdcage.signal.source import MONITOR, SignalFacts, SignalReading
from birdcage.station.pursuit_state import Phase
from birdcage.station.state import StationState

if TYPE_CHECKING:
    import sqlite3

COUNTED = (
    """CREATE TABLE counted (
        recording INTEGER NOT NULL REFERENCES recording (id) ON DELETE CASCADE, utc TEXT NOT NULL,
        az_deg REAL, el_deg REAL, value REAL NOT NULL, scatter REAL, n INTEGER, dwell_s REAL,
        snr_db REAL, lock INTEGER, polarisation TEXT, target TEXT NOT NULL, activity TEXT NOT NULL
    )""",
    """INSERT INTO counted SELECT recording, utc, az_deg, el_deg, value, NULL, NULL, dwell_s, snr_db, lock,
        polarisation, target, activity FROM reading ORDER BY rowid""",
    "DROP TABLE reading",
    "ALTER TABLE counted RENAME TO reading",
    "CREATE INDEX reading_by_recording ON reading (recording)",
)
"""A reading is the mean of `n` values of its source; before, it was put down as one, without being known."""
MAPS = (
    """CREATE TABLE map (
        id INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, plan TEXT NOT NULL, begun TEXT NOT NULL, ended TEXT,
        source TEXT NOT NULL, unit TEXT NOT NULL, decibels INTEGER NOT NULL, demo INTEGER NOT NULL, about TEXT NOT NULL
    )""",
    """CREATE TABLE map_settings (
        id INTEGER PRIMARY KEY, map INTEGER NOT NULL REFERENCES map (id) ON DELETE CASCADE, told TEXT NOT NULL,
        UNIQUE (map, told)
    )""",
    """CREATE TABLE map_sample (
        map INTEGER NOT NULL REFERENCES map (id) ON DELETE CASCADE, cell INTEGER, cross_number INTEGER,
        utc TEXT NOT NULL, az_deg REAL NOT NULL, el_deg REAL NOT NULL, aim_az_deg REAL, aim_el_deg REAL,
        value REAL NOT NULL, scatter REAL, n INTEGER NOT NULL, integration_s REAL, snr_db REAL, lock INTEGER,
        polarisation TEXT, settings INTEGER NOT NULL REFERENCES map_settings (id), target TEXT NOT NULL,
        state TEXT NOT NULL, UNIQUE (map, cell)
    )""",
)
"""Maps of the sky (`birdcage.skymap`): a cell that was heard has one row. Points of a reference cross have no cell."""
MIGRATIONS = (
    (
        """CREATE TABLE recording (
            id INTEGER PRIMARY KEY, begun TEXT NOT NULL, ended TEXT, source TEXT NOT NULL, unit TEXT NOT NULL,
            settings TEXT NOT NULL, demo INTEGER NOT NULL
        )""",
        """CREATE TABLE reading (
            recording INTEGER NOT NULL REFERENCES recording (id) ON DELETE CASCADE, utc TEXT NOT NULL,
            az_deg REAL, el_deg REAL, value REAL NOT NULL, scatter REAL, n INTEGER NOT NULL, dwell_s REAL,
            snr_db REAL, lock INTEGER, polarisation TEXT, target TEXT NOT NULL, activity TEXT NOT NULL
        )""",
        "CREATE INDEX reading_by_recording ON reading (recording)",
    ),
    COUNTED,
    MAPS,
)
"""Of the whole file. An entry that was released is never changed."""
MOST_READINGS = 2_000_000
"""In the file: a day and a half at ten a second, some 200 MB. The oldest recordings give way to a new one."""
UNDER_WAY_S = 120.0
"""A recording is under way while its last reading is no older: a source may be silent for a while."""
POLARISATION = "polarisation"
FRESH_S = 60.0
"""What the receiver last said counts so long: it is asked for SNR and lock in turn with other things."""


@dataclass(frozen=True, slots=True)
class RecordedReading:
    """One row. What was not known is None."""

    utc: datetime
    az_deg: float | None
    el_deg: float | None
    value: float
    scatter: float | None
    """Standard deviation of one of the `n` values, where the source tells it."""
    n: int | None
    """How many values of the source's own it is the mean of."""
    dwell_s: float | None
    snr_db: float | None
    lock: bool | None
    polarisation: str | None
    target: str
    """What the dish follows, or the source is read for; empty for neither."""
    activity: str


def row_of(reading: SignalReading, facts: SignalFacts, state: StationState, now: float) -> RecordedReading:
    """Return what is kept of a reading; `now` in monotonic seconds."""
    az_deg, el_deg = heard_from(reading.at, facts, state)
    told = {name: each.value for name, each in state.readings.items() if now - each.at <= FRESH_S}
    snr, lock, polarisation = told.get(SNR), told.get(LOCK), told.get(POLARISATION)
    owner, pursuit = state.signal_owners.get(facts.id, ""), state.pursuit
    followed = pursuit.plan.aim.name if pursuit is not None and pursuit.phase is Phase.FOLLOWING else ""
    return RecordedReading(
        reading.utc, az_deg, el_deg, reading.value, reading.scatter, reading.n, reading.dwell_s or None,
        float(snr) if isinstance(snr, int | float) else None, bool(lock) if lock is not None else None,
        None if polarisation is None else str(polarisation),
        followed or ("" if owner == MONITOR else owner),
        state.activity.value,
    )  # fmt: skip


def about(facts: SignalFacts, feed: str) -> dict[str, object]:
    """Return what source and feed are set to, for the head of a recording."""
    told = {"feed": feed, "label": facts.label, "where": facts.where, **dict(facts.set_to)}
    return {name: value for name, value in told.items() if value}


class SignalRecorder:
    """One recording, from its making to `close`. Any thread may hand it readings; a thread of its own writes them."""

    def __init__(self, path: Path, facts: SignalFacts, settings: Mapping[str, object], *, demo: bool) -> None:
        """`settings`: what the source and the feed were set to, kept as JSON."""
        self.problem = ""
        """Why it has stopped; what was measured before is kept."""
        self.kept = 0
        """Readings on disk."""
        self.number: int | None = None
        """Of the recording, once its first reading is on disk."""
        self._path, self._facts, self._settings, self._demo = path, facts, dict(settings), demo
        self._connection: sqlite3.Connection | None = None
        self._writer: BackgroundWriter[RecordedReading] = BackgroundWriter("signal recording", self._write)

    def add(self, row: RecordedReading) -> None:
        """Keep a reading. Returns at once."""
        if not self.problem:
            self._writer.offer(row)

    def close(self, timeout_s: float = 2.0) -> None:
        """Write what is waiting, and end."""
        self._writer.flush(timeout_s)
        self._writer.close(timeout_s)

    def _write(self, rows: list[RecordedReading], dropped: int) -> None:
        import sqlite3  # when there is something to keep: a face paints without it

        if self.problem or not rows:
            return
        try:
            connection = self._connection = self._connection or open_database(self._path, MIGRATIONS)
            connection.execute("BEGIN IMMEDIATE")
            if self.number is None:
                self.number = self._begin(connection, rows[0].utc)
            connection.executemany(
                f"INSERT INTO reading VALUES ({', '.join('?' * 13)})",  # noqa: S608 - question marks
                [(self.number, _stamp(each.utc), *astuple(each)[1:]) for each in rows],
            )
            connection.execute("UPDATE recording SET ended = ? WHERE id = ?", (_stamp(rows[-1].utc), self.number))
            connection.execute("COMMIT")
            self.kept += len(rows)
        except (StoreError, sqlite3.Error) as error:
            self._end(f"The recording has stopped: {error}. {self.kept} readings are kept.")
        else:
            if dropped:
                self._end(f"The disk is too slow, so the recording has stopped. {self.kept} readings are kept.")
            elif self.kept >= MOST_READINGS:
                self._end(f"The recording is full with {self.kept} readings. They are kept; begin another one.")

    def _begin(self, connection: sqlite3.Connection, utc: datetime) -> int:
        """Make room, and return the number of a new recording. What another program records now stays."""
        lengths = connection.execute(
            "SELECT recording, count(*), max(utc) FROM reading GROUP BY recording ORDER BY recording"
        ).fetchall()
        total = sum(length for _number, length, _last in lengths)
        for number, length, last in lengths:
            if total < MOST_READINGS:
                break
            if abs((utc - datetime.fromisoformat(last)).total_seconds()) < UNDER_WAY_S:
                continue
            connection.execute("DELETE FROM recording WHERE id = ?", (number,))
            total -= length
        made = connection.execute(
            "INSERT INTO recording (begun, source, unit, settings, demo) VALUES (?, ?, ?, ?, ?)",
            (_stamp(utc), self._facts.id, self._facts.unit, json.dumps(self._settings), self._demo),
        )
        assert made.lastrowid is not None, "it was inserted"
        return made.lastrowid

    def _end(self, problem: str) -> None:
        self.problem = problem
        connection, self._connection = self._connection, None
        if connection is not None:
            connection.close()


def _stamp(utc: datetime) -> str:
    return utc.astimezone(UTC).isoformat(timespec="milliseconds")
