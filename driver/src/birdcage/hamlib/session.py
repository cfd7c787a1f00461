"""A conversation with a rotctld: each command has one reply, and replies come in the order of the commands.

TCP loses nothing and keeps the order, so what is still due tells whose a line is, however late it comes. What a server
never answers is told by the reply to the command after it.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import TypeVar

from birdcage.base.clock import Clock
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.console.line_session import LineDialect, LineSession, Listener
from birdcage.console.line_splitter import HeardLine
from birdcage.hamlib.replies import CODE, Heard, ServerReply, reason_of, words_of
from birdcage.link.port import Port
from birdcage.rotator.hooks import Hooks

AnyReply = TypeVar("AnyReply", bound=ServerReply)

WIRE = LineDialect(b"\n", refusals=((CODE, Reason.FAILED),))


class RotctldSession(LineSession):
    """Any thread may `post`; one thread does all else."""

    def __init__(self, link: Port, clock: Clock, hooks: Hooks, on_line: Listener) -> None:
        super().__init__(
            link, clock, WIRE, delay_s=hooks.delay_s, wake=hooks.wake, on_wake=hooks.on_wake, on_line=on_line
        )
        self._due = deque[ServerReply]()

    @property
    def oldest_due(self) -> float | None:
        """When the oldest command went out whose reply is still to come; None where none is."""
        due = self._due
        return due[0].sent_at if due else None

    def post(self, reply: AnyReply, permit: Callable[[], None] | None = None) -> AnyReply:
        """Write the command of a reply at once, in a write of its own; return the reply, which is then due.

        `permit` as for `send`.
        """
        data = self._written([reply.command])
        with self._lock:
            if permit is not None:
                permit()
            reply.sent_at = self.clock.monotonic()
            self._due.append(reply)  # before its bytes are out: what answers them may be heard at once
            try:
                self.link.write(data)
            except BaseException:
                self._due.remove(reply)
                raise
        return reply

    def exchange(
        self,
        reply: AnyReply,
        *,
        within_s: float | None = None,
        quiet_s: float | None = None,
        permit: Callable[[], None] | None = None,
    ) -> AnyReply:
        """Send a command and wait for its reply, by default for as long as one may be on its way.

        `quiet_s`: after so long without another line, what has come is all there is. CommandRefused for an error;
        NoReply when it did not come in time: it stays due.
        """
        self.take_in()
        self._seen.clear()
        self.post(reply, permit)
        waited_s = self.delay_s if within_s is None else within_s
        self.await_reply(reply, reply.sent_at + waited_s, quiet_s)
        if reply.is_refused:
            assert reply.code is not None
            raise CommandRefused(
                f"The server answered `{reply.command}` with {words_of(reply.code)}.", reason=reason_of(reply.code)
            )
        if reply.skipped:
            raise NoReply(
                f"The server on {self.link.name} left `{reply.command}` unanswered, and answered the next command.",
                reason=Reason.BLOCKED,
            )
        if not reply.done:
            raise self._no_answer(reply.command, waited_s)
        return reply

    def await_reply(self, reply: ServerReply, until: float, quiet_s: float | None = None) -> bool:
        """Listen until a reply is over, or until a monotonic time; return whether it is."""
        while not reply.is_over:
            ends = until
            if quiet_s is not None and reply.lines:
                ends = min(until, self.last_received + quiet_s)
            if not self._pump(ends):
                if ends < until or (quiet_s is not None and reply.lines):
                    reply.done = True
                    self._due.remove(reply)
                break
        return reply.is_over

    def _hear(self, line: HeardLine) -> None:
        while self._due:
            reply = self._due[0]
            heard = reply.hear(line.text)
            if heard is Heard.STRAY or (heard is Heard.OTHERS and (len(self._due) == 1 or self.on_any is not None)):
                break  # while a person types, a line that none of ours awaits answers that
            if heard is Heard.OTHERS:
                reply.skipped = True
                self._due.popleft()
                continue
            reply.at = line.at
            if heard is Heard.END:
                self._due.popleft()
            return
        super()._hear(line)
