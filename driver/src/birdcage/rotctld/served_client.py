"""One client's socket and conversation. Nothing here waits, and all that it keeps is bounded."""

from __future__ import annotations

import socket
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from enum import StrEnum
from selectors import EVENT_READ, EVENT_WRITE

from birdcage.base.clock import Clock
from birdcage.rotctld.client_record import ClientRecord
from birdcage.rotctld.conversation import ClientConversation
from birdcage.rotctld.rotor import Rotor
from birdcage.rotctld.session_lines import SessionDirection

READ_BYTES = 512
"""Read at once: what others wait for meanwhile is never more than some hundred short commands."""
ENOUGH_UNSENT = 8192
"""Bytes that wait to go out; above that nothing more is done for a client, and soon nothing more is read."""
KEEPALIVE = {"TCP_KEEPIDLE": 15, "TCP_KEEPALIVE": 15, "TCP_KEEPINTVL": 5, "TCP_KEEPCNT": 3, "TCP_USER_TIMEOUT": 30_000}
"""A client that is gone without a word is noticed within half a minute, as far as the system has these options."""


class HangUp(StrEnum):
    """Why a client is not served any more, or never was."""

    QUIT = "quit"
    """It said so, or closed its side."""
    LOST = "lost"
    """Its connection broke."""
    SLOW = "slow"
    """It did not read what it was sent."""
    SILENT = "silent"
    """It was the longest silent one, and all places were taken when another came."""
    FULL = "full"
    """All places were taken."""
    NOT_ALLOWED = "not allowed"
    """Its address is in no allowed network."""
    UNWANTED = "unwanted"
    """A person has ended it."""
    FAULT = "fault"
    """A fault of birdcage's own."""
    CLOSING = "closing"
    """The server ends."""


@dataclass(frozen=True, slots=True)
class ClientLimits:
    """What one client may use."""

    commands_s: float = 1000.0
    """Commands a second; those beyond wait."""
    unread_s: float = 15.0
    """How long it may leave unread what it was sent."""
    answer_s: float = 5.0
    """How long an answer of the dish may take."""

    @property
    def burst(self) -> float:
        """How many commands may come at once."""
        return max(20.0, self.commands_s / 4.0)


class ServedClient:
    """Reads, answers and writes when it is told that it can. Once `why` is set it is to be closed."""

    def __init__(
        self, line: socket.socket, rotor: Rotor, record: ClientRecord, limits: ClientLimits, clock: Clock,
        on_done: Callable[[], None], note: Callable[[SessionDirection, bytes], object] | None = None,
    ) -> None:  # fmt: skip
        """`on_done` is called on any thread when the dish has answered: `resume` is due then.

        `note` gets what comes and what goes, byte for byte.
        """
        self.line, self.record = line, record
        self.why: HangUp | None = None
        self._limits, self._clock, self._on_done, self._note = limits, clock, on_done, note
        self._conversation = ClientConversation(rotor)
        self._inbox, self._unsent = b"", b""
        self._ended = self._closes = False
        self._awaited: Future[object] | None = None
        self._answer_by = self._unread_since = 0.0
        self._allowance, self._allowed_at = limits.burst, clock.monotonic()
        prepare(line)

    def fileno(self) -> int:
        """Return the socket's descriptor."""
        return self.line.fileno()

    @property
    def events(self) -> int:
        """What is waited for on the socket; 0 while the dish is awaited, or the client has used its share."""
        # What was read and can't be done yet, as its answers would not go out, stops the reading, too.
        reads = not (self._ended or self._closes or self._inbox or self._awaited or self._allowance < 1.0)
        return (EVENT_READ if reads else 0) | (EVENT_WRITE if self._unsent else 0)

    @property
    def due(self) -> float | None:
        """When `tick` has something to do, in monotonic seconds."""
        if self._awaited is None and self._allowance >= 1.0 and not self._unsent:
            return None
        moments = []
        if self._awaited is not None:
            moments.append(self._answer_by)
        elif self._allowance < 1.0:
            moments.append(self._allowed_at + (1.0 - self._allowance) / self._limits.commands_s)
        if self._unsent:
            moments.append(self._unread_since + self._limits.unread_s)
        return min(moments, default=None)

    def read(self) -> None:
        """Take in what came."""
        try:
            data = self.line.recv(READ_BYTES)
        except (BlockingIOError, InterruptedError):
            return
        except OSError:
            self.why = HangUp.LOST
            return
        if self._note is not None and data:
            self._note(SessionDirection.CLIENT, data)
        self._inbox += data
        self._ended = not data
        self._work()

    def write(self) -> None:
        """Go on sending."""
        if self._unsent:
            self._unsent = self._unsent[self._send(self._unsent) :]
        self._work()

    def resume(self) -> None:
        """Go on after an answer of the dish."""
        if self._awaited is not None and self._awaited.done():
            self._awaited = None
            self._conversation.resume()
            self._take()
            self._work()

    def tick(self) -> None:
        """Do what is due by time."""
        now = self._clock.monotonic()
        if self._awaited is not None and now >= self._answer_by:
            self._awaited = None
            self._conversation.give_up()
            self._take()
        if self._unsent and now >= self._unread_since + self._limits.unread_s:
            self.why = HangUp.SLOW
        self._work()

    def close(self) -> None:
        """Close the socket; an answer that is awaited finds nothing here any more."""
        self._awaited = None
        self.line.close()

    def _work(self) -> None:
        """Hand on what was read, a line at a time, as far as the limits let it."""
        now = self._clock.monotonic()
        limits = self._limits
        self._allowance = min(limits.burst, self._allowance + (now - self._allowed_at) * limits.commands_s)
        self._allowed_at = now
        while self._inbox and self._awaited is None and self._allowance >= 1.0 and len(self._unsent) < ENOUGH_UNSENT:
            piece, newline, self._inbox = self._inbox.partition(b"\n")
            self._hear(piece, newline)
        if self._ended and not self._inbox and self._awaited is None and not self._closes:
            self._closes = True
            self._conversation.end_of_input()
            self._take()
        if self._closes and not self._unsent and self._awaited is None:
            self.why = self.why or HangUp.QUIT

    def _hear(self, piece: bytes, newline: bytes) -> None:
        self._conversation.feed(piece + newline)
        replies = self._send_replies()
        # Noted once the answer is on its way.
        self.record.heard(piece, whole=bool(newline))
        self.record.answered(replies)

    def _take(self) -> None:
        """Send what the conversation answers, and note it."""
        self.record.answered(self._send_replies())

    def _send_replies(self) -> list[bytes]:
        """Send what the conversation answers, each reply in one piece; return it."""
        replies = self._conversation.take_replies()
        # What is not answered costs, too: blank lines, comments.
        self._allowance -= max(1, len(replies))
        for reply in replies:
            self._say(reply)
        self._closes = self._closes or self._conversation.closed
        awaited = self._conversation.waiting
        if awaited is not None and awaited is not self._awaited:
            self._awaited = awaited
            self._answer_by = self._clock.monotonic() + self._limits.answer_s
            awaited.add_done_callback(lambda _future: self._on_done())
        return replies

    def _say(self, reply: bytes) -> None:
        if self._note is not None:
            self._note(SessionDirection.SERVER, reply)
        if self._unsent:
            self._unsent += reply
        else:
            self._unsent = reply[self._send(reply) :]

    def _send(self, data: bytes) -> int:
        """Send what the socket takes; return how much that is."""
        try:
            sent = self.line.send(data)
        except (BlockingIOError, InterruptedError):
            sent = 0
        except OSError:
            self.why = HangUp.LOST
            return len(data)
        if sent < len(data) and (sent or not self._unsent):
            self._unread_since = self._clock.monotonic()
        return sent


def prepare(line: socket.socket) -> None:
    """Set a client's socket up: it never blocks, sends at once, and notices a peer that is gone."""
    line.setblocking(False)
    line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    line.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
    for name, value in KEEPALIVE.items():
        option = getattr(socket, name, None)
        if option is not None:
            line.setsockopt(socket.IPPROTO_TCP, option, value)
