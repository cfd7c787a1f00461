"""Everything that passed on the wire, kept in files that people can read and a simulator can replay."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from birdcage.base.background import BackgroundWriter
from birdcage.link.transcript_file import FILE_LIMIT, TOTAL_LIMIT, TranscriptFiles
from birdcage.link.transcript_line import Direction, Header, TranscriptEntry

QUEUE_BYTES = 4_000_000
"""What may wait for the disk, with what the program needs to keep it; the largest dump of a dish is a tenth of this."""
EVENT_BYTES = 200
"""What an event takes beside its bytes."""
QUIET_S = 0.05
"""After this long without a byte, an unfinished line is written as it is (a prompt has no line end)."""

Listener = Callable[[TranscriptEntry], None]


class Transcript:
    """Takes every event of a link at once and writes it in a thread of its own.

    `folder` is where the files go; None keeps none, and only listeners hear. One transcript serves all links that a
    program opens one after the other. When the disk is too slow, events are dropped, counted, and the number is
    written as a remark; the wire never waits.
    """

    def __init__(
        self,
        folder: Path | None,
        *,
        version: str | Callable[[], str],
        file_limit: int = FILE_LIMIT,
        total_limit: int = TOTAL_LIMIT,
        queue_bytes: int = QUEUE_BYTES,
    ) -> None:
        self._listeners: tuple[Listener, ...] = ()
        self._files: TranscriptFiles | None = None
        self._writer: BackgroundWriter[TranscriptEntry] | None = None
        self._version = version
        if folder is not None:
            self._files = TranscriptFiles(folder, file_limit=file_limit, total_limit=total_limit)
            self._writer = BackgroundWriter(
                "transcript", self._files.write, size=queue_bytes, weigh=_weight, quiet_s=QUIET_S
            )

    @property
    def path(self) -> Path | None:
        """The file being written, None before the first byte or without a folder."""
        return self._files.path if self._files is not None else None

    @property
    def problem(self) -> str | None:
        """Why nothing is being written at present (a full disk), in a sentence; None when all is well."""
        return self._files.problem if self._files is not None else None

    def begin(self, port: str, *, demo: bool, utc: datetime) -> None:
        """Announce that `port` was opened; from here on it stands in the first line of each file."""
        version = self._version if isinstance(self._version, str) else self._version()
        text = f"birdcage {version} port {port}" + (" DEMO (simulated dish)" if demo else "")
        self._take(Header(utc, "#", text.encode()))

    def record(self, direction: Direction, data: bytes, utc: datetime) -> None:
        """Take bytes that passed. Returns at once."""
        self._take(TranscriptEntry(utc, direction, data))

    def remark(self, text: str, utc: datetime) -> None:
        """Take a remark."""
        self._take(TranscriptEntry(utc, "#", text.encode()))

    def listen(self, listener: Listener) -> Callable[[], None]:
        """Call `listener` with each event; the result ends that.

        It is called on the thread that read or wrote, before the next byte can leave: append to a queue and return.
        """
        self._listeners = (*self._listeners, listener)

        def end() -> None:
            self._listeners = tuple(each for each in self._listeners if each is not listener)

        return end

    def flush(self, timeout_s: float = 2.0) -> bool:
        """Wait until complete lines are on disk; False if that took too long."""
        return self._writer.flush(timeout_s) if self._writer is not None else True

    def close(self, timeout_s: float = 2.0) -> None:
        """Write what is left, unfinished lines included, and close the file."""
        if self._writer is not None and self._files is not None and self._writer.close(timeout_s):
            self._files.close()

    def _take(self, entry: TranscriptEntry) -> None:
        if self._writer is not None:
            self._writer.offer(entry)
        for listener in self._listeners:
            listener(entry)


def _weight(entry: TranscriptEntry) -> int:
    return EVENT_BYTES + len(entry.data)
