"""The lines of a stream whose answers are not waited for any more, and how long one waits for the next.

Why no answer is taken for another's is argued in `docs/decisions/0018-a-stream-does-not-wait.md`.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.reason import Reason
from birdcage.console.damage import may_become
from birdcage.console.pace import Pace
from birdcage.console.wire import Wire

MOST_LATE = 3
"""So many lines of a stream may lack their answers; then the session finds its feet first."""
LATE = Reason.LATE
"""The reason of the NoReply that says that an answer is not waited for."""


@dataclass(frozen=True, slots=True)
class _Sent:
    ticket: int
    line: str
    sent: float
    proves: bool
    """Whether its echo can be no damaged one of the lines before it: then those are over once it is answered."""


class LateLines:
    """What a stream may still have under way, oldest first."""

    def __init__(self, wire: Wire) -> None:
        self.pace = Pace()
        self._wire = wire
        self.lines: list[_Sent] = []
        """Those that are not accounted for."""

    @property
    def owed(self) -> int:
        """How many lines may be answered yet."""
        return sum(self._wire.codec.owes(late.ticket) for late in self.lines)

    def proves(self, line: str) -> bool:
        """Return whether the echo of a line can be told from what damage makes of those that are under way."""
        return not any(may_become(late.line, line) for late in self.lines)

    def answered(self, ticket: int, line: str, sent: float, *, proves: bool) -> None:
        """Take in that a line was answered in time.

        The wire keeps the order: once it was echoed, nothing that belongs to an earlier one can follow.
        """
        self.pace.take(self._wire.clock.monotonic() - sent)
        if proves:
            self.lines.clear()
        else:
            self.lines.append(_Sent(ticket, line, sent, proves))

    def add(self, ticket: int, line: str, sent: float, *, proves: bool) -> None:
        """Wait no longer for the answer to a line."""
        self.pace.miss()
        self.lines.append(_Sent(ticket, line, sent, proves))
        self._wire.excuse(ticket)

    def collect(self) -> None:
        """Strike out what is accounted for: answered late, before something so answered, or lost for good."""
        wire = self._wire
        gone = wire.clock.monotonic() - 2 * wire.delay_s
        kept: list[_Sent] = []
        for late in self.lines:
            came = wire.taken(late.ticket) is not None
            if came and wire.last_reply is not None:
                self.pace.take(wire.last_reply - late.sent)
            if came and late.proves:
                kept.clear()
            elif late.sent > gone or wire.codec.owes(late.ticket):
                kept.append(late)
        self.lines = kept

    def end(self) -> None:
        """End the stream, giving every answer its time, within `Wire.limit`; what has not come then is missing."""
        self.collect()
        while self.owed:
            due = self.lines[-1].sent + self._wire.delay_s
            if not self._wire.pump(min(due, self._wire.limit)):
                break
            self.collect()
        self.drop()

    def drop(self) -> None:
        """End the stream at once: what still lacks its answer is missing, as any other."""
        self.collect()
        if self.lines:
            self._wire.lost = True
        for late in self.lines:
            self._wire.forget(late.ticket)
        self.lines.clear()
