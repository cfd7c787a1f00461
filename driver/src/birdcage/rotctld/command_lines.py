"""Bytes of a client into lines, in bounded memory: what comes without end is cut, and the next line counts again."""

from __future__ import annotations

LONGEST = 1024
"""Bytes of a line. No command is a tenth as long; Hamlib's own daemon overruns its buffers at 128."""


class CommandLines:
    """Cuts a stream at CR and at LF: some send one, some the other, some both. Empty lines are left out.

    A line that is too long comes as None, once, as soon as that is known.
    """

    def __init__(self, longest: int = LONGEST) -> None:
        self._longest = longest
        self._begun = b""
        self._skipping = False

    def feed(self, data: bytes) -> list[bytes | None]:
        """Return the lines that `data` ends. The stream may be cut anywhere."""
        lines: list[bytes | None] = []
        *ended, rest = data.replace(b"\r", b"\n").split(b"\n")
        for piece in ended:
            self._take(piece, lines)
            if self._begun:
                lines.append(self._begun)
            self._begun, self._skipping = b"", False
        self._take(rest, lines)
        return lines

    def finish(self) -> list[bytes]:
        """Return the line that was begun, if one was: no more of it will come."""
        if not self._begun:
            return []
        line, self._begun = self._begun, b""
        return [line]

    def _take(self, piece: bytes, lines: list[bytes | None]) -> None:
        if self._skipping:
            return
        if len(self._begun) + len(piece) > self._longest:
            self._begun, self._skipping = b"", True
            lines.append(None)
        else:
            self._begun += piece
