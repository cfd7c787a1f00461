"""Joins the chunks of a wire into lines, for files and for screens."""

from __future__ import annotations

import re

from birdcage.link.transcript_line import Direction, TranscriptEntry

LINE_LIMIT = 200
"""Bytes after which a line is cut even though the wire shows no end of it."""


class LineJoiner:
    """Chunks arrive as the system hands them out, a few bytes each; a line that a person can read needs them joined.

    A line ends at a newline (what comes in, at a lone CR as well), where the direction changes, after 200 bytes, or
    when `finish` is called because the wire is quiet (a prompt has no line end); its time is its first byte's. The
    bytes are the same, in the same order.
    """

    def __init__(self) -> None:
        self._open_line: TranscriptEntry | None = None

    def join(self, entry: TranscriptEntry) -> list[TranscriptEntry]:
        """Take in a chunk, and return the lines that it completes."""
        if entry.direction == "#":
            return [*self.finish(), entry]
        started = self._open_line
        if started is not None and started.direction != entry.direction:
            return [*self.finish(), *self.join(entry)]
        utc = started.utc if started is not None else entry.utc
        rest = (started.data if started is not None else b"") + entry.data
        lines = []
        while (end := _line_length(rest, entry.direction)) is not None:
            lines.append(TranscriptEntry(utc, entry.direction, rest[:end]))
            rest, utc = rest[end:], entry.utc
        self._open_line = TranscriptEntry(utc, entry.direction, rest) if rest else None
        return lines

    @property
    def unfinished(self) -> bytes:
        """What has come in since the last line end; empty where something goes out."""
        line = self._open_line
        return line.data if line is not None and line.direction == "<" else b""

    def finish(self) -> list[TranscriptEntry]:
        """Return the line that has no end yet, as it is; empty when there is none."""
        line, self._open_line = self._open_line, None
        return [line] if line is not None else []


_END = {"<": re.compile(rb"\r*\n|\r+(?=[^\r\n])"), ">": re.compile(rb"\n")}
"""What goes out in one write stays one line: STOP for two axes. A CR that came last may have its LF coming."""


def _line_length(data: bytes, direction: Direction) -> int | None:
    end = _END[direction].search(data, 0, LINE_LIMIT)
    if end is not None:
        return end.end()
    return LINE_LIMIT if len(data) >= LINE_LIMIT else None
