"""The journal: what went wrong with the dish, what happened to its link, and when."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import StoreError
from birdcage.base.journal_rows import JournalEntry, JournalRow
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database

if TYPE_CHECKING:
    import sqlite3

JOURNAL = "journal"
"""Under which subject a station warns that its journal is not being kept."""
ENTRIES = "SELECT utc, kind, reason, sentence, dish, axis, homing, az_deg, el_deg FROM fault"
"""The rows that `entry_of` takes."""


class Journal:
    """Appends from any thread without waiting; a thread of its own writes."""

    def __init__(self, path: Path) -> None:
        self.problem: str | None = None
        """Why faults are not being kept, in a sentence; None when all is well."""
        self._path = path
        self._connection: sqlite3.Connection | None = None
        self._writer: BackgroundWriter[JournalRow] = BackgroundWriter("journal", self._write, size=1024)

    def append(self, row: JournalRow) -> None:
        """Keep `row`. Returns at once."""
        self._writer.offer(row)

    def flush(self, timeout_s: float = 2.0) -> bool:
        """Wait until all is on disk; False if that took too long."""
        return self._writer.flush(timeout_s)

    def close(self, timeout_s: float = 2.0) -> None:
        """Write what is waiting and end the thread, whose connection goes with it."""
        self._writer.close(timeout_s)

    def _write(self, rows: list[JournalRow], dropped: int) -> None:
        if dropped:
            text = f"{dropped} faults are missing here: they came faster than they could be written."
            rows = [*rows, JournalEntry(datetime.now(UTC), "journal", "dropped", text)]
        if not rows:
            return
        import sqlite3  # when there is something to keep: a face paints without it

        try:
            if self._connection is None:
                self._connection = open_database(self._path, MIGRATIONS)
            self._connection.execute("BEGIN IMMEDIATE")
            for each in rows:
                self._connection.execute(each.statement, each.cells())
            self._connection.execute("COMMIT")
            self.problem = None
        except (StoreError, sqlite3.Error) as error:
            # The station shows faults whether they can be kept or not; that they can't is shown too.
            self.problem = f"Faults are not being kept: {error}"
            if self._connection is not None:
                self._connection.close()
                self._connection = None


def read_journal(path: Path, limit: int = 100) -> list[JournalEntry]:
    """Return the latest faults and ends of tasks, newest first; none if there is no journal yet.

    StoreError if it can't be read.
    """
    if not path.exists():
        return []
    connection = open_database(path, MIGRATIONS)
    try:
        rows = connection.execute(ENTRIES + " ORDER BY id DESC LIMIT ?", (limit,)).fetchall()
    finally:
        connection.close()
    return [entry_of(row) for row in rows]


def entry_of(row: tuple[Any, ...]) -> JournalEntry:
    """Return the fault that a row of `ENTRIES` is."""
    utc, kind, reason, sentence, dish, axis, homing, az_deg, el_deg = row
    return JournalEntry(
        datetime.fromisoformat(utc), kind, reason, sentence, dish, axis, bool(homing), az_deg, el_deg
    )  # fmt: skip
