"""Writes what is in the view into a file that has the form of a transcript."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import UTC, datetime
from pathlib import Path

from birdcage.station.raw import TranscriptEntry, format_line

from birdcage_tui.console.lines import LogLine

TRIES = 100


def save(lines: Iterable[LogLine], folder: Path, now: datetime, title: str) -> Path:
    """Write the lines into a new file in `folder` and return its path; a file that is there is never touched.

    OSError when it cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    stem = f"console-{now.astimezone(UTC):%Y%m%dT%H%M%SZ}"
    for number in range(1, TRIES):
        path = folder / (f"{stem}.txt" if number == 1 else f"{stem}-{number}.txt")
        try:
            file = path.open("x", encoding="utf-8")
        except FileExistsError:
            continue
        with file:
            file.write(f"{format_line(TranscriptEntry(now, '#', title.encode()))}\n")
            file.writelines(f"{format_line(TranscriptEntry(line.utc, line.direction, line.data))}\n" for line in lines)
        return path
    raise FileExistsError(17, "there are too many files of this second", str(folder))
