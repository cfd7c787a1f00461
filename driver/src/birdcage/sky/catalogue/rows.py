"""Rows of the database, and what they say: element sets and entries."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from dataclasses import fields
from datetime import datetime

from birdcage.sky.catalogue.entry import CatalogueEntry
from birdcage.sky.catalogue.groups import stamp, when
from birdcage.sky.catalogue.schema import told
from birdcage.sky.elements import ElementSet

COLUMNS = tuple(field.name for field in fields(ElementSet))
"""Those of an element set in the table `satellite`, in their order."""
ELEMENTS = ", ".join(f"satellite.{name}" for name in COLUMNS)
"""The same for a SELECT."""


def row_of(elements: ElementSet) -> tuple[object, ...]:
    """Return the values of `COLUMNS`."""
    return tuple(getattr(elements, name) if name != "epoch" else stamp(elements.epoch) for name in COLUMNS)


def elements_of(row: tuple[object, ...] | list[object]) -> ElementSet:
    """Return what the values of `COLUMNS` say."""
    name, norad_id, epoch, *rest = row
    return ElementSet(name, norad_id, datetime.fromisoformat(str(epoch)), *rest)  # type: ignore[arg-type]


def read_entries(
    connection: sqlite3.Connection, where: str = "", values: tuple[str, ...] = ()
) -> Iterator[CatalogueEntry]:
    """Yield all about every satellite, or of those that `where` (our own SQL) with its `values` picks, by key.

    StoreError when the file cannot be read.
    """
    with told():
        query = f"""SELECT {ELEMENTS}, satellite.key, satellite.fetched,
            note.favourite, note.priority, note.time_offset_s, note.time_offset_set
            FROM satellite LEFT JOIN note USING (key) {where} ORDER BY satellite.key"""  # noqa: S608 - ours
        rows = connection.execute(query, values).fetchall()
        groups = _several(connection, "SELECT key, group_name FROM membership ORDER BY group_name", rows)
        tags = _several(connection, "SELECT key, tag FROM tag ORDER BY tag", rows)
    for *columns, key, fetched, favourite, priority, offset_s, offset_set in rows:
        yield CatalogueEntry(
            elements_of(columns), datetime.fromisoformat(fetched), groups.get(key, ()), tags.get(key, ()),
            bool(favourite), priority or 0, offset_s, when(offset_set),
        )  # fmt: skip


def _several(connection: sqlite3.Connection, query: str, rows: list[tuple[object, ...]]) -> dict[str, tuple[str, ...]]:
    """Return the values by key, of one key alone where only one row is asked for."""
    values: tuple[object, ...] = ()
    if len(rows) == 1:
        query, values = query.replace(" ORDER", " WHERE key = ? ORDER"), (rows[0][len(COLUMNS)],)
    found: dict[str, tuple[str, ...]] = {}
    for key, value in connection.execute(query, values):
        found[key] = (*found.get(key, ()), value)
    return found
