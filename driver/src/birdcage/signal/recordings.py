"""Reads recordings of the signal: which there are, and one of them as CSV."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, fields
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from birdcage.base.errors import StoreError
from birdcage.base.store import open_database
from birdcage.base.text import clean, clean_all
from birdcage.signal.recording import MIGRATIONS, RecordedReading

if TYPE_CHECKING:
    import sqlite3

COLUMNS = ", ".join(each.name for each in fields(RecordedReading))
DEMO = "DEMO: a simulated dish, not a real one"


@dataclass(frozen=True, slots=True)
class Recording:
    """What holds for a whole recording."""

    number: int
    begun: datetime
    ended: datetime | None
    source: str
    unit: str
    settings: dict[str, object]
    """What source and feed were set to."""
    demo: bool
    readings: int
    low: float | None
    high: float | None
    targets: tuple[str, ...] = ()
    """What the dish followed meanwhile, or the source was read for."""


def list_recordings(path: Path) -> list[Recording]:
    """Return all of them, the newest first; none where there is no file. StoreError if it can't be read."""
    if not path.exists():
        return []
    with reading_from(path) as connection:
        rows = connection.execute(
            "SELECT id, begun, ended, source, unit, settings, demo, count(value), min(value), max(value), "
            "json_group_array(DISTINCT target) FROM recording LEFT JOIN reading ON reading.recording = recording.id "
            "GROUP BY recording.id ORDER BY id DESC"
        ).fetchall()
    return [
        Recording(
            number, datetime.fromisoformat(begun), None if ended is None else datetime.fromisoformat(ended),
            clean(source), clean(unit), clean_all(json.loads(settings)), bool(demo), count, low, high,
            tuple(clean(each) for each in json.loads(targets) if each),
        )
        for number, begun, ended, source, unit, settings, demo, count, low, high, targets in rows
    ]  # fmt: skip


def read_recording(path: Path, number: int) -> list[RecordedReading]:
    """Return all readings of one, the oldest first. StoreError if it can't be read."""
    query = f"SELECT {COLUMNS} FROM reading WHERE recording = ? ORDER BY rowid"  # noqa: S608 - our own names
    with reading_from(path) as connection:
        rows = connection.execute(query, (number,)).fetchall()
    return [reading_of(row) for row in rows]


@contextmanager
def reading_from(path: Path) -> Iterator[sqlite3.Connection]:
    """Give a connection. StoreError for whatever is wrong with the file: it is left as it is."""
    import sqlite3  # when there is something to read: a face paints without it

    with closing(open_database(path, MIGRATIONS)) as connection:
        try:
            yield connection
        except sqlite3.Error as error:
            raise StoreError(f"{path} cannot be read: {error}. It is left as it is.") from error


def reading_of(row: Sequence[Any]) -> RecordedReading:
    """Return a row of `COLUMNS` as a reading, with names of others cleaned."""
    told = dict(zip(COLUMNS.split(", "), row, strict=True))
    texts = {name: clean(told[name]) for name in ("polarisation", "target", "activity") if told[name] is not None}
    lock = None if told["lock"] is None else bool(told["lock"])
    return RecordedReading(**{**told, **texts, "utc": datetime.fromisoformat(told["utc"]), "lock": lock})


def csv_lines(recording: Recording, readings: list[RecordedReading]) -> Iterator[str]:
    """Yield a recording as CSV, line by line: comments that say what it is, names of columns, a line a reading."""
    if recording.demo:
        yield f"# {DEMO}"
    yield f"# source: {recording.source}, unit: {recording.unit}"
    yield f"# begun: {_cell(recording.begun)}, readings: {recording.readings}"
    for name, value in recording.settings.items():
        yield f"# {name}: {value}"
    yield f"# az_deg, el_deg: true degrees; value, scatter: {recording.unit}; dwell_s: seconds; snr_db: dB"
    yield "# value: the mean of n values of the source, scatter: of one of those; what was not known is empty"
    yield ",".join(each.name for each in fields(RecordedReading))
    for reading in readings:
        text = io.StringIO()
        csv.writer(text, lineterminator="").writerow(
            _cell(getattr(reading, each.name)) for each in fields(RecordedReading)
        )
        yield text.getvalue()


def _cell(value: object) -> object:
    if isinstance(value, datetime):
        return value.astimezone(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
    if isinstance(value, bool):
        return int(value)
    return "" if value is None else value
