"""Maps in `signal.sqlite`: written cell by cell as they are heard, listed, and read back."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, fields
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from birdcage.base.background import BackgroundWriter
from birdcage.base.errors import StoreError
from birdcage.base.store import open_database
from birdcage.base.text import clean, clean_all
from birdcage.signal.recording import MIGRATIONS
from birdcage.signal.recordings import reading_from
from birdcage.skymap.plan import MapPlan
from birdcage.skymap.sky_map import MapSample, SkyMap

if TYPE_CHECKING:
    import sqlite3

NAMES = [each.name for each in fields(MapSample)]
COLUMNS = ", ".join(NAMES)
TEXTS = ("polarisation", "target", "state")
CLOSE_S = 5.0


@dataclass(frozen=True, slots=True)
class MapHead:
    """What holds for a whole map, and how far it is."""

    number: int
    key: str
    """Names it across programs: whoever begins it makes it up."""
    plan: MapPlan
    begun: datetime
    ended: datetime | None
    """None while directions are missing."""
    source: str
    unit: str
    decibels: bool
    demo: bool
    about: Mapping[str, object]
    heard: int
    """How many directions."""
    low: float | None
    high: float | None


@dataclass(frozen=True, slots=True)
class NewMap:
    """What is written down of a map when its first direction is heard."""

    key: str
    plan: MapPlan
    source: str
    unit: str
    decibels: bool
    demo: bool
    about: Mapping[str, object]


_HEADS = (
    "SELECT map.id, key, plan, begun, ended, source, unit, decibels, demo, about, count(cell), "
    "min(value) FILTER (WHERE cell IS NOT NULL), max(value) FILTER (WHERE cell IS NOT NULL) "
    "FROM map LEFT JOIN map_sample ON map_sample.map = map.id"
)


def list_maps(path: Path) -> list[MapHead]:
    """Return all of them, the newest first; none where there is no file. StoreError if it can't be read."""
    if not path.exists():
        return []
    with reading_from(path) as connection:
        rows = connection.execute(f"{_HEADS} GROUP BY map.id ORDER BY map.id DESC").fetchall()
    return [head for row in rows if (head := _head(row)) is not None]


def find_map(path: Path, key: str) -> MapHead | None:
    """Return the one with this key. StoreError if the file can't be read."""
    return next((head for head in list_maps(path) if head.key == key), None)


def read_map(path: Path, number: int) -> SkyMap:
    """Return one, with all that was heard. StoreError if it can't be read, or there is none of this number."""
    with reading_from(path) as connection:
        head = connection.execute(f"{_HEADS} WHERE map.id = ? GROUP BY map.id", (number,)).fetchone()
        if head is None:
            raise StoreError(f"There is no map {number}. `birdcage maps` lists them.")
        settings = connection.execute(
            "SELECT id, told FROM map_settings WHERE map = ? ORDER BY id", (number,)
        ).fetchall()
        query = f"SELECT {COLUMNS} FROM map_sample WHERE map = ? ORDER BY rowid"  # noqa: S608 - our own names
        rows = connection.execute(query, (number,)).fetchall()
    of = {identity: index for index, (identity, _told) in enumerate(settings)}
    samples = [_sample(row, of) for row in rows]
    told = _head(head)
    if told is None:
        raise StoreError(f"Map {number} is damaged: its region can't be read.")
    return SkyMap(
        told.number, told.plan, told.begun, told.ended, told.source, told.unit, told.decibels, told.demo, told.about,
        tuple(clean_all(json.loads(text)) for _identity, text in settings) or ({},),
        tuple(each for each in samples if each.cell is not None),
        tuple(each for each in samples if each.cell is None),
    )  # fmt: skip


def _head(row: Sequence[Any]) -> MapHead | None:
    """Return it; None for one whose region can't be read."""
    number, key, plan, begun, ended, source, unit, decibels, demo, about, heard, low, high = row
    try:
        made = MapPlan.of(json.loads(plan))
    except ValueError:
        return None
    return MapHead(
        number, key, made, datetime.fromisoformat(begun), None if ended is None else datetime.fromisoformat(ended),
        clean(source), clean(unit), bool(decibels), bool(demo), clean_all(json.loads(about)), heard, low, high,
    )  # fmt: skip


def _sample(row: Sequence[Any], of: Mapping[int, int]) -> MapSample:
    told = dict(zip(NAMES, row, strict=True))
    texts = {name: clean(told[name]) for name in TEXTS if told[name] is not None}
    lock = None if told["lock"] is None else bool(told["lock"])
    utc = datetime.fromisoformat(told["utc"])
    return MapSample(**{**told, **texts, "utc": utc, "lock": lock, "settings": of[told["settings"]]})


class MapWriter:
    """One map, from its first direction to `close`. A thread of its own writes; each commit is on the disk."""

    def __init__(self, path: Path, new: NewMap) -> None:
        self._path, self._new = path, new
        self.problem = ""
        """Why nothing is kept any more; empty while all is well."""
        self.kept = 0
        """Directions that this writer has brought to the disk."""
        self.number: int | None = None
        """Of the map, once something of it is on disk."""
        self._settings: dict[str, int] = {}
        self._writer: BackgroundWriter[tuple[MapSample | None, str]] = BackgroundWriter("sky map", self._write)

    def add(self, sample: MapSample, settings: Mapping[str, str]) -> None:
        """Keep what was heard in a direction, with how the receiver was set; its own `settings` is not looked at."""
        if not self.problem:
            self._writer.offer((sample, json.dumps(dict(settings), sort_keys=True)))

    def end(self, utc: datetime) -> None:
        """Every direction that the dish can go to was heard."""
        if not self.problem:
            self._writer.offer((None, _stamp(utc)))

    def flush(self, timeout_s: float = CLOSE_S) -> None:
        """Wait until what was added is on the disk."""
        self._writer.flush(timeout_s)

    def close(self, timeout_s: float = CLOSE_S) -> None:
        """Write what is waiting, and end."""
        self._writer.flush(timeout_s)
        self._writer.close(timeout_s)

    def _write(self, rows: list[tuple[MapSample | None, str]], dropped: int) -> None:
        import sqlite3  # when there is something to keep: a face paints without it

        if self.problem or not rows:
            return
        try:
            with closing(open_database(self._path, MIGRATIONS)) as connection:
                connection.execute("PRAGMA synchronous = FULL")  # a power cut must not take back a direction
                connection.execute("BEGIN IMMEDIATE")
                number = self._insert(connection, rows, may_end=not dropped)
                connection.execute("COMMIT")
        except (StoreError, sqlite3.Error) as error:  # what was begun is undone as the file is closed
            code = getattr(error if isinstance(error, sqlite3.Error) else error.__cause__, "sqlite_errorcode", None)
            advice = "Free some room, then resume" if code == sqlite3.SQLITE_FULL else "Mend that, then resume"
            self.problem = f"The map can't be kept: {error}. {advice} the map."
            return
        self.number = number
        self.kept += sum(sample is not None and sample.cell is not None for sample, _told in rows)
        if dropped:
            self.problem = "The disk is too slow for the map, so it has ended. Resume it on another disk, or later."

    def _insert(
        self, connection: sqlite3.Connection, rows: list[tuple[MapSample | None, str]], *, may_end: bool
    ) -> int:  # fmt: skip
        samples = [(sample, told) for sample, told in rows if sample is not None]
        number, marks = self._begin(connection, samples[0][0] if samples else None), ", ".join("?" * (len(NAMES) + 1))
        connection.executemany(
            f"INSERT OR IGNORE INTO map_sample (map, {COLUMNS}) VALUES ({marks})",  # noqa: S608 - question marks
            [(number, *self._values(connection, number, sample, told)) for sample, told in samples],
        )
        for ended in (told for sample, told in rows if sample is None and may_end):
            connection.execute("UPDATE map SET ended = ? WHERE id = ? AND ended IS NULL", (ended, number))
        return number

    def _begin(self, connection: sqlite3.Connection, first: MapSample | None) -> int:
        """Return the number of the map, which its first direction makes."""
        new = self._new
        if first is not None:
            connection.execute(
                "INSERT OR IGNORE INTO map (key, plan, begun, source, unit, decibels, demo, about) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                (new.key, json.dumps(new.plan.values()), _stamp(first.utc), new.source, new.unit, new.decibels,
                 new.demo, json.dumps(dict(new.about))),
            )  # fmt: skip
        found = connection.execute("SELECT id FROM map WHERE key = ?", (new.key,)).fetchone()
        return 0 if found is None else int(found[0])

    def _values(self, connection: sqlite3.Connection, number: int, sample: MapSample, told: str) -> list[object]:
        if told not in self._settings:
            connection.execute("INSERT OR IGNORE INTO map_settings (map, told) VALUES (?, ?)", (number, told))
            found = connection.execute("SELECT id FROM map_settings WHERE map = ? AND told = ?", (number, told))
            self._settings[told] = int(found.fetchone()[0])
        values = {name: getattr(sample, name) for name in NAMES}
        return list({**values, "utc": _stamp(sample.utc), "settings": self._settings[told]}.values())


def heard_so_far(path: Path, key: str) -> tuple[frozenset[int], tuple[MapSample, ...]]:
    """Return which cells of a map were heard, and the points of its reference crosses in the order of time.

    Nothing where there is no file, or no such map. StoreError if it can't be read. The settings of the points are not
    looked up.
    """
    if not path.exists():
        return frozenset(), ()
    of = "FROM map_sample JOIN map ON map.id = map WHERE key = ? AND cell"
    names = COLUMNS.replace("settings", "0")
    with reading_from(path) as connection:
        cells = connection.execute(f"SELECT cell {of} IS NOT NULL", (key,)).fetchall()
        points = connection.execute(
            f"SELECT {names} {of} IS NULL ORDER BY map_sample.rowid",
            (key,),
        ).fetchall()
    return frozenset(cell for (cell,) in cells), tuple(_sample(row, {0: 0}) for row in points)


def _stamp(utc: datetime | None) -> str:
    assert utc is not None, "what is heard here has its time"
    return utc.astimezone(UTC).isoformat(timespec="milliseconds")
