"""Reads recordings of the signal: which there are, and one of them as CSV."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass, fields
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from birdcage.base.store import open_database
from birdcage.base.text import clean, clean_all
from birdcage.signal.recording import MIGRATIONS, RecordedReading

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


def list_recordings(path: Path) -> list[Recording]:
    """Return all of them, the newest first; none where there is no file. StoreError if it can't be read."""
    if not path.exists():
        return []
    with closing(open_database(path, MIGRATIONS)) as connection:
        rows = connection.execute(
            "SELECT id, begun, ended, source, unit, settings, demo, count(value), min(value), max(value) "
            "FROM recording LEFT JOIN reading ON reading.recording = recording.id "
            "GROUP BY recording.id ORDER BY id DESC"
        ).fetchall()
    return [
        Recording(
            number, datetime.fromisoformat(begun), None if ended is None else datetime.fromisoformat(ended),
            clean(source), clean(unit), clean_all(json.loads(settings)), bool(demo), count, low, high,
        )
        for number, begun, ended, source, unit, settings, demo, count, low, high in rows
    ]  # fmt: skip


def read_recording(path: Path, number: int) -> list[RecordedReading]:
    """Return all readings of one, the oldest first. StoreError if it can't be read."""
    query = f"SELECT {COLUMNS} FROM reading WHERE recording = ? ORDER BY rowid"  # noqa: S608 - our own names
    with closing(open_database(path, MIGRATIONS)) as connection:
        rows = connection.execute(query, (number,)).fetchall()
    return [_reading_of(dict(zip(COLUMNS.split(", "), row, strict=True))) for row in rows]


def _reading_of(told: dict[str, Any]) -> RecordedReading:
    texts = {name: clean(told[name]) for name in ("polarisation", "target", "activity") if told[name] is not None}
    lock = None if told["lock"] is None else bool(told["lock"])
    return RecordedReading(**{**told, **texts, "utc": datetime.fromisoformat(told["utc"]), "lock": lock})


def csv_lines(recording: Recording, readings: list[RecordedReading]) -> Iterator[str]:
    """Yield a recording as CSV, line by line: comments that say what it is, names of columns, a line a reading."""
    if recording.demo:
        yield f"# {DEMO}"
    yield f"# source: {recording.source}, unit: {recording.unit}"
    for name, value in recording.settings.items():
        yield f"# {name}: {value}"
    yield "# angles: true degrees; value and scatter in the unit; what was not known is empty"
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
