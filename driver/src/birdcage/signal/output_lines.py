"""Cuts what a program prints into lines, however it prints: too much at once, without line ends, no text at all."""

from __future__ import annotations

from collections.abc import Iterator

from birdcage.base.text import clean

LONGEST = 8192
"""Bytes of one line: rtl_power prints some thousands. A longer one is left out whole, as half a number is a lie."""
NEWEST = 32
"""Of lines that arrive together so many count, the last ones: the others were printed long ago."""


class OutputLines:
    """For one stream."""

    def __init__(self) -> None:
        self._begun = b""
        self._is_too_long = False

    def lines(self, data: bytes) -> Iterator[str]:
        """Yield the lines that are whole with this."""
        *whole, self._begun = (self._begun + data).split(b"\n")
        if whole and self._is_too_long:
            del whole[0]
            self._is_too_long = False
        if len(self._begun) > LONGEST:
            self._begun, self._is_too_long = b"", True
        for line in whole[-NEWEST:]:
            if len(line) <= LONGEST:
                yield _text(line)

    def rest(self) -> Iterator[str]:
        """Yield the last line, which nothing ended, if there is one."""
        if self._begun and not self._is_too_long:
            yield _text(self._begun)


def _text(line: bytes) -> str:
    return clean(line.decode("utf-8", "replace"))
