"""The files of a transcript: whole lines, rotation, a limit on their total size. Runs in the writer's thread."""

from __future__ import annotations

import os
import time
from datetime import UTC, datetime
from pathlib import Path
from typing import TextIO

from birdcage.link.transcript_join import LineJoiner
from birdcage.link.transcript_line import Header, TranscriptEntry, format_line

FILE_LIMIT = 4_000_000
TOTAL_LIMIT = 40_000_000
RETRY_S = 10.0
"""How long to leave a disk alone that refused."""


class TranscriptFiles:
    """Joins chunks into lines, one a line of the dish's, and writes them."""

    def __init__(self, folder: Path, *, file_limit: int = FILE_LIMIT, total_limit: int = TOTAL_LIMIT) -> None:
        self.path: Path | None = None
        self.problem: str | None = None
        self._folder = folder
        self._file_limit = file_limit
        self._total_limit = total_limit
        self._file: TextIO | None = None
        self._written = 0
        self._header = b""
        self._joiner = LineJoiner()
        self._retry_at = 0.0
        self._lost = 0

    def write(self, items: list[TranscriptEntry], dropped: int) -> None:
        """Take what came, and how many events did not fit into the queue; with nothing, end the unfinished line."""
        lines: list[TranscriptEntry] = []
        if dropped:
            lines += self._joiner.finish()
            lines.append(TranscriptEntry(_now(), "#", b"%d events are missing here: the disk was too slow" % dropped))
        for item in items:
            lines += self._joiner.join(item)
        if not items:
            lines += self._joiner.finish()
        if lines:
            self._put(lines)

    def close(self) -> None:
        """Close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None

    def _put(self, lines: list[TranscriptEntry]) -> None:
        if time.monotonic() < self._retry_at:
            self._lost += len(lines)
            return
        try:
            for line in lines:
                self._put_line(line)
            if self._file is not None:
                self._file.flush()
        except OSError as error:
            self._give_up(error, len(lines))

    def _put_line(self, line: TranscriptEntry) -> None:
        if isinstance(line, Header):
            self._header = line.data
        if self._file is None or self._written >= self._file_limit:
            self._open_next(line.utc)
            if isinstance(line, Header):
                return
        text = format_line(line) + "\n"
        assert self._file is not None
        self._file.write(text)
        self._written += len(text)

    def _open_next(self, utc: datetime) -> None:
        self.close()
        self._folder.mkdir(parents=True, exist_ok=True)
        self._make_room()
        self.path = _free_name(self._folder, utc)
        self._file = self.path.open("x", encoding="ascii", newline="\n")
        self._written = 0
        self._put_line(TranscriptEntry(utc, "#", self._header))
        if self._lost:
            self._put_line(
                TranscriptEntry(
                    utc, "#", b"%d lines are missing here: %s" % (self._lost, (self.problem or "").encode())
                )
            )
        self._lost = 0
        self.problem = None

    def _make_room(self) -> None:
        """Delete the oldest files until a whole new one fits under the total."""
        files = sorted(self._folder.glob("wire-*.txt"), key=lambda path: path.name)
        sizes = [path.stat().st_size for path in files]
        total = sum(sizes) + self._file_limit
        for path, size in zip(files, sizes, strict=True):
            if total <= self._total_limit:
                break
            path.unlink(missing_ok=True)
            total -= size

    def _give_up(self, error: OSError, lines: int) -> None:
        self.problem = f"The transcript in {self._folder} cannot be written ({error.strerror}): make room on the disk."
        self._lost += lines
        self._retry_at = time.monotonic() + RETRY_S
        file, self._file = self._file, None
        if file is not None:
            try:
                file.close()
            except OSError:
                return  # It said so already: what was in the buffer is among the lost.


def _free_name(folder: Path, utc: datetime) -> Path:
    stem = f"wire-{utc.astimezone(UTC):%Y%m%d-%H%M%S}-{os.getpid()}"
    number = 1
    while (path := folder / f"{stem}-{number:03d}.txt").exists():
        number += 1
    return path


def _now() -> datetime:
    return datetime.now(UTC)
