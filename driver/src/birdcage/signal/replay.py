"""Reads a recording of the signal piece by piece: the whole of it in outline, and what lies around a moment."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from birdcage.base.errors import StoreError
from birdcage.signal.recording import RecordedReading
from birdcage.signal.recordings import COLUMNS, Recording, list_recordings, reading_from, reading_of

PIECES = 400
"""Of the outline: more than any screen has columns of dots for."""
MOST_READ = 6000
"""Readings around one moment: a minute at a hundred a second."""


@dataclass(frozen=True, slots=True)
class TapePiece:
    """What all readings in one part of a recording come to."""

    begins: datetime
    low: float
    high: float
    high_at: datetime
    high_az_deg: float | None
    high_el_deg: float | None
    first_row: int
    """Where its first reading lies in the file."""


@dataclass(frozen=True, slots=True)
class Tape:
    """A recording in outline."""

    recording: Recording
    begins: datetime
    ends: datetime
    pieces: tuple[TapePiece, ...]
    """In order of time; a part without readings has none."""


@dataclass(frozen=True, slots=True)
class TapeWindow:
    """All readings from `begins` to `ends`."""

    begins: datetime
    ends: datetime
    readings: tuple[RecordedReading, ...]


def open_tape(path: Path, number: int) -> Tape:
    """Read the outline of a recording. StoreError where it can't be read, or holds nothing."""
    recording = next((each for each in list_recordings(path) if each.number == number), None)
    if recording is None or not recording.readings:
        raise StoreError(f"Recording {number} holds no readings.")
    with reading_from(path) as connection:
        first, last = connection.execute(
            "SELECT min(utc), max(utc) FROM reading WHERE recording = ?", (number,)
        ).fetchone()
        begins, ends = _time(first), _time(last)
        per_day = PIECES / max((ends - begins).total_seconds(), 1e-3) * 86_400.0
        # The columns beside a lone max() are those of its row: SQLite documents that.
        rows = connection.execute(
            f"SELECT {_PIECE} AS piece, max(value), utc, az_deg, el_deg FROM reading WHERE recording = ? "  # noqa: S608 - ours
            "GROUP BY piece ORDER BY piece",
            (first, per_day, number),
        ).fetchall()
        lows = connection.execute(
            f"SELECT {_PIECE} AS piece, min(value), min(utc), min(rowid) FROM reading WHERE recording = ? "  # noqa: S608 - ours
            "GROUP BY piece ORDER BY piece",
            (first, per_day, number),
        ).fetchall()
    pieces = tuple(
        TapePiece(_time(since), low, high, _time(at), az_deg, el_deg, row)
        for (_piece, high, at, az_deg, el_deg), (_same, low, since, row) in zip(rows, lows, strict=True)
    )
    return Tape(recording, begins, ends, pieces)


_PIECE = "CAST((julianday(utc) - julianday(?)) * ? AS INTEGER)"


def read_window(path: Path, tape: Tape, begins: datetime, ends: datetime) -> TapeWindow:
    """Read what lies between two moments; where that is too much, the end comes earlier. StoreError if it can't be."""
    before = [piece.first_row for piece in tape.pieces if piece.begins <= begins]
    row = before[-1] if before else tape.pieces[0].first_row
    query = (
        f"SELECT {COLUMNS} FROM reading WHERE recording = ? AND rowid >= ? AND utc >= ? AND utc <= ? "  # noqa: S608 - our own names
        "ORDER BY rowid LIMIT ?"
    )
    asked = (tape.recording.number, row, _stamp(begins), _stamp(ends), MOST_READ + 1)
    with reading_from(path) as connection:
        rows = connection.execute(query, asked).fetchall()
    readings = tuple(reading_of(each) for each in rows[:MOST_READ])
    return TapeWindow(begins, readings[-1].utc if len(rows) > MOST_READ else ends, readings)


def _time(text: str) -> datetime:
    return datetime.fromisoformat(text).astimezone(UTC)


def _stamp(moment: datetime) -> str:
    return moment.astimezone(UTC).isoformat(timespec="milliseconds")
