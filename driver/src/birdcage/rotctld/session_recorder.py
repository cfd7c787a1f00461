"""Keeps what clients and server said in a file. A thread of its own writes it: no client waits for a disk."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from birdcage.base.background import BackgroundWriter
from birdcage.base.clock import Clock
from birdcage.base.errors import ConfigError
from birdcage.rotctld.session_lines import SessionDirection, SessionLine

QUEUE_BYTES = 4_000_000
"""What may wait for the disk; beyond that lines are lost, counted, and the number stands in the file."""
LINE_BYTES = 60
"""What a line takes beside its bytes."""
MOST_BYTES = 100_000_000
"""The file grows no further: a client that floods must not fill the disk."""
RETRY_S = 10.0
"""How long to leave a disk alone that refused."""


class SessionRecorder:
    """Appends to a file. Any thread may call `note`; `tell` hears each trouble once, on the writing thread."""

    def __init__(
        self, path: Path, clock: Clock, tell: Callable[[str], object], *, most_bytes: int = MOST_BYTES,
        retry_s: float = RETRY_S,
    ) -> None:  # fmt: skip
        """Open the file, or go on with it. ConfigError where it can't be written."""
        self._path, self._clock, self._tell = path, clock, tell
        self._most_bytes, self._retry_s = most_bytes, retry_s
        self._lost, self._retry_at, self._torn, self._full = 0, 0.0, False, False
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = path.open("ab", buffering=0)
            self._size = path.stat().st_size
        except OSError as error:
            raise ConfigError(f"{path} can't be written: {error.strerror or error}. Name another --record.") from error
        self._writer: BackgroundWriter[SessionLine] = BackgroundWriter(
            "session recorder", self._write, size=QUEUE_BYTES, weigh=lambda line: LINE_BYTES + len(line.data)
        )

    def note(self, client: int, direction: SessionDirection, data: bytes) -> None:
        """Take what was said; waits for nothing."""
        self._writer.offer(SessionLine(self._clock.utc(), client, direction, data))

    def remark(self, client: int, words: str) -> None:
        """Take what is to be known of a client, 0: of the server."""
        self.note(client, SessionDirection.REMARK, words.encode("ascii", "replace"))

    def close(self) -> None:
        """Write what waits, within two seconds, and close the file."""
        if self._writer.close():
            self._file.close()

    def _write(self, lines: list[SessionLine], dropped: int) -> None:
        self._lost += dropped
        if self._full or time.monotonic() < self._retry_at:
            self._lost += len(lines)
            return
        text = [str(line) for line in lines]
        if self._lost and lines:
            lost = f"{self._lost} lines are missing here: the disk was full or too slow"
            text.insert(0, str(SessionLine(lines[0].utc, 0, SessionDirection.REMARK, lost.encode())))
        if not text:
            return
        data = ("\n" if self._torn else "").encode() + "".join(f"{line}\n" for line in text).encode("ascii")
        try:
            self._put(data)
        except OSError as error:
            if not self._lost:
                self._tell(f"{self._path} can't be written: {error.strerror or error}. Serving goes on.")
            self._lost += len(lines)
            self._retry_at = time.monotonic() + self._retry_s
        else:
            self._lost = 0

    def _put(self, data: bytes) -> None:
        if self._size + len(data) > self._most_bytes:
            self._full = True
            self._tell(f"{self._path} has {self._most_bytes / 1e6:g} MB: no more is recorded. Serving goes on.")
            return
        while data:
            written = self._file.write(data)
            self._torn, self._size = not data[:written].endswith(b"\n"), self._size + written
            data = data[written:]
