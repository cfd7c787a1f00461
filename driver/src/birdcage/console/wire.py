"""The line between a session and its dish: what was sent, what is owed, how far the stream can be trusted.

Only the owner's thread reads; `interject` may come from any thread. One lock keeps the order of what was written the
order of what is owed.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

from birdcage.base.clock import Clock, WaitOutcome
from birdcage.base.errors import NoReply
from birdcage.base.wake import Wake
from birdcage.console.codec import MARK, Codec
from birdcage.console.diagnosis import KEPT
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.events import Event, LineSink, Reply, ReplyLine, Stray, StrayPrompt
from birdcage.link.opening import keeps_order
from birdcage.link.port import Port


class Wire:
    """Sends lines, takes in bytes, and keeps the books. `delay_s` is the longest that a byte may be under way."""

    def __init__(
        self,
        link: Port,
        clock: Clock,
        dialect: ConsoleDialect,
        delay_s: float,
        wake: Wake | None,
        on_wake: Callable[[], None] | None,
        on_line: LineSink | None,
        on_prompt: Callable[[], None] | None,
    ) -> None:
        self.link = link
        self.clock = clock
        self.dialect = dialect
        self.delay_s = delay_s
        self._wake = wake if on_wake is not None else None
        self._on_wake = on_wake
        self._on_line, self._on_prompt = on_line, on_prompt
        # Reentrant, as a signal handler may interject on top of the thread that it interrupted.
        self._lock = threading.RLock()
        self.codec = Codec(dialect)
        """What reads the stream; for looking at, and for `learn`."""
        self._replies: dict[int, Reply] = {}
        self._sent_at: dict[int, float] = {}
        self._interjected: list[int] = []
        self.menu: str | None = None
        """Where learnt prompts name no menu, this is what the session has proven, until something makes it doubtful."""
        self.token = ""
        """The prompt that last answered."""
        self.lost = True
        """Whether a reply is missing, so that the next exchange first has to find its feet again."""
        self.last_reply: float | None = None
        self.last_received = clock.monotonic()
        self.last_sent = clock.monotonic()
        self._turn_at = self.last_sent + dialect.gap_s
        """When the next line may go out. Another program may have sent one just before."""
        self.limit = math.inf
        """Beyond this nothing is waited for, and nothing sent, in monotonic seconds; infinite: no limit."""
        self.busy_until = clock.monotonic()
        self.doubt_until: float | None = clock.monotonic() + 2 * delay_s
        """Until when something unaccounted for may still be under way, either way; None when nothing is."""
        self._hazard_doubt: float | None = None
        self._inside = False
        """Whether a prompt named a menu below the root, and nothing went out since that could leave it."""
        self._back: str | None = None
        self.on_back: Callable[[str], None] = lambda _menu: None
        """Told of a prompt of the root, or of a menu that nothing leaves, where nothing was sent that leads there."""
        self._beginning = None if keeps_order(link.name) else self.doubt_until
        """The doubt of a new session, where bytes of an earlier one may come after ours; else None."""
        self._mark: int | None = None
        """The ticket of the mark under way, until anything is written after it."""
        self.stray_bytes = 0
        self.seen = bytearray()
        """What arrived since the last line was sent, up to `KEPT` bytes."""
        self.on_bytes: Callable[[bytes], None] = lambda _data: None
        """Hears all that arrives, as it comes, on the owner's thread: for what begins and ends with no line."""

    @property
    def owed(self) -> int:
        """How many lines still lack their prompt."""
        return self.codec.owed

    def learn(self, token: str) -> None:
        """Know a prompt token from now on."""
        with self._lock:
            self._note(self.codec.learn(token))

    def await_turn(self) -> None:
        """Wait until the dish can be expected to hear another line (`ConsoleDialect.gap_s`), taking in what comes.

        NoReply at once where that is not before `limit`.
        """
        if max(self.clock.monotonic(), self._turn_at) >= self.limit:
            raise NoReply("There was no time left for another line. Nothing more was sent.")
        while self.clock.monotonic() < self._turn_at:
            self.pump(self._turn_at)

    def _took_turn(self, line: str) -> None:
        self._turn_at = self.last_sent + self.dialect.gap_after(line, self.menu)

    @contextmanager
    def _in_turn(self) -> Iterator[None]:
        """Hold the lock once it is time for another line: STOP may have written one while that was waited for."""
        while True:
            self.await_turn()
            with self._lock:
                if self.clock.monotonic() >= self._turn_at:
                    yield
                    return

    def send(self, line: str, takes_s: float = 0.0, permit: Callable[[], None] | None = None) -> int:
        """Write one line at once and return the ticket of its reply.

        `permit` is asked under the lock that `interject` takes too: what it lets through is on the wire before any
        line that is interjected afterwards.
        """
        with self._in_turn():
            if permit is not None:
                permit()
            now = self.clock.monotonic()
            self.seen.clear()
            if self.dialect.leaving.search(line):
                self.doubt(now + takes_s + 2 * self.delay_s)
                self._hazard_doubt = self.doubt_until
                self._inside = False
            return self._write([line], now, takes_s)[0]

    def send_mark(self) -> int:
        """Write the mark, and return its ticket: its reply ends every doubt of what was sent before it."""
        with self._in_turn():
            now = self.clock.monotonic()
            self.seen.clear()
            ticket = self._mark = self.codec.expect_mark()
            self._sent_at[ticket] = self.last_sent = now
            self._took_turn(MARK)
            self.busy_until = max(self.busy_until, now)
            try:
                self.link.write(MARK.encode("ascii") + self.dialect.line_end)
            except BaseException:
                self.forget(ticket)
                raise
            return ticket

    def interject(self, lines: Sequence[str]) -> None:
        """Write `lines` in one piece from any thread; the owner collects their replies."""
        with self._lock:
            now = self.clock.monotonic()
            self.doubt(now + 2 * self.delay_s)
            self._interjected += self._write(lines, now, 0.0)

    def press_enter(self) -> None:
        """Write a bare line end that no reply is expected to: the key that ends a running stream."""
        with self._in_turn():
            self.last_sent = self.busy_until = self.clock.monotonic()
            self._took_turn("")
            self.doubt(self.last_sent + 2 * self.delay_s)
            self._mark = None
            self.link.write(self.dialect.line_end)

    def trust_left(self, before: float | None) -> None:
        """Take back the doubt that a `q` brought, once the menu that it leads to has shown; any other doubt stays."""
        with self._lock:
            if self.doubt_until == self._hazard_doubt:
                self.doubt_until = before

    def lasts_s(self, lines: Sequence[str], round_trip_s: float) -> float:
        """Return how long such lines take, one after the other, the wait before the first one included."""
        waits_s = max(self._turn_at - self.clock.monotonic(), 0.0)
        for line in lines:
            waits_s += max(self.dialect.gap_after(line, self.menu), round_trip_s)
        return waits_s

    def quiet_at(self, *, strictly: bool) -> float:
        """Return when, should nothing come until then, all that was sent has been heard or is lost for good."""
        delay = self.delay_s
        through = max(self.last_sent + 2 * delay, self.last_received + delay)
        if strictly:
            return max(through, self.doubt_until or through)
        return max(through, self.busy_until + 2 * delay)

    def _write(self, lines: Sequence[str], now: float, takes_s: float) -> list[int]:
        tickets = [self.codec.expect(line) for line in lines]
        self._sent_at.update(dict.fromkeys(tickets, now))
        self.last_sent = now
        self.busy_until = max(self.busy_until, now + takes_s)
        self._took_turn(lines[-1] if lines else "")
        self._mark, end = None, self.dialect.line_end
        try:
            self.link.write(b"".join(line.encode("ascii") + end for line in lines))
        except BaseException:
            for ticket in tickets:
                self.forget(ticket)
            raise
        return tickets

    def taken(self, ticket: int) -> Reply | None:
        """Return the reply to `ticket` once, when it is there."""
        return self._replies.pop(ticket, None)

    def interjected(self) -> tuple[bool, tuple[Reply, ...]]:
        """Return whether interjected lines still wait for their prompts, and the replies that came."""
        with self._lock:
            waiting = any(self.codec.owes(ticket) for ticket in self._interjected)
            came = tuple(self._replies[ticket] for ticket in self._interjected if ticket in self._replies)
            return waiting, came

    def close_interjected(self) -> int:
        """Wait no longer for interjected lines; return how many there were."""
        with self._lock:
            tickets, self._interjected = self._interjected, []
            for ticket in tickets:
                self._replies.pop(ticket, None)
                self.forget(ticket)
            return len(tickets)

    def unanswered_s(self) -> float:
        """Return the age of the oldest line that lacks its prompt; infinite where a reply is missing. Any thread."""
        with self._lock:
            if self.lost:
                return math.inf
            sent = [at for ticket, at in self._sent_at.items() if self.codec.owes(ticket)]
            return self.clock.monotonic() - min(sent) if sent else 0.0

    def excuse(self, ticket: int) -> None:
        """Wait no longer for a reply that may come yet, or be taken for lost once a later line is echoed."""
        with self._lock:
            self.codec.excuse(ticket)
            self.doubt(self.last_sent + 2 * self.delay_s)

    def forget(self, ticket: int) -> None:
        """Give up on a reply: the stream is in doubt for as long as it, or its cause, may be under way."""
        with self._lock:
            if not self.codec.owes(ticket):
                return
            self.codec.forget(ticket)
            self._sent_at.pop(ticket, None)
            self.lost = True
            self.doubt(max(self.busy_until, self.last_sent) + 2 * self.delay_s)

    def forget_all(self) -> None:
        """Give up on every reply, when all that was sent has had its time."""
        with self._lock:
            self.codec.forget_all()
            self._sent_at.clear()

    def doubt(self, until: float) -> None:
        """Trust the stream no sooner than `until`."""
        self.doubt_until = max(until, self.doubt_until or until)

    def pump(self, until: float, ticket: int = 0, on_line: LineSink | None = None) -> bool:
        """Wait for bytes and take them in; lines of `ticket` go to `on_line`. False when `until` came first."""
        outcome = self.clock.wait(self.link, until, self._wake)
        if outcome is WaitOutcome.INTERRUPTED and self._on_wake is not None:
            self._on_wake()
        elif outcome is WaitOutcome.TIMEOUT:
            return False
        self.take_in(ticket, on_line)
        return True

    def take_in(self, ticket: int = 0, on_line: LineSink | None = None) -> None:
        """Read what is there, without waiting."""
        data = self.link.read()
        if not data:
            return
        with self._lock:
            self.last_received = self.clock.monotonic()
            self.seen += data[: max(0, KEPT - len(self.seen))]
            noise = self.codec.noise
            events = self.codec.feed(data)
            if self.codec.noise > noise:
                self.stray_bytes += self.codec.noise - noise
                self.doubt(self.last_received + 2 * self.delay_s)
            self._note(events)
        self.on_bytes(data)
        self._tell(events, ticket, on_line)

    def idle(self, ticket: int = 0, on_line: LineSink | None = None) -> None:
        """Let the codec know that a deadline passed with nothing arriving."""
        with self._lock:
            events = self.codec.idle()
            self._note(events)
        self._tell(events, ticket, on_line)

    def _tell(self, events: Sequence[Event], ticket: int, on_line: LineSink | None) -> None:
        """Give the lines of one reply to `on_line`, and those that no command asked for to whoever hears such."""
        for event in events:
            if isinstance(event, Stray) and self._on_line is not None:
                self._on_line(event.text)
            elif isinstance(event, ReplyLine) and event.ticket == ticket and on_line is not None:
                on_line(event.text)
            elif isinstance(event, Reply | StrayPrompt) and self._on_prompt is not None:
                self._on_prompt()
        if (back := self._back) is not None:
            self._back = None
            self.on_back(back)

    def _note(self, events: Sequence[Event]) -> None:
        now = self.clock.monotonic()
        for event in events:
            if isinstance(event, Reply | StrayPrompt) and not self.dialect.learnt:
                self._stands(event.menu, now)
            match event:
                case Reply():
                    sent = self._sent_at.pop(event.ticket, now)
                    if self.doubt_until is not None and sent >= self.doubt_until:
                        self.doubt_until = None
                    if self._mark == event.ticket:
                        # Nothing went out since: the wire keeps the order, so nothing else is under way.
                        early = self._beginning is not None and sent < self._beginning
                        self.doubt_until = self._beginning if early else None
                    if event.ticket not in self._interjected:
                        self.lost = False
                    if not self.codec.owed:
                        self.busy_until = self.last_sent
                    self._replies[event.ticket] = self._placed(event)
                case StrayPrompt():
                    if self.dialect.learnt:
                        self.menu = None
                    elif event.menu != self.menu:
                        self.menu, self.lost = None, True
                    self.busy_until = self.last_sent
                    self.doubt(now + 2 * self.delay_s)
                case Stray():
                    if self.dialect.live is None or not self.dialect.live.search(event.text):
                        self.stray_bytes += len(event.text)
                    self.menu = None if self.dialect.learnt else self.menu
                    self.doubt(now + 2 * self.delay_s)
                    continue
                case ReplyLine():
                    pass
            self.last_reply = now

    def _stands(self, menu: str, now: float) -> None:
        """Take in the menu of a prompt: none is a late answer from before it, as a wire keeps the order."""
        ends = menu in self.dialect.ends
        if self._inside and ends:
            self._back = menu
        # What an earlier session has sent may still reach the dish.
        self._inside = not ends and (self._beginning is None or now >= self._beginning)

    def _placed(self, reply: Reply) -> Reply:
        """Take in the menu that a prompt names; a learnt one names none, and only says whether it is still the same."""
        if not self.dialect.learnt:
            self.menu, self.token = reply.menu, reply.token
            return reply
        if reply.token != self.token:
            self.menu = None
        self.token = reply.token
        return replace(reply, menu=self.menu or "")
