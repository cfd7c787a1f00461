"""The tables of `catalogue.sqlite`.

A satellite is known by its key: its catalogue number, or its name where it has none. What the user says about it
(`note`, `tag`) stands apart from the elements, and outlives each set of them.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager

from birdcage.base.errors import StoreError
from birdcage.base.reason import Reason
from birdcage.base.store import Migration

MIGRATIONS: tuple[Migration, ...] = (
    (
        """CREATE TABLE satellite (
            key TEXT PRIMARY KEY, name TEXT NOT NULL, norad_id INTEGER NOT NULL, epoch TEXT NOT NULL,
            inclination_deg REAL NOT NULL, raan_deg REAL NOT NULL, eccentricity REAL NOT NULL,
            argument_of_perigee_deg REAL NOT NULL, mean_anomaly_deg REAL NOT NULL, mean_motion_rev_day REAL NOT NULL,
            bstar REAL NOT NULL, mean_motion_dot REAL NOT NULL, mean_motion_ddot REAL NOT NULL,
            international_designator TEXT NOT NULL, revolution INTEGER NOT NULL, source TEXT NOT NULL,
            fetched TEXT NOT NULL
        ) WITHOUT ROWID""",
        "CREATE INDEX satellite_by_name ON satellite (name COLLATE NOCASE)",
        """CREATE TABLE membership (
            key TEXT NOT NULL, group_name TEXT NOT NULL, PRIMARY KEY (group_name, key)
        ) WITHOUT ROWID""",
        "CREATE INDEX membership_by_key ON membership (key)",
        """CREATE TABLE note (
            key TEXT PRIMARY KEY, favourite INTEGER NOT NULL DEFAULT 0, priority INTEGER NOT NULL DEFAULT 0,
            time_offset_s REAL, time_offset_set TEXT
        ) WITHOUT ROWID""",
        "CREATE TABLE tag (key TEXT NOT NULL, tag TEXT NOT NULL, PRIMARY KEY (key, tag)) WITHOUT ROWID",
        """CREATE TABLE source (
            name TEXT PRIMARY KEY, url TEXT NOT NULL, etag TEXT, last_modified TEXT, checked TEXT, fetched TEXT,
            paused_until TEXT, problem TEXT
        ) WITHOUT ROWID""",
        "CREATE TABLE host (name TEXT PRIMARY KEY, paused_until TEXT NOT NULL, problem TEXT NOT NULL) WITHOUT ROWID",
    ),
    # Names used to be kept as they came, control characters and all.
    (
        *(
            f"UPDATE OR REPLACE {table} SET {column} = clean({column}) WHERE {column} != clean({column})"  # noqa: S608 - our own names
            for table, columns in (
                ("satellite", ("key", "name", "international_designator", "source")),
                ("membership", ("key", "group_name")),
                ("note", ("key",)),
                ("tag", ("key", "tag")),
                ("source", ("name", "problem")),
                ("host", ("problem",)),
            )
            for column in columns
        ),
    ),
)


@contextmanager
def told() -> Iterator[None]:
    """Turn an error of the database into a sentence: StoreError, reason ``failed`` or ``damaged``."""
    try:
        yield
    except sqlite3.DatabaseError as error:
        reason = Reason.FAILED if isinstance(error, sqlite3.OperationalError) else Reason.DAMAGED
        raise StoreError(f"The catalogue of satellites can't be used: {error}.", reason=reason) from error
