"""A session with a machine that speaks in plain lines: no prompt, no echo, no menus.

Nothing tells to which request a line belongs. So a request says which line answers it, and a new one goes out only
when an answer that was given up can no longer come.
"""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from birdcage.base.clock import Clock, WaitOutcome
from birdcage.base.errors import CommandRefused, NoReply
from birdcage.base.reason import Reason
from birdcage.base.wake import Wake
from birdcage.console.diagnosis import KEPT, is_garbage
from birdcage.console.escapes import without_escapes
from birdcage.console.line_splitter import HeardLine, LineSplitter
from birdcage.link.port import Port

Listener = Callable[[HeardLine], None]


@dataclass(frozen=True, slots=True)
class LineDialect:
    """What a plain line machine's wire looks like."""

    line_end: bytes = b"\r"
    refusals: tuple[tuple[re.Pattern[str], Reason], ...] = ()
    """Lines that mean that nothing was done, each with the `CommandRefused` reason it stands for."""

    def refusal(self, text: str) -> Reason | None:
        """Return the reason that a line stands for; None when it refuses nothing."""
        return next((reason for pattern, reason in self.refusals if pattern.search(text)), None)


@dataclass(frozen=True, slots=True)
class LineAnswer:
    """The line that answered a request, and when its first byte came (monotonic seconds)."""

    match: re.Match[str]
    at: float


class LineSession:
    """Writes lines, hears lines. Synchronous; one thread, except for `interject`.

    `delay_s` is the longest that an answer may be on its way. `wake` ends waits early and then calls `on_wake`, which
    must clear it, and may raise to abandon the request. `on_line` hears each line that answers no request. Every method
    raises `LinkError` when the port is gone.
    """

    def __init__(
        self,
        link: Port,
        clock: Clock,
        dialect: LineDialect,
        *,
        delay_s: float = 2.0,
        wake: Wake | None = None,
        on_wake: Callable[[], None] | None = None,
        on_line: Listener | None = None,
    ) -> None:
        self.link, self.clock, self.dialect, self.delay_s = link, clock, dialect, delay_s
        self._wake = wake if on_wake is not None else None
        self._on_wake = on_wake
        self._on_line = on_line
        # Reentrant, as a signal handler may interject on top of the thread that it interrupted.
        self._lock = threading.RLock()
        self._splitter = LineSplitter()
        self._awaited: re.Pattern[str] | None = None
        self._answer: LineAnswer | CommandRefused | None = None
        self._doubt_until = clock.monotonic()
        """Until when the answer to a request that was given up may come, and be taken for another's."""
        self._seen = bytearray()
        self.on_any: Listener | None = None
        """Hears every line that answers no request before `on_line` does; for a person who types."""
        self.last_received = clock.monotonic()
        """When anything last arrived."""

    @property
    def unfinished(self) -> str:
        """What came since the last line end."""
        return self._splitter.unfinished

    @property
    def stray_bytes(self) -> int:
        """How many bytes could not be read."""
        return self._splitter.noise

    def send(self, line: str, permit: Callable[[], None] | None = None) -> float:
        """Write one line at once; return when, in monotonic seconds.

        `permit` is asked under the lock that `interject` takes too: what it lets through is on the wire before any
        line that is interjected afterwards. What it raises keeps the line back. ValueError for what is no ASCII text.
        """
        data = self._written([line])
        with self._lock:
            if permit is not None:
                permit()
            self.link.write(data)
            return self.clock.monotonic()

    def interject(self, lines: Sequence[str]) -> None:
        """Write `lines` in one piece, from any thread, also while a request waits. For STOP."""
        data = self._written(lines)
        with self._lock:
            self.link.write(data)

    def ask(
        self,
        line: str,
        answer: re.Pattern[str],
        *,
        within_s: float | None = None,
        permit: Callable[[], None] | None = None,
    ) -> LineAnswer:
        """Send a line, and return the first line after it that `answer` matches as a whole.

        It is due within `within_s`, by default `delay_s`. NoReply (`silent`, `garbage`, `echo`, `blocked`) when it did
        not come; CommandRefused when the machine says so.
        """
        self._clear()
        self._seen.clear()
        patience_s = self.delay_s if within_s is None else within_s
        sent = self.send(line, permit)
        self._awaited, self._answer = answer, None
        try:
            while self._answer is None and self._pump(sent + patience_s):
                pass
            if isinstance(self._answer, CommandRefused):
                raise CommandRefused(f"The machine refused `{line}`: {self._answer}", reason=self._answer.reason)
            if self._answer is None:
                raise self._no_answer(line, patience_s)
            return self._answer
        except CommandRefused:
            raise
        except BaseException:
            self._doubt_until = max(self._doubt_until, sent + self.delay_s)
            raise
        finally:
            self._awaited = None

    def listen(self, until: float) -> bool:
        """Take in what comes; False when nothing did before `until` (monotonic seconds)."""
        return self._pump(until)

    def take_in(self) -> None:
        """Read what is there, without waiting."""
        data = self.link.read()
        if not data:
            return
        now = self.last_received = self.clock.monotonic()
        self._seen += data[: max(0, KEPT - len(self._seen))]
        for line in self._splitter.feed(data, now):
            self._hear(line)

    def _written(self, lines: Sequence[str]) -> bytes:
        for line in lines:
            if not (line.isascii() and line.isprintable()):
                raise ValueError(f"a line holds printable ASCII only, not {line!r}")
        return b"".join(line.encode("ascii") + self.dialect.line_end for line in lines)

    def _clear(self) -> None:
        """Hear what an earlier request may still bring, or it would be taken for the answer to the next."""
        self.take_in()
        while self.clock.monotonic() < self._doubt_until and self._pump(self._doubt_until):
            pass

    def _pump(self, until: float) -> bool:
        outcome = self.clock.wait(self.link, until, self._wake)
        if outcome is WaitOutcome.INTERRUPTED and self._on_wake is not None:
            self._on_wake()
        elif outcome is WaitOutcome.TIMEOUT:
            return False
        self.take_in()
        return True

    def _hear(self, line: HeardLine) -> None:
        if self._awaited is not None and self._answer is None:
            if (match := self._awaited.fullmatch(line.text)) is not None:
                self._answer = LineAnswer(match, line.at)
                return
            if (reason := self.dialect.refusal(line.text)) is not None:
                self._answer = CommandRefused(line.text, reason=reason)
                return
        for listener in (self.on_any, self._on_line):
            if listener is not None:
                listener(line)

    def _no_answer(self, line: str, waited_s: float) -> NoReply:
        """Judge what arrived since the request went out."""
        name, seen = self.link.name, without_escapes(bytes(self._seen))
        text = "".join(chr(byte) if 0x20 <= byte < 0x7F else "." for byte in seen.strip())
        if not seen:
            return NoReply(
                f"The machine is silent: `{line}` on {name} brought nothing in {waited_s:.1f} s. Check its power, the "
                "cable, and the baud rate.",
                reason=Reason.SILENT,
            )
        if is_garbage(seen):
            return NoReply(
                f"What arrives on {name} cannot be read ({len(seen)} bytes after `{line}`). Check the baud rate, the "
                "wires of the receiving pair, and what is connected.",
                reason=Reason.GARBAGE,
            )
        if text == line.strip():
            return NoReply(
                f"Only our own `{line}` came back on {name}. The adapter hears itself, or the machine does not answer.",
                reason=Reason.ECHO,
            )
        return NoReply(
            f"The machine talks on {name}, but nothing that answers `{line}` came in {waited_s:.1f} s (last: "
            f"`{text[-60:]}`).",
            reason=Reason.BLOCKED,
        )
