"""Terminal control sequences (ECMA-48): colours, erased lines and character sets that some consoles print."""

from __future__ import annotations

import re

ESC = 0x1B
_LONGEST = 32
"""Bytes of one sequence; what claims to be longer is noise."""
_SEQUENCE = re.compile(rb"\x1b(\[[\x20-\x3f]{0,30}[\x40-\x7e]|[()][\x20-\x7e])")


class EscapeFilter:
    """Takes control sequences out of a stream: `ESC [ … letter` and `ESC ( letter`.

    An ESC that begins neither is let through as the noise that it is.
    """

    def __init__(self) -> None:
        self._held = b""

    def take(self, data: bytes) -> bytes:
        """Return what of the stream up to here is text, and was not returned before."""
        if not self._held and ESC not in data:
            return data
        return b"".join(self._take(byte) for byte in data)

    def _take(self, byte: int) -> bytes:
        if not self._held:
            if byte == ESC:
                self._held = b"\x1b"
                return b""
            return bytes((byte,))
        held = self._held + bytes((byte,))
        if _SEQUENCE.fullmatch(held):
            self._held = b""
            return b""
        if self._may_begin(held):
            self._held = held
            return b""
        self._held = b""
        return held[:-1] + self._take(byte)

    @staticmethod
    def _may_begin(held: bytes) -> bool:
        if held in (b"\x1b[", b"\x1b(", b"\x1b)"):
            return True
        return held.startswith(b"\x1b[") and len(held) < _LONGEST and 0x20 <= held[-1] <= 0x3F


def without_escapes(data: bytes) -> bytes:
    """Return `data` without control sequences."""
    return _SEQUENCE.sub(b"", data)
