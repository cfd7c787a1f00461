"""The lines of a stream whose answers are not waited for any more, and how long one waits for the next.

Why no answer is taken for another's is argued in `docs/decisions/0018-a-stream-does-not-wait.md`.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.console.damage import may_become
from birdcage.console.pace import Pace
from birdcage.console.wire import Wire

MOST_LATE = 3
"""So many lines of a stream may lack their answers; then the session finds its feet first."""
LATE = "late"
"""The reason of the NoReply that says that an answer is not waited for."""


@dataclass(slots=True)
class _Late:
    ticket: int
    line: str
    sent: float
    doubtful: bool = False
    """Whether its echo, damaged, may have passed for that of a later line."""


class LateLines:
    """What a stream still has under way."""

    def __init__(self, wire: Wire) -> None:
        self.pace = Pace()
        self._wire = wire
        self._lines: list[_Late] = []

    def __len__(self) -> int:
        """Return how many lines are not accounted for."""
        return len(self._lines)

    def add(self, ticket: int, line: str, sent: float) -> None:
        """Wait no longer for the answer to a line."""
        self.pace.miss()
        self._lines.append(_Late(ticket, line, sent))
        self._wire.excuse(ticket)

    def collect(self) -> None:
        """Strike out what is accounted for.

        The wire keeps the order: once a later line was echoed, nothing that belongs to an earlier one can follow.
        """
        wire = self._wire
        for late in self._lines:
            if wire.taken(late.ticket) is not None and wire.last_reply is not None:
                self.pace.take(wire.last_reply - late.sent)
        gone = wire.clock.monotonic() - 2 * wire.delay_s
        self._lines = [
            late for late in self._lines if wire.codec.owes(late.ticket) or (late.doubtful and late.sent > gone)
        ]

    def before(self, line: str) -> None:
        """Take in that a line goes out: it proves nothing about those that its echo may be a damaged one of."""
        for late in self._lines:
            late.doubtful = late.doubtful or may_become(late.line, line)

    def end(self, limit: float | None) -> None:
        """End the stream, giving every answer its time, but none beyond `limit`; what has not come then is missing."""
        self.collect()
        while self._lines:
            due = self._lines[-1].sent + self._wire.delay_s
            if not self._wire.pump(due if limit is None else min(due, limit)):
                break
            self.collect()
        self.drop()

    def drop(self) -> None:
        """End the stream at once: what still lacks its answer is missing, as any other."""
        self.collect()
        if self._lines:
            self._wire.lost = True
        for late in self._lines:
            self._wire.forget(late.ticket)
        self._lines.clear()
