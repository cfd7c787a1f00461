"""What is known of one client, and what was said: kept cheaply, and made into a value when somebody looks."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from itertools import islice

from birdcage.base.clock import Clock
from birdcage.base.text import clean
from birdcage.rotctld.client_view import ClientView
from birdcage.rotctld.program_guess import ProgramGuess
from birdcage.station.network_state import NetworkClient, NetworkLine, NetworkRole

KEPT_LINES = 50
LONGEST_SHOWN = 120
"""Bytes of a command or a reply that are kept to be shown."""


@dataclass(slots=True)
class _Said:
    """A line of the client, and what it was answered, as they went over the wire."""

    utc: datetime
    command: bytes
    reply: bytes = b""
    _line: NetworkLine | None = None

    def add(self, reply: bytes) -> None:
        """Note a reply to it."""
        self.reply, self._line = (self.reply + reply)[:LONGEST_SHOWN], None

    def line(self) -> NetworkLine:
        """Return it as faces see it."""
        if self._line is None:
            self._line = NetworkLine(self.utc, _words(self.command), _words(self.reply))
        return self._line


class ClientRecord:
    """Kept by whoever serves the client."""

    def __init__(self, number: int, name: str, address: str, clock: Clock) -> None:
        self.number, self.name, self.address = number, name, address
        self.since = clock.utc()
        self.last_at = clock.monotonic()
        """When it was last heard, in monotonic seconds."""
        self._clock = clock
        self._guess = ProgramGuess()
        self._said: deque[_Said] = deque(maxlen=KEPT_LINES)
        self._half = b""
        self._commands = self._errors = 0

    def heard(self, piece: bytes, *, whole: bool) -> None:
        """Note what came: a line, or a part of one."""
        self.last_at = self._clock.monotonic()
        self._half = (self._half + piece)[:LONGEST_SHOWN]
        if whole:
            line, self._half = self._half.strip(), b""
            if line:
                self._said.append(_Said(self._clock.utc(), line))
                self._guess.hear(line.decode("ascii", "replace"), self.last_at)

    def answered(self, replies: Sequence[bytes]) -> None:
        """Note what the last line was answered."""
        for reply in replies:
            self._commands += 1
            self._errors += b"RPRT -" in reply
            if self._said:
                self._said[-1].add(reply)

    def view(self, wishes: ClientView | None = None, most_lines: int = KEPT_LINES) -> NetworkClient:
        """Return the client as faces see it, with what became of its `wishes`, and the last lines."""
        lines = tuple(each.line() for each in islice(self._said, max(0, len(self._said) - most_lines), None))
        last = lines[-1] if lines else None
        seen = NetworkClient(
            self.number, self.name, self._guess.program, self.address, self.since,
            last_command=last.command if last else "", last_utc=last.utc if last else None,
            commands=self._commands, errors=self._errors, lines=lines,
        )  # fmt: skip
        if wishes is None:
            return seen
        wish, following = wishes.wish, wishes.following
        return replace(
            seen, role=NetworkRole(wishes.role), ignored=wishes.ignored, why=wishes.why, waits=wishes.waits,
            stale=wishes.stale, lead_s=wishes.lead_s, shut_out=wishes.shut_out,
            wants_az_deg=wish.az_deg if wish else None, wants_el_deg=wish.el_deg if wish else None,
            follows=following.name if following else "",
            follow_error_deg=following.error_deg if following else None,
            steps_error_deg=following.steps_deg if following else None,
        )  # fmt: skip


def _words(said: bytes) -> str:
    return clean(said.decode("utf-8", "replace")).strip()
