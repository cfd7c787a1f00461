r"""The text form of a transcript: one event a line, for people, for grep, and to play back.

    2026-03-20T12:00:00.123Z > a 0 180\r
    2026-03-20T12:00:00.161Z < Angle = 180.00\r\n
    2026-03-20T12:00:01.000Z # lost /dev/ttyUSB0

`>` went to the dish, `<` came from it, `#` is a remark. Printable ASCII stands for itself; a backslash is doubled;
`\r`, `\n` and `\t` are those; every other byte, and a space at the end of a line, is `\xNN`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Literal, cast

Direction = Literal[">", "<", "#"]

_ESCAPED = {byte: f"\\x{byte:02x}" for byte in range(256) if not 0x20 <= byte < 0x7F}
_ESCAPED |= {0x0D: r"\r", 0x0A: r"\n", 0x09: r"\t", 0x5C: r"\\"}
_PLAIN = {"r": b"\r", "n": b"\n", "t": b"\t", "\\": b"\\"}
_PIECE = re.compile(r"\\(?:x([0-9a-f]{2})|([rnt\\]))|([\x20-\x5b\x5d-\x7e]+)")
_LINE = re.compile(r"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z) ([<>#]) (.*)")


@dataclass(frozen=True, slots=True)
class TranscriptEntry:
    """One event: when (UTC, kept to the millisecond), which way, and the bytes (a remark's are UTF-8)."""

    utc: datetime
    direction: Direction
    data: bytes

    @property
    def text(self) -> str:
        """The bytes with everything unprintable escaped."""
        return escape(self.data)


class Header(TranscriptEntry):
    """A remark that says what follows: it stands in the first line of each file until there is another."""

    __slots__ = ()


def printable(data: bytes) -> str:
    """Return `data` as printable ASCII, for people: a space at the end stays one."""
    return "".join(_ESCAPED.get(byte) or chr(byte) for byte in data)


def escape(data: bytes) -> str:
    r"""Return `data` as printable ASCII; `unescape` gives it back exactly."""
    text = printable(data)
    return text[:-1] + r"\x20" if text.endswith(" ") else text


def unescape(text: str) -> bytes:
    """Return the bytes that `escape` turned into `text`; ValueError for anything else."""
    data = bytearray()
    position = 0
    while position < len(text):
        piece = _PIECE.match(text, position)
        if piece is None:
            raise ValueError(f"no transcript escapes like {text[position : position + 4]!r}")
        number, letter, plain = piece.groups()
        data += bytes.fromhex(number) if number else _PLAIN[letter] if letter else plain.encode("ascii")
        position = piece.end()
    return bytes(data)


def format_line(entry: TranscriptEntry) -> str:
    """Return the line of `entry`, without a line end."""
    stamp = entry.utc.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%S")
    return f"{stamp}.{entry.utc.microsecond // 1000:03d}Z {entry.direction} {entry.text}"


def parse_line(line: str) -> TranscriptEntry:
    """Return what `format_line` wrote, a line end allowed; ValueError names what is wrong."""
    found = _LINE.fullmatch(line.rstrip("\r\n"))
    if found is None:
        raise ValueError(f"no transcript line: {line[:60]!r}")
    stamp, direction, text = found.groups()
    utc = datetime.strptime(stamp, "%Y-%m-%dT%H:%M:%S.%fZ").replace(tzinfo=UTC)
    return TranscriptEntry(utc, cast(Direction, direction), unescape(text))
