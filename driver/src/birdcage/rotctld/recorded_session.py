"""Sessions out of recordings, to be said again: what a client sends, and what it must be answered.

The recordings of the clients that people use lie in `recordings/`, in the form of `session_lines`. The first lines of
each say what it is made from.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files

from birdcage.rotctld.session_lines import SessionDirection, SessionLine, parse_session_line

NAMES = ("hamlib", "gpredict", "satnogs", "satdump", "sdrangel", "look4sat")
_DECIMAL = re.compile(rb"-?\d+\.\d+")
_NAME_ASKED = re.compile(rb"\+?(?:_|\\get_info)\s*")


@dataclass(frozen=True, slots=True)
class Exchange:
    """What a client sent before it was answered, and the answer."""

    sent: bytes
    answer: bytes

    @property
    def lines(self) -> int:
        """How many lines the answer has."""
        return self.answer.count(b"\n")

    def fits(self, came: bytes) -> bool:
        """Return whether `came` answers it as well: the same lines, but for decimals and the dish's name."""
        if _NAME_ASKED.fullmatch(self.sent) and not came.startswith(b"RPRT"):
            return came.count(b"\n") == self.lines
        return _DECIMAL.sub(b"0.0", came) == _DECIMAL.sub(b"0.0", self.answer)


def packaged_sessions(name: str) -> Iterator[tuple[Exchange, ...]]:
    """Yield the sessions of a program in `NAMES`, one for each time that it connected."""
    return sessions_in((files("birdcage.rotctld") / "recordings" / f"{name}.txt").read_text(encoding="ascii"))


def sessions_in(text: str) -> Iterator[tuple[Exchange, ...]]:
    """Yield the exchanges of each client of a recording. ValueError names a line that is none of a session."""
    lines = [parse_session_line(line) for line in text.splitlines() if line]
    said = [line for line in lines if line.direction is not SessionDirection.REMARK]
    for client in dict.fromkeys(line.client for line in said):
        yield tuple(_exchanges([line for line in said if line.client == client]))


def _exchanges(said: list[SessionLine]) -> Iterator[Exchange]:
    sent = answer = b""
    for line in said:
        if line.direction is SessionDirection.SERVER:
            answer += line.data
            continue
        if answer:
            yield Exchange(sent, answer)
            sent = answer = b""
        sent += line.data
    if sent or answer:
        yield Exchange(sent, answer)
