"""Opens every database of ours: SQLite, WAL, migrations by `user_version`."""

from __future__ import annotations

import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from birdcage.base.errors import StoreError
from birdcage.base.reason import Reason
from birdcage.base.text import clean
from birdcage.base.user_file import check_regular

if TYPE_CHECKING:
    import sqlite3

BUSY_TIMEOUT_S = 5.0
"""How long to wait for another program that is writing."""
RETRY_S = 0.01
"""How long to wait before a file that another thread or program is just making is tried again."""

Migration = Sequence[str]
"""The SQL statements that lead from one version to the next; they may call `clean` of `base.text`."""


def open_database(path: Path, migrations: Sequence[Migration]) -> sqlite3.Connection:
    """Open `path`, bring it to version `len(migrations)` and return a connection for the calling thread alone.

    Each migration happens whole or not at all, once, whoever else opens the file at that moment. Every statement
    outside a `BEGIN` commits by itself. Raises StoreError: ``newer`` (a later version of the program made it),
    ``damaged``, ``failed`` (no permission, disk full).
    """
    import sqlite3  # only once a database is wanted: a face paints without it

    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists():
            check_regular(path)
        connection = sqlite3.connect(path, timeout=BUSY_TIMEOUT_S, isolation_level=None)
    except (OSError, sqlite3.Error) as error:
        raise StoreError(f"{path} cannot be opened: {error}. Check the folder and its permissions.") from error
    try:
        _use_wal(connection)
        connection.execute("PRAGMA synchronous = NORMAL")
        connection.execute("PRAGMA foreign_keys = ON")
        connection.create_function("clean", 1, _clean, deterministic=True)
        _migrate(connection, path, migrations)
    except sqlite3.OperationalError as error:
        connection.close()
        raise StoreError(f"{path} cannot be used: {error}. Check its permissions and the room on the disk.") from error
    except sqlite3.DatabaseError as error:
        connection.close()
        raise StoreError(
            f"{path} is damaged ({error}). Move it away: a new one is made at the next start.", reason=Reason.DAMAGED
        ) from error
    except StoreError:
        connection.close()
        raise
    return connection


def _use_wal(connection: sqlite3.Connection) -> None:
    """Keep readers and writers apart.

    A file that somebody else makes at this moment is tried again, as SQLite heeds no timeout here.
    """
    import sqlite3

    until = time.monotonic() + BUSY_TIMEOUT_S
    while True:
        try:
            connection.execute("PRAGMA journal_mode = WAL")
            return
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode != sqlite3.SQLITE_BUSY or time.monotonic() > until:
                raise
        threading.Event().wait(RETRY_S)


def _clean(value: str | bytes | float | None) -> str | bytes | float | None:
    """Return a value of any column, clean where it is text: what SQL calls `clean`."""
    return clean(value) if isinstance(value, str) else value


def fingerprint(path: Path) -> tuple[object, ...]:
    """Return something that differs after a database was written to, by whichever program; None if a file lacks."""
    found: list[object] = []
    for each in (path, path.with_name(f"{path.name}-wal")):
        try:
            state = each.stat()
        except FileNotFoundError:
            found.append(None)
        else:
            found.append((state.st_mtime_ns, state.st_size))
    return tuple(found)


def _migrate(connection: sqlite3.Connection, path: Path, migrations: Sequence[Migration]) -> None:
    if _version(connection) == len(migrations):
        return
    # The lock comes before the second look: another program may have migrated in between.
    connection.execute("BEGIN IMMEDIATE")
    try:
        version = _version(connection)
        if not version and connection.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]:
            raise StoreError(
                f"{path} is a database of another program. It is left as it is. Move it away, and begin again.",
                reason=Reason.DAMAGED,
            )
        if version > len(migrations):
            raise StoreError(
                f"{path} was written by a newer birdcage (version {version}, this one knows {len(migrations)}). "
                "Update birdcage, or move the file away.",
                reason=Reason.NEWER,
            )
        for statements in migrations[version:]:
            for statement in statements:
                connection.execute(statement)
        connection.execute(f"PRAGMA user_version = {len(migrations)}")
    except BaseException:
        connection.execute("ROLLBACK")
        raise
    connection.execute("COMMIT")


def _version(connection: sqlite3.Connection) -> int:
    return int(connection.execute("PRAGMA user_version").fetchone()[0])
