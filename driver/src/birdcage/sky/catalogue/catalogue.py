"""The catalogue: element sets by satellite, the newest of each, and what the user says about them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from types import TracebackType
from typing import NamedTuple, Self

from birdcage.base.errors import BirdcageError
from birdcage.base.reason import Reason
from birdcage.base.store import open_database
from birdcage.base.text import clean
from birdcage.sky.ahead import AHEAD, is_ahead
from birdcage.sky.catalogue.entry import CatalogueEntry, key_of
from birdcage.sky.catalogue.groups import CatalogueGroups, stamp
from birdcage.sky.catalogue.rows import COLUMNS, ELEMENTS, elements_of, read_entries, row_of
from birdcage.sky.catalogue.schema import MIGRATIONS, told
from birdcage.sky.catalogue.search import SearchIndex
from birdcage.sky.elements import ElementSet


class AddedElements(NamedTuple):
    """What came of adding elements."""

    new: int
    """Satellites that were not known."""
    newer: int
    """Whose elements were replaced by newer ones."""
    kept: int
    """Whose elements were as new, or newer: they stay."""


class Catalogue:
    """`catalogue.sqlite`, opened for the calling thread alone: every thread makes one of its own.

    Raises StoreError (see `open_database`), also by its methods when the file cannot be read or written.
    """

    def __init__(self, path: Path) -> None:
        self._connection = open_database(path, MIGRATIONS)
        self._changes = 0
        self._index: tuple[tuple[int, int], SearchIndex] | None = None
        self.groups = CatalogueGroups(self._connection)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file. Nothing else may be called afterwards."""
        self._connection.close()

    @property
    def version(self) -> tuple[int, int]:
        """Something that differs once satellites or notes have changed, also by another program: cheap to ask."""
        with told():
            return self._connection.execute("PRAGMA data_version").fetchone()[0], self._changes

    def add(
        self,
        elements: Iterable[ElementSet],
        *,
        group: str | None = None,
        whole_group: bool = False,
        fetched: datetime | None = None,
    ) -> AddedElements:
        """Take in elements; of each satellite those with the newest epoch stay. All of it happens or nothing.

        An epoch that is too far ahead of `fetched` counts as older than every other (`birdcage.sky.ahead`).
        `group`: the satellites belong to it from now on, and with `whole_group` no other does. Elements without a
        name take the one that is known. `fetched` is when they came, UTC; now if not given.
        """
        group = None if group is None else clean(group)
        now = fetched or datetime.now(UTC)

        def rank(epoch: datetime) -> tuple[bool, datetime]:
            return not is_ahead(epoch, now), epoch

        best: dict[str, ElementSet] = {}
        for each in elements:
            known = best.get(key_of(each))
            if known is None or rank(each.epoch) > rank(known.epoch):
                best[key_of(each)] = each
        with self._change():
            old = dict(self._connection.execute("SELECT key, epoch FROM satellite"))
            names = dict(self._connection.execute("SELECT key, name FROM satellite"))
            rows, new, newer = [], 0, 0
            stamped = stamp(now)
            for key, each in best.items():
                if key in old and rank(datetime.fromisoformat(old[key])) >= rank(each.epoch):
                    continue
                new, newer = (new, newer + 1) if key in old else (new + 1, newer)
                rows.append((key, *row_of(_named(each, names.get(key))), stamped))
            marks = ", ".join("?" * (len(COLUMNS) + 2))
            self._connection.executemany(
                f"REPLACE INTO satellite (key, {', '.join(COLUMNS)}, fetched) VALUES ({marks})",  # noqa: S608 - ours
                rows,
            )
            if group is not None:
                if whole_group:
                    self._connection.execute("DELETE FROM membership WHERE group_name = ?", (group,))
                self.add_to_group(group, best)
        return AddedElements(new, newer, len(best) - len(rows))

    def add_to_group(self, group: str, satellites: Iterable[int | str]) -> None:
        """Let satellites belong to a group; numbers of which nothing is known yet will, once their elements come."""
        rows = [(clean(group), self._key(each)) for each in satellites]
        with self._change():
            self._connection.executemany("INSERT OR IGNORE INTO membership (group_name, key) VALUES (?, ?)", rows)

    def remove(self, satellites: Iterable[int | str]) -> int:
        """Take satellites out, by number or name; return how many there were. What the user said of them is kept."""
        removed = 0
        with self._change():
            for each in satellites:
                key = self._key(each)
                members = self._connection.execute("SELECT group_name FROM membership WHERE key = ?", (key,)).fetchall()
                # The server would say that nothing is new, and the satellite would never come back.
                self.groups.forget_versions(name for (name,) in members)
                self._connection.execute("DELETE FROM membership WHERE key = ?", (key,))
                removed += self._connection.execute("DELETE FROM satellite WHERE key = ?", (key,)).rowcount
        return removed

    def all(self, group: str | None = None) -> tuple[ElementSet, ...]:
        """Return the elements of every satellite, or of those in a group, by key: the order is stable."""
        query = f"SELECT {ELEMENTS} FROM satellite"  # noqa: S608 - our own column names
        if group is not None:
            query += " JOIN membership USING (key) WHERE group_name = ?"
        with told():
            found = self._connection.execute(f"{query} ORDER BY key", () if group is None else (group,))
            return tuple(elements_of(row) for row in found)

    def get(self, satellite: int | str) -> ElementSet | None:
        """Return the elements of a satellite by number or by its whole name (case does not count); None if unknown."""
        entry = self.entry(satellite)
        return None if entry is None else entry.elements

    def entry(self, satellite: int | str) -> CatalogueEntry | None:
        """Return all about a satellite by number or by its whole name; of several with one name the newest epoch."""
        return next(iter(read_entries(self._connection, "WHERE satellite.key = ?", (self._key(satellite),))), None)

    def entries(self) -> tuple[CatalogueEntry, ...]:
        """Return all about every satellite, in the order of `all`."""
        return tuple(read_entries(self._connection))

    def search(self, text: str, limit: int = 20) -> tuple[CatalogueEntry, ...]:
        """Search as one types; see `SearchIndex.search`. The index is built again only after a change."""
        return self.index().search(text, limit)

    def index(self) -> SearchIndex:
        """Return the index over all there is now. It may be handed to any thread."""
        version = self.version
        if self._index is None or self._index[0] != version:
            self._index = version, SearchIndex(read_entries(self._connection))
        return self._index[1]

    def favourites(self) -> tuple[CatalogueEntry, ...]:
        """Return the favourites, those of high priority first, then by name."""
        found = read_entries(self._connection, "WHERE note.favourite")
        return tuple(sorted(found, key=lambda each: (-each.priority, each.name.casefold())))

    def set_favourite(self, satellite: int | str, favourite: bool = True) -> None:
        """Make a satellite a favourite, or no longer one. BirdcageError ``no_satellite`` where there is none."""
        self._note(satellite, "favourite", int(favourite))

    def set_priority(self, satellite: int | str, priority: int) -> None:
        """Set its priority, 0 to 9: higher comes first. ValueError outside."""
        if not 0 <= priority <= 9:
            raise ValueError(f"a priority is 0 to 9, not {priority}")
        self._note(satellite, "priority", priority)

    def set_time_offset(
        self, satellite: int | str, time_offset_s: float | None, *, now: datetime | None = None
    ) -> None:
        """Remember how much later than computed a satellite comes (negative: earlier), with the date; None forgets it.

        ValueError for more than an hour: these are no longer its elements.
        """
        if time_offset_s is not None and not abs(time_offset_s) <= 3600.0:
            raise ValueError(f"a time offset is at most 3600 s, not {time_offset_s:g}")
        with self._change():
            self._note(satellite, "time_offset_s", time_offset_s)
            moment = None if time_offset_s is None else stamp(now or datetime.now(UTC))
            self._note(satellite, "time_offset_set", moment)

    def set_tags(self, satellite: int | str, tags: Iterable[str]) -> None:
        """Give a satellite these tags and no others."""
        key = self._known(satellite)
        with self._change():
            self._connection.execute("DELETE FROM tag WHERE key = ?", (key,))
            rows = [(key, tag) for tag in (clean(each).strip() for each in tags) if tag]
            self._connection.executemany("INSERT OR IGNORE INTO tag VALUES (?, ?)", rows)

    def _note(self, satellite: int | str, column: str, value: object) -> None:
        key = self._known(satellite)
        with self._change():
            self._connection.execute("INSERT OR IGNORE INTO note (key) VALUES (?)", (key,))
            self._connection.execute(f"UPDATE note SET {column} = ? WHERE key = ?", (value, key))  # noqa: S608 - ours

    def _known(self, satellite: int | str) -> str:
        entry = self.entry(satellite)
        if entry is None:
            raise BirdcageError(f"The catalogue has no satellite called {satellite}.", reason=Reason.NO_SATELLITE)
        return entry.key

    def _key(self, satellite: int | str) -> str:
        text = clean(str(satellite)).strip()
        if text.isdigit():
            return str(int(text))
        with told():
            row = self._connection.execute(
                "SELECT key FROM satellite WHERE name = ? COLLATE NOCASE ORDER BY epoch > ?, epoch DESC LIMIT 1",
                (text, stamp(datetime.now(UTC) + AHEAD)),
            ).fetchone()
        return text.casefold() if row is None else row[0]

    @contextmanager
    def _change(self) -> Iterator[None]:
        """Make all changes in it one; within another one, a part of that."""
        with told():
            if self._connection.in_transaction:
                yield
                return
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield
            except BaseException:
                self._connection.execute("ROLLBACK")
                raise
            self._connection.execute("COMMIT")
            self._changes += 1


def _named(elements: ElementSet, name: str | None) -> ElementSet:
    plain = elements.name.strip()
    return replace(elements, name=name) if name and (not plain or plain.isdigit()) else elements
