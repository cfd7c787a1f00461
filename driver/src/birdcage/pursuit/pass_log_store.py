"""The log of passes in the journal: what the writer's thread does with the database."""

from __future__ import annotations

from datetime import datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.journal_schema import MIGRATIONS
from birdcage.base.store import open_database
from birdcage.pursuit.made_files import size_of
from birdcage.pursuit.pass_listener import PassFile, PassRemark
from birdcage.pursuit.pass_log_items import Item, PassBegan, PassEnded, PassLooked, PassTold
from birdcage.pursuit.pass_record import HEAD, SAMPLE, PassHead, stored

if TYPE_CHECKING:
    import sqlite3
    from collections.abc import Sequence

MOST_EARLY_REMARKS = 200
"""Lines of text, and files, about a pass that has not begun."""
MOST_FILES = 200
"""Of one pass. What hooks tell beyond that is left out."""
AFTERWARDS = timedelta(minutes=30)
"""How long after a pass a remark on its target is still about it, and not about the next one."""


class PassStore:
    """One connection, for one thread. Each call of `write` happens whole or not at all."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._connection: sqlite3.Connection | None = None
        self._open: int | None = None
        self._open_name = ""
        self._latest: dict[str, tuple[int, datetime | None]] = {}
        """The last pass of each target since this program began, and when it ended."""
        self._early: list[PassRemark | PassFile] = []

    def write(self, items: Sequence[Item]) -> None:
        """Write some items. StoreError or sqlite3.Error if that can't be; then nothing of them is written."""
        before = (self._open, self._open_name, dict(self._latest), list(self._early))
        try:
            if self._connection is None:
                self._connection = open_database(self._path, MIGRATIONS)
            self._connection.execute("BEGIN IMMEDIATE")
            for item in items:
                self._write(self._connection, item)
            self._connection.execute("COMMIT")
        except BaseException:
            self._open, self._open_name, self._latest, self._early = before
            if self._connection is not None:
                self._connection.close()  # which takes back what was begun
                self._connection = None
            raise

    def _write(self, connection: sqlite3.Connection, item: Item) -> None:
        if isinstance(item, PassBegan):
            self._begin(connection, item)
        elif isinstance(item, PassTold):
            names = ", ".join(f"{name} = ?" for name in HEAD if name != "elements_epoch")
            values = [value for name, value in _row(item.head) if name != "elements_epoch"]
            connection.execute(f"UPDATE pass SET {names} WHERE id = ?", (*values, self._open))  # noqa: S608 - our own names
        elif isinstance(item, PassLooked):
            marks = ", ".join("?" * (len(SAMPLE) + 1))
            values = [stored(getattr(item.sample, name)) for name in SAMPLE]
            connection.execute(
                f"INSERT INTO pass_sample (pass, {', '.join(SAMPLE)}) VALUES ({marks})",  # noqa: S608 - our own names
                (self._open, *values),
            )
        elif isinstance(item, PassEnded):
            connection.execute(
                "UPDATE pass SET ended = ?, outcome = ?, latency_s = coalesce(?, latency_s) WHERE id = ?",
                (stored(item.utc), item.outcome, item.latency_s, self._open),
            )
            if self._open is not None:
                self._latest[self._open_name] = (self._open, item.utc)
                for (path,) in connection.execute(
                    "SELECT path FROM pass_file WHERE pass = ?", (self._open,)
                ).fetchall():
                    size_bytes, files = size_of(path) or (None, None)
                    connection.execute(
                        "UPDATE pass_file SET size_bytes = coalesce(?, size_bytes), files = coalesce(?, files) "
                        "WHERE pass = ? AND path = ?",
                        (size_bytes, files, self._open, path),
                    )
        else:
            self._remark(connection, item)

    def _begin(self, connection: sqlite3.Connection, item: PassBegan) -> None:
        row = [*_row(item.head), ("csv", item.csv)]
        names, marks = ", ".join(name for name, _ in row), ", ".join("?" * len(row))
        cursor = connection.execute(
            f"INSERT INTO pass ({names}) VALUES ({marks})",  # noqa: S608 - our own names
            [value for _, value in row],
        )
        self._open, self._open_name = int(cursor.lastrowid or 0), item.head.name
        self._latest[self._open_name] = (self._open, None)
        waiting, self._early = self._early, []
        for each in waiting:
            self._remark(connection, each)

    def _remark(self, connection: sqlite3.Connection, item: PassRemark | PassFile) -> None:
        number, ended = self._latest.get(item.name, (None, None))
        if number is None or (ended is not None and item.utc - ended > AFTERWARDS):
            self._early = [*self._early, item][-MOST_EARLY_REMARKS:]
            return
        if isinstance(item, PassRemark):
            connection.execute(
                "INSERT INTO pass_remark (pass, utc, text) VALUES (?, ?, ?)", (number, stored(item.utc), item.text)
            )
            return
        kept = "SELECT count(*) FROM pass_file WHERE pass = ? AND path != ?"
        if connection.execute(kept, (number, item.path)).fetchone()[0] >= MOST_FILES:
            return
        size_bytes, files = size_of(item.path) or (None, None)
        connection.execute(
            "INSERT OR REPLACE INTO pass_file (pass, utc, path, size_bytes, files) VALUES (?, ?, ?, ?, ?)",
            (number, stored(item.utc), item.path, size_bytes, files),
        )


def _row(head: PassHead) -> list[tuple[str, object]]:
    return [(name, stored(getattr(head, name))) for name in HEAD]
