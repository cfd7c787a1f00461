"""Bytes in, lines out, for machines without prompt or echo: pure, incremental, no I/O."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.console.escapes import EscapeFilter

LONGEST_LINE = 1024
"""Characters kept of one line; what follows up to its end counts as noise."""
UNREADABLE = "\N{REPLACEMENT CHARACTER}"


@dataclass(frozen=True, slots=True)
class HeardLine:
    """One line, without its end, and when its first byte came (monotonic seconds)."""

    text: str
    at: float


class LineSplitter:
    """A line ends at any run of CR and LF. Blank lines and terminal control sequences are dropped.

    How the stream was split changes nothing but the times.
    """

    def __init__(self) -> None:
        self._escapes = EscapeFilter()
        self._text = ""
        self._at = 0.0
        self.noise = 0
        """How many bytes were unreadable or beyond `LONGEST_LINE`."""

    @property
    def unfinished(self) -> str:
        """What came since the last line end."""
        return self._text.rstrip()

    def feed(self, data: bytes, at: float) -> list[HeardLine]:
        """Take in what arrived at one moment."""
        lines: list[HeardLine] = []
        for byte in self._escapes.take(data):
            if byte in b"\r\n":
                text, self._text = self._text.rstrip(), ""
                if text:
                    lines.append(HeardLine(text, self._at))
            else:
                self._take(byte, at)
        return lines

    def _take(self, byte: int, at: float) -> None:
        if not self._text:
            self._at = at
        if byte == 0x09:
            byte = 0x20
        readable = 0x20 <= byte < 0x7F
        if not readable or len(self._text) >= LONGEST_LINE:
            self.noise += 1
        if len(self._text) < LONGEST_LINE:
            self._text += chr(byte) if readable else UNREADABLE
