"""The tables of `journal.sqlite`: faults, wear and passes share one file, and so one row of migrations.

Each entry leads from one version of the file to the next. An entry that was released is never changed: a file out there
has been through it. Append another one.
"""

from __future__ import annotations

FAULTS = (
    """CREATE TABLE fault (
        id INTEGER PRIMARY KEY, utc TEXT NOT NULL, kind TEXT NOT NULL, reason TEXT NOT NULL, sentence TEXT NOT NULL
    )""",
    "CREATE INDEX fault_by_utc ON fault (utc)",
)
WEAR = (
    """CREATE TABLE wear (
        dish TEXT NOT NULL, axis INTEGER NOT NULL, moves INTEGER NOT NULL, degrees REAL NOT NULL,
        reversals INTEGER NOT NULL, since TEXT NOT NULL, PRIMARY KEY (dish, axis)
    )""",
)

MIGRATIONS = (FAULTS, WEAR)
"""Of the whole file. Whoever opens it passes this, so that nobody takes the others' tables for a newer program's."""
