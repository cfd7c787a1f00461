"""Groups of satellites, and the state of the sources that fill them: when, with what tag, and who asked for a pause."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, datetime

from birdcage.sky.catalogue.schema import told


@dataclass(frozen=True, slots=True)
class CatalogueGroup:
    """A group, and what is known of the place that it is fetched from. Times are UTC; None for what never happened."""

    name: str
    count: int = 0
    """How many satellites of it are in the catalogue."""
    url: str = ""
    """Where it was fetched from last; empty for a group that came out of a file."""
    etag: str | None = None
    last_modified: str | None = None
    """What the server called this version: sent back to ask whether there is a newer one."""
    checked: datetime | None = None
    """When the server last said what it has, be it that nothing is new."""
    fetched: datetime | None = None
    """When elements last came from there."""
    paused_until: datetime | None = None
    problem: str | None = None
    """Why the last try failed; None when it did not."""


class CatalogueGroups:
    """The groups of one catalogue; it belongs to the same thread."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection

    def all(self) -> tuple[CatalogueGroup, ...]:
        """Return every group that has satellites or was ever asked for, by name."""
        query = "SELECT group_name, count(*) FROM membership JOIN satellite USING (key) GROUP BY group_name"
        with told():
            counts = dict(self._connection.execute(query))
            states = {group.name: group for group in self._states(counts)}
        for name, count in counts.items():
            states.setdefault(name, CatalogueGroup(name, count))
        return tuple(states[name] for name in sorted(states))

    def get(self, name: str) -> CatalogueGroup:
        """Return one group; an empty one where nothing is known of it."""
        return next((group for group in self.all() if group.name == name), CatalogueGroup(name))

    def keep(self, group: CatalogueGroup) -> None:
        """Remember how a group's source stands."""
        values = (
            group.name, group.url, group.etag, group.last_modified, stamp(group.checked), stamp(group.fetched),
            stamp(group.paused_until), group.problem,
        )  # fmt: skip
        with told():
            self._connection.execute("REPLACE INTO source VALUES (?, ?, ?, ?, ?, ?, ?, ?)", values)

    def forget_versions(self, names: Iterable[str]) -> None:
        """Forget what the servers called the versions that we have: the next request fetches all of it."""
        query = "UPDATE source SET etag = NULL, last_modified = NULL, checked = NULL WHERE name = ?"
        with told():
            self._connection.executemany(query, [(name,) for name in names])

    def pause_host(self, host: str, until: datetime, problem: str) -> None:
        """Remember that a server does not want to be asked before `until`, and what it said."""
        with told():
            self._connection.execute("REPLACE INTO host VALUES (?, ?, ?)", (host, stamp(until), problem))

    def host_pause(self, host: str, now: datetime) -> tuple[datetime, str] | None:
        """Return until when a server does not want to be asked, and why; None when it may be."""
        query = "SELECT paused_until, problem FROM host WHERE name = ?"
        with told():
            row = self._connection.execute(query, (host,)).fetchone()
        until = None if row is None else datetime.fromisoformat(row[0])
        return None if until is None or until <= now else (until, row[1])

    def _states(self, counts: dict[str, int]) -> Iterable[CatalogueGroup]:
        query = "SELECT name, url, etag, last_modified, checked, fetched, paused_until, problem FROM source"
        for name, url, etag, modified, checked, fetched, paused, problem in self._connection.execute(query):
            yield CatalogueGroup(
                name, counts.get(name, 0), url, etag, modified, when(checked), when(fetched), when(paused), problem
            )


def stamp(moment: datetime | None) -> str | None:
    """Return a time as the database keeps it."""
    return None if moment is None else moment.astimezone(UTC).isoformat()


def when(text: str | None) -> datetime | None:
    """Return a time that the database kept."""
    return None if text is None else datetime.fromisoformat(text)
