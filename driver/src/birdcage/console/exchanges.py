"""One line out, its reply in: deadlines, answers that come late, and how the line falls quiet."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.base.errors import NoReply
from birdcage.console.diagnosis import fell_silent, no_reply, stranger
from birdcage.console.events import LineSink, Reply
from birdcage.console.late import LATE, LateLines
from birdcage.console.wire import Wire

LATE_S = 0.3
"""A dish that is free answers a short line sooner than this: an older one may be read much later, or was lost."""
MARK_S = 0.5
"""How much longer than a usual answer that of a mark is waited for: without it the line must fall quiet."""
_MOST_MARKS_LOST = 2
"""A console that does not echo blanks is not asked again."""


class Exchanges:
    """Sends lines, and waits for what answers them. The owner's thread only.

    All that waits raises `LinkError` when the port is gone and `NoReply` when the dish does not answer.
    """

    def __init__(self, wire: Wire) -> None:
        self._wire, self._clock, self._delay_s = wire, wire.clock, wire.delay_s
        self.late = LateLines(wire)
        self._marks_lost = 0
        self.round_trip_s: float | None = None
        """How long the last short command took, from its first byte out to its prompt."""
        self.took_s = 0.0
        """How long the last line that was answered took, from its first byte out to its prompt."""
        self.answered = 0
        """How many lines in a row, up to the last one, were answered in time."""
        self.asked = self.unanswered = self.late_answers = 0
        """How many lines were waited for, how many of them in vain, and how many longer than a stream of them can."""
        self.on_busy: Callable[[], None] = lambda: None
        """Told, once a line, that the dish is still busy with what came before it."""

    @property
    def is_settled(self) -> bool:
        """Whether all that was sent is accounted for and nothing came unasked since the last proof."""
        wire = self._wire
        return not wire.lost and wire.doubt_until is None and not wire.owed and wire.menu is not None

    def collect(self) -> None:
        """Take in what came, and give answers to earlier lines their time."""
        self._wire.take_in()
        if self.late.lines:
            self.late.end()

    def ask(
        self,
        line: str,
        takes_s: float = 0.0,
        on_line: LineSink | None = None,
        permit: Callable[[], None] | None = None,
        busy_s: float = 0.0,
        *,
        wakes: bool = False,
    ) -> Reply:
        """Send one line and return its reply; due within `busy_s` + `takes_s` + the delay.

        `wakes`: Enter is pressed once more where no byte comes. See `Console.run` for the rest.
        """
        self._wire.await_turn()
        sent = self._clock.monotonic()
        ticket = self._wire.send(line, takes_s + busy_s, permit)
        reply = self.wait_for(line, ticket, takes_s + self._delay_s, on_line, busy_s, wakes=wakes)
        self.took_s = self._clock.monotonic() - sent
        if not takes_s and not busy_s:
            self.round_trip_s = self.took_s
        return reply

    def ask_soon(self, line: str, permit: Callable[[], None] | None) -> Reply:
        """Send one line of a stream; NoReply (`late`) when its reply does not come as soon as the others did."""
        wire, clock, late = self._wire, self._clock, self.late
        proves = late.proves(line)
        patience_s = late.pace.patience_s(self.round_trip_s or self._delay_s, self._delay_s)
        wire.await_turn()
        sent = clock.monotonic()
        ticket = wire.send(line, 0.0, permit)
        try:
            while (reply := wire.taken(ticket)) is None and wire.pump(sent + patience_s, ticket):
                pass
        except BaseException:
            wire.forget(ticket)
            late.drop()
            raise
        if reply is None:
            self.answered, self.asked, self.late_answers = 0, self.asked + 1, self.late_answers + 1
            late.add(ticket, line, sent, proves=proves)
            raise NoReply(f"No answer to `{line}` on {wire.link.name} within {patience_s:.2f} s.", reason=LATE)
        self.round_trip_s = self.took_s = clock.monotonic() - sent
        self._count(reply)
        late.answered(ticket, line, sent, proves=proves)
        return reply

    def wait_for(
        self, line: str, ticket: int, timeout_s: float, on_line: LineSink | None, busy_s: float = 0.0, *,
        wakes: bool = False,
    ) -> Reply:  # fmt: skip
        """Return the reply to a line that is out, due within `busy_s` + `timeout_s`. NoReply says what came instead."""
        wire, timeout_s = self._wire, timeout_s + busy_s
        deadline = min(self._clock.monotonic() + timeout_s, wire.limit)
        try:
            soon = min(deadline, self._clock.monotonic() + timeout_s / 2)
            if wakes and not self._is_answered_by(soon, ticket, on_line) and not wire.seen:
                wire.press_enter()  # a dish that sleeps (NVS 38) may lose the line that wakes it
            if busy_s and not self._is_answered_by(min(deadline, self._clock.monotonic() + LATE_S), ticket, on_line):
                self.on_busy()
            while (reply := wire.taken(ticket)) is None and wire.pump(deadline, ticket, on_line):
                pass
            if reply is None:
                wire.idle(ticket, on_line)
                reply = wire.taken(ticket)
        except BaseException:
            wire.forget(ticket)
            raise
        self._count(reply)
        if reply is None:
            strange = None if wire.token else stranger(wire.dialect, wire.codec.unfinished)
            wire.forget(ticket)
            if strange is not None:
                raise strange
            raise no_reply(wire.link.name, line, bytes(wire.seen), timeout_s, busy=busy_s > 0.0)
        return reply

    def relay(self, line: str, on_line: LineSink, quiet_s: float, permit: Callable[[], None] | None) -> Reply:
        """Send one line and return its reply, however long that prints. See `Console.relay`."""
        wire, clock = self._wire, self._clock
        wire.await_turn()
        sent = heard_at = clock.monotonic()
        ticket, lines = wire.send(line, quiet_s, permit), 0

        def hear(text: str) -> None:
            nonlocal lines, heard_at
            lines, heard_at = lines + 1, clock.monotonic()
            on_line(text)

        try:
            while (reply := wire.taken(ticket)) is None:
                if not wire.pump(heard_at + quiet_s + self._delay_s, ticket, hear):
                    wire.idle(ticket, hear)
                    reply = wire.taken(ticket)
                    break
        except BaseException:
            wire.forget(ticket)
            raise
        self._count(reply)
        if reply is None:
            wire.forget(ticket)
            if lines:
                raise fell_silent(wire.link.name, line, lines, clock.monotonic() - heard_at)
            raise no_reply(wire.link.name, line, bytes(wire.seen), clock.monotonic() - sent)
        self.took_s = clock.monotonic() - sent
        return reply

    def _count(self, reply: Reply | None) -> None:
        """Take in that a line was answered, or was given up."""
        self.asked += 1
        self.answered = 0 if reply is None else self.answered + 1
        self.unanswered += reply is None

    def _is_answered_by(self, until: float, ticket: int, on_line: LineSink | None) -> bool:
        while self._wire.codec.owes(ticket):
            if not self._wire.pump(until, ticket, on_line):
                return False
        return True

    def fall_quiet(self, *, strictly: bool) -> bool:
        """Wait until all that was sent has had its time, both ways, and D passed without a byte.

        Not `strictly`, a prompt that came late counts as the end of what kept the dish busy. False when it never
        fell quiet.
        """
        wire, delay = self._wire, self._delay_s
        give_up = min(max(wire.quiet_at(strictly=strictly), self._clock.monotonic()) + 4 * delay, wire.limit)
        while True:
            goal = wire.quiet_at(strictly=strictly)
            now = self._clock.monotonic()
            if now >= goal:
                wire.forget_all()
                return True
            if now >= give_up:
                return False
            wire.pump(min(goal, give_up))

    def account_by_mark(self) -> bool:
        """Have all that is under way accounted for at once, by a mark; return whether that went well (decision 0026).

        Nothing is sent where a command still has its time: a byte could end it.
        """
        wire, dialect = self._wire, self._wire.dialect
        if not dialect.echo or self._marks_lost >= _MOST_MARKS_LOST or self._clock.monotonic() < wire.busy_until:
            return False
        if dialect.learnt and not wire.codec.knows_prompts:
            return False
        ticket = wire.send_mark()
        try:
            self.wait_for("", ticket, min(self._delay_s, MARK_S + 2 * (self.round_trip_s or 0.0)), None)
        except NoReply:
            self._marks_lost += 1
            return False
        self._marks_lost = 0
        return wire.doubt_until is None
