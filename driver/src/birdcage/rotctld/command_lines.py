"""Bytes of a client into lines, in bounded memory: what comes without end is cut, and the next line counts again."""

from __future__ import annotations

import re
from collections.abc import Iterator

LONGEST = 1024
"""Bytes of a line. No command is a tenth as long; Hamlib's own daemon overruns its buffers at 128."""
_END = re.compile(rb"[\r\n]")


class CommandLines:
    """Cuts a stream at CR and at LF: some send one, some the other, some both. Empty lines are left out.

    A line that is too long comes as None, once, as soon as that is known.
    """

    def __init__(self) -> None:
        self._begun = bytearray()
        self._skipping = False

    def feed(self, data: bytes) -> Iterator[bytes | None]:
        """Yield the lines that `data` ends. The stream may be cut anywhere."""
        begin = 0
        for end in _END.finditer(data):
            yield from self._take(data[begin : end.start()])
            yield from self.finish()
            self._skipping, begin = False, end.end()
        yield from self._take(data[begin:])

    def finish(self) -> Iterator[bytes | None]:
        """Yield the line that was begun: no more of it will come."""
        if self._begun:
            line = bytes(self._begun)
            self._begun.clear()
            yield line

    def _take(self, piece: bytes) -> Iterator[None]:
        if self._skipping:
            return
        if len(self._begun) + len(piece) > LONGEST:
            self._begun.clear()
            self._skipping = True
            yield None
        else:
            self._begun += piece
