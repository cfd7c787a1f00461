"""The journal of faults: what went wrong with the dish, and when."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import StoreError
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database

if TYPE_CHECKING:
    import sqlite3


@dataclass(frozen=True, slots=True)
class JournalEntry:
    """One fault."""

    utc: datetime
    kind: str
    """What sort: `stall`, `link`, `limit`, ..."""
    reason: str
    """A word that a program can test."""
    sentence: str
    """For a person."""


class Journal:
    """Appends faults from any thread without waiting; a thread of its own writes them."""

    def __init__(self, path: Path) -> None:
        self.problem: str | None = None
        """Why faults are not being kept, in a sentence; None when all is well."""
        self._path = path
        self._connection: sqlite3.Connection | None = None
        self._writer: BackgroundWriter[JournalEntry] = BackgroundWriter("journal", self._write, size=1024)

    def append(self, entry: JournalEntry) -> None:
        """Keep `entry`. Returns at once."""
        self._writer.offer(entry)

    def flush(self, timeout_s: float = 2.0) -> bool:
        """Wait until all is on disk; False if that took too long."""
        return self._writer.flush(timeout_s)

    def close(self, timeout_s: float = 2.0) -> None:
        """Write what is waiting and end the thread, whose connection goes with it."""
        self._writer.close(timeout_s)

    def _write(self, entries: list[JournalEntry], dropped: int) -> None:
        if dropped:
            text = f"{dropped} faults are missing here: they came faster than they could be written."
            entries = [*entries, JournalEntry(datetime.now(UTC), "journal", "dropped", text)]
        if not entries:
            return
        import sqlite3  # when there is something to keep: a face paints without it

        try:
            if self._connection is None:
                self._connection = open_database(self._path, MIGRATIONS)
            self._connection.execute("BEGIN")
            self._connection.executemany(
                "INSERT INTO fault (utc, kind, reason, sentence) VALUES (?, ?, ?, ?)",
                [(_stamp(each.utc), each.kind, each.reason, each.sentence) for each in entries],
            )
            self._connection.execute("COMMIT")
            self.problem = None
        except (StoreError, sqlite3.Error) as error:
            # The station shows faults whether they can be kept or not; that they can't is shown too.
            self.problem = f"Faults are not being kept: {error}"
            if self._connection is not None:
                self._connection.close()
                self._connection = None


def read_journal(path: Path, limit: int = 100) -> list[JournalEntry]:
    """Return the latest faults, newest first; none if there is no journal yet. StoreError if it can't be read."""
    if not path.exists():
        return []
    connection = open_database(path, MIGRATIONS)
    try:
        rows = connection.execute(
            "SELECT utc, kind, reason, sentence FROM fault ORDER BY id DESC LIMIT ?", (limit,)
        ).fetchall()
    finally:
        connection.close()
    return [JournalEntry(datetime.fromisoformat(utc), kind, reason, text) for utc, kind, reason, text in rows]


def _stamp(utc: datetime) -> str:
    return utc.astimezone(UTC).isoformat(timespec="milliseconds")
