"""Wear of a dish in `journal.sqlite`: how often and how far each of its axes was sent."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, date, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import StoreError
from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database

if TYPE_CHECKING:
    import sqlite3


@dataclass(frozen=True, slots=True)
class Wear:
    """What one axis has done, or has done since it was told last."""

    axis: int
    """Motor number."""
    moves: int
    """Commands that moved its target."""
    degrees: float
    """By how much in all, there and back."""
    reversals: int
    """How often it was sent the other way than the time before."""
    since: datetime | None = None
    """When counting began; None for what is only about to be added."""


class WearBook:
    """Adds up from any thread without waiting; a thread of its own writes."""

    def __init__(self, path: Path) -> None:
        self.problem: str | None = None
        """Why wear is not being kept, in a sentence; None when all is well."""
        self._path = path
        self._connection: sqlite3.Connection | None = None
        self._unwritten: dict[tuple[str, int, date], Wear] = {}
        """Of the writer's thread: what could not be written yet."""
        self._writer: BackgroundWriter[tuple[str, date, Wear]] = BackgroundWriter("wear", self._write, size=1024)

    def add(self, dish: str, wear: Wear, day: date | None = None) -> None:
        """Add to what an axis of this dish has done, on a UTC day, by default today. Returns at once."""
        self._writer.offer((dish, day or datetime.now(UTC).date(), wear))

    def flush(self, timeout_s: float = 2.0) -> bool:
        """Wait until all is on disk; False if that took too long."""
        return self._writer.flush(timeout_s)

    def close(self, timeout_s: float = 2.0) -> None:
        """Write what is waiting and end the thread."""
        self._writer.close(timeout_s)

    def _write(self, items: list[tuple[str, date, Wear]], _dropped: int) -> None:
        for dish, day, wear in items:
            before = self._unwritten.get((dish, wear.axis, day))
            self._unwritten[dish, wear.axis, day] = wear if before is None else _sum(before, wear)
        if not self._unwritten:
            return
        import sqlite3  # when there is something to keep: a face paints without it

        now = datetime.now(UTC).isoformat(timespec="seconds")
        days = [
            (dish, wear.axis, day.isoformat(), wear.moves, wear.degrees, wear.reversals)
            for (dish, _axis, day), wear in self._unwritten.items()
        ]
        rows = [(dish, axis, moves, degrees, turns, now) for dish, axis, _day, moves, degrees, turns in days]
        try:
            if self._connection is None:
                self._connection = open_database(self._path, MIGRATIONS)
            self._connection.execute("BEGIN IMMEDIATE")
            self._connection.executemany(
                """INSERT INTO wear (dish, axis, moves, degrees, reversals, since) VALUES (?, ?, ?, ?, ?, ?)
                ON CONFLICT (dish, axis) DO UPDATE SET moves = moves + excluded.moves,
                degrees = degrees + excluded.degrees, reversals = reversals + excluded.reversals""",
                rows,
            )
            self._connection.executemany(
                """INSERT INTO wear_day (dish, axis, day, moves, degrees, reversals) VALUES (?, ?, ?, ?, ?, ?)
                ON CONFLICT (dish, axis, day) DO UPDATE SET moves = moves + excluded.moves,
                degrees = degrees + excluded.degrees, reversals = reversals + excluded.reversals""",
                days,
            )
            self._connection.execute("COMMIT")
            self._unwritten.clear()
            self.problem = None
        except (StoreError, sqlite3.Error) as error:
            # It is added to the next time; the dish works whether its wear is known or not.
            self.problem = f"Wear is not being kept: {error}"
            if self._connection is not None:
                self._connection.close()
                self._connection = None


def _sum(one: Wear, other: Wear) -> Wear:
    return Wear(one.axis, one.moves + other.moves, one.degrees + other.degrees, one.reversals + other.reversals)


def read_wear(path: Path, dish: str) -> list[Wear]:
    """Return what each axis of this dish has done, by motor number; nothing if no journal exists yet.

    StoreError if it can't be read.
    """
    if not path.exists():
        return []
    connection = open_database(path, MIGRATIONS)
    try:
        rows = connection.execute(
            "SELECT axis, moves, degrees, reversals, since FROM wear WHERE dish = ? ORDER BY axis", (dish,)
        ).fetchall()
    finally:
        connection.close()
    return [
        Wear(axis, moves, degrees, turns, datetime.fromisoformat(since)) for axis, moves, degrees, turns, since in rows
    ]
