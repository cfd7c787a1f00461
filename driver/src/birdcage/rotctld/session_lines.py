r"""The text form of what clients and server said: a piece of it a line, for people, for grep, and to be said again.

    2026-11-23T15:52:04.123Z 1 > p\n
    2026-11-23T15:52:04.124Z 1 < 180.00\n45.00\n
    2026-11-23T15:52:09.871Z 1 # has left

Time (UTC), number of the client, direction: `>` came from the client, `<` went to it, `#` is a remark. Client 0 is the
server itself. Printable ASCII stands for itself; a backslash is doubled; `\r`, `\n` and `\t` are those; every other
byte, and a blank at the end of a line, is `\xNN`.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import UTC, datetime
from enum import Enum


class SessionDirection(Enum):
    """Who said it."""

    CLIENT = ">"
    SERVER = "<"
    REMARK = "#"


@dataclass(frozen=True, slots=True)
class SessionLine:
    """A piece of a session. `utc` is kept to the millisecond; a remark is ASCII."""

    utc: datetime
    client: int
    direction: SessionDirection
    data: bytes

    def __str__(self) -> str:
        """Return it as a line, without its end."""
        text = self.data.decode("latin-1").encode("unicode_escape").decode("ascii")
        text = text[:-1] + r"\x20" if text.endswith(" ") else text
        stamp = self.utc.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%S")
        return f"{stamp}.{self.utc.microsecond // 1000:03d}Z {self.client} {self.direction.value} {text}"


_LINE = re.compile(r"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z) (\d+) ([<>#]) ((?:[ -\[\]-~]|\\[\\rnt]|\\x[0-9a-f]{2})*)")


def parse_session_line(line: str) -> SessionLine:
    """Return what `str` of a `SessionLine` gave, a line end allowed. ValueError for any other line."""
    found = _LINE.fullmatch(line.rstrip("\r\n"))
    if found is None:
        raise ValueError(f"This is no line of a session: {line[:60]!r}")
    stamp, client, direction, text = found.groups()
    utc = datetime.strptime(stamp, "%Y-%m-%dT%H:%M:%S.%fZ").replace(tzinfo=UTC)
    data = text.encode("ascii").decode("unicode_escape").encode("latin-1")
    return SessionLine(utc, int(client), SessionDirection(direction), data)
