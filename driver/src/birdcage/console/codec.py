"""Bytes in, replies out: pure, incremental, no I/O.

A line ends at any run of CR and LF; blank lines and terminal control sequences are dropped. A prompt is a known token
that begins a line, recognised with its last byte; what follows it on that line is the next echo. So `>` in help text
never ends a reply, and how the stream was split can't matter.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

from birdcage.console.damage import may_become
from birdcage.console.dialect import ConsoleDialect
from birdcage.console.escapes import EscapeFilter
from birdcage.console.events import Event, Reply, ReplyLine, Stray, StrayPrompt

LONGEST_LINE = 1024
"""Characters kept of one line; what follows up to its end counts as noise."""
MOST_LINES = 4096
"""Lines kept of one reply; the rest are told as `ReplyLine` only."""
MARK = " " * 8
"""A line that does nothing, sent for this alone: its echo after a prompt says that all sent before was heard."""
_UNREADABLE = "\N{REPLACEMENT CHARACTER}"


@dataclass(slots=True)
class _Owed:
    command: str
    ticket: int
    echoed: bool
    prompted: bool = False
    """Whether any prompt came since it was sent."""
    excused: bool = False
    """Whether its reply is no longer waited for."""
    is_mark: bool = False
    lines: list[str] = field(default_factory=list)


class Codec:
    """Reads one console. `expect` says what was sent, `feed` what arrived, `idle` that nothing arrives any more."""

    noise: int
    """How many bytes were unreadable or beyond `LONGEST_LINE`."""

    def __init__(self, dialect: ConsoleDialect) -> None:
        """Read consoles of `dialect`; ValueError when two menus share one token."""
        self._menus: dict[str, str] = {}
        if not dialect.learnt:
            self._menus = {token: menu for menu, token in dialect.prompts.items()}
            if len(self._menus) != len(dialect.prompts):
                raise ValueError("two menus share one prompt token")
        self._echo = dialect.echo
        self._escapes = EscapeFilter()
        self._owed: deque[_Owed] = deque()
        self._tickets = 0
        self._text = ""
        self._after_prompt = False
        self._standing: tuple[str, str] | None = None
        self.noise = 0

    @property
    def owed(self) -> int:
        """How many commands still lack their prompt."""
        return len(self._owed)

    @property
    def unfinished(self) -> str:
        """What stands at the end, after the echo of what was sent, without a line end: perhaps an unknown prompt."""
        waits = not self._owed or self._owed[0].echoed
        return self._text.rstrip() if waits and not self._after_prompt else ""

    @property
    def knows_prompts(self) -> bool:
        """Whether any prompt token is known."""
        return bool(self._menus)

    @property
    def owes_only_keys(self) -> bool:
        """Whether every line that lacks its prompt is a bare Enter, and a prompt came since each was sent."""
        return bool(self._owed) and all(owed.prompted and not owed.command for owed in self._owed)

    def learn(self, token: str) -> list[Event]:
        """Know a prompt token from now on, whatever menu shows it; what is unfinished may end by it."""
        self._menus[token] = ""
        events: list[Event] = []
        if self.unfinished == token:
            self._text = token
            self._prompt("", events)
        return events

    def unlearn(self) -> None:
        """Know no learnt prompt token any more."""
        self._menus.clear()

    def expect(self, command: str) -> int:
        """Note that `command` was sent (without its line end), and return the ticket of its reply."""
        self._tickets += 1
        text = command.strip()
        self._owed.append(_Owed(text, self._tickets, echoed=not self._echo or not text))
        return self._tickets

    def expect_mark(self) -> int:
        """Note that `MARK` was sent, and return the ticket of its reply, which comes only if the mark was echoed."""
        self._tickets += 1
        self._owed.append(_Owed("", self._tickets, echoed=False, is_mark=True))
        return self._tickets

    def owes(self, ticket: int) -> bool:
        """Return whether the command with this ticket still lacks its prompt."""
        return any(owed.ticket == ticket for owed in self._owed)

    def excuse(self, ticket: int) -> None:
        """Wait no longer for the reply to this command, which may come yet."""
        for owed in self._owed:
            owed.excused = owed.excused or owed.ticket == ticket

    def forget(self, ticket: int) -> None:
        """Expect no reply to this command any more: when it comes after all, it is stray."""
        self._owed = deque(owed for owed in self._owed if owed.ticket != ticket)

    def forget_all(self) -> None:
        """Expect nothing any more."""
        self._owed.clear()

    def feed(self, data: bytes) -> list[Event]:
        """Take in what arrived."""
        events: list[Event] = []
        for byte in self._escapes.take(data):
            if byte in b"\r\n":
                self._end_line(events)
            else:
                self._take(byte, events)
        return events

    def idle(self) -> list[Event]:
        """Take in that nothing arrives any more: a dish that stands at a prompt has answered all that it echoed.

        A key that ends a running stream, say, may be taken as a line of its own or not.
        """
        events: list[Event] = []
        while self._standing and self._owed and self._owed[0].echoed and self._owed[0].prompted:
            events.append(self._answered(*self._standing))
        return events

    def _take(self, byte: int, events: list[Event]) -> None:
        self._standing = None
        if byte == 0x09:
            byte = 0x20
        readable = 0x20 <= byte < 0x7F
        if not readable or len(self._text) >= LONGEST_LINE:
            self.noise += 1
        if len(self._text) < LONGEST_LINE:
            self._text += chr(byte) if readable else _UNREADABLE
        menu = None if self._after_prompt else self._menus.get(self._text)
        if menu is not None:
            self._prompt(menu, events)

    def _prompt(self, menu: str, events: list[Event]) -> None:
        token, self._text = self._text, ""
        self._after_prompt = True
        self._standing = (menu, token)
        for owed in self._owed:
            owed.prompted = True
        if self._owed and self._owed[0].echoed:
            events.append(self._answered(menu, token))
        else:
            events.append(StrayPrompt(menu))

    def _answered(self, menu: str, token: str) -> Reply:
        done = self._owed.popleft()
        return Reply(done.command, tuple(done.lines), menu, token, done.ticket)

    def _end_line(self, events: list[Event]) -> None:
        raw, self._text = self._text, ""
        after_prompt, self._after_prompt = self._after_prompt, False
        text = raw.rstrip()
        if after_prompt and not text and self._is_mark(raw):
            return
        if not text or self._is_echo(text.strip()):
            return
        if not self._owed or not self._owed[0].echoed:
            events.append(Stray(text))
            return
        head = self._owed[0]
        if len(head.lines) < MOST_LINES:
            head.lines.append(text)
        events.append(ReplyLine(text, head.ticket))

    def _is_mark(self, blanks: str) -> bool:
        """Take in the echo of a mark, behind a prompt and perhaps its blank; what was sent before it is over."""
        waiting = next((owed for owed in self._owed if owed.is_mark and not owed.echoed), None)
        if waiting is None or len(blanks) - len(MARK) not in (0, 1):
            return False
        waiting.echoed = True
        while self._owed[0] is not waiting:
            self._owed.popleft()
        return True

    def _is_echo(self, text: str) -> bool:
        if not self._echo:
            return False
        heard = text.replace(_UNREADABLE, "").strip()  # noise on a line at rest comes just before the echo
        while (token := next((each for each in self._menus if each and heard.startswith(each)), None)) is not None:
            heard = heard.removeprefix(token).strip()  # a prompt behind a prompt: a line before it had no echo of ours
        waiting = next(
            (owed for owed in self._owed if not owed.echoed and not owed.is_mark and self._echoes(heard, owed.command)),
            None,
        )
        if waiting is None:
            return False
        waiting.echoed = True
        # The wire keeps the order: commands sent before this one that were never echoed were lost on the way. One
        # that was echoed, and is not waited for, has lost its prompt: the dish echoes when it has answered
        # (docs/reference/consoles.md, *Shell*).
        while not self._owed[0].echoed or (self._owed[0].excused and self._owed[0] is not waiting):
            self._owed.popleft()
        return True

    def _echoes(self, heard: str, command: str) -> bool:
        """Return whether this is the echo of a command: whole, or behind the rest of a prompt."""
        if heard == command:
            return True
        if not command or not self._owed[0].echoed or not self._owed[0].excused or not heard.endswith(command):
            return False
        return any(may_become(token, heard.removesuffix(command)) for token in self._menus)
