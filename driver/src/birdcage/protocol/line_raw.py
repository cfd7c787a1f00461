"""The raw console of a machine that speaks in plain lines: no prompt ends an answer, so quiet does."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.base.errors import NoReply
from birdcage.base.reason import Reason
from birdcage.console.line_session import LineSession
from birdcage.console.line_splitter import HeardLine
from birdcage.protocol.hazard import HazardTable
from birdcage.protocol.raw_aim import aimed
from birdcage.rotator.raw import CommandDoc, Permit, RawAnswer
from birdcage.rotator.verdict import Grade, Verdict

QUIET_S = 0.5
"""After so long without a byte an answer is over, and a line that brought none is done."""
LONGEST_S = 2.0
"""No answer is waited for longer: a machine may print on by itself without end. What comes later is told as unasked."""


class LineRaw:
    """Implements `RawLines` with no place, no prompt, no list of commands.

    `session` returns the open session, and raises LinkError when there is none. `boot_marks`: words of lines that the
    machine prints only when it starts.
    """

    has_prompt = False
    home = None
    delay_s = QUIET_S

    def __init__(
        self,
        session: Callable[[], LineSession],
        hazards: HazardTable,
        commands: tuple[CommandDoc, ...] = (),
        boot_marks: tuple[str, ...] = (),
    ) -> None:
        self._session, self._hazards, self._commands, self._boot_marks = session, hazards, commands, boot_marks

    def judge(self, line: str, place: str | None, *, homed: bool | None) -> Verdict:
        """Say what a line would do, by the rows of the table."""
        return aimed(*self._hazards.judge(line, place, homed=homed))

    def only_asks(self, line: str, prompt: str) -> bool:  # noqa: ARG002 - there is none
        """Return whether a line changes nothing."""
        return self.judge(line, None, homed=True).grade is Grade.HARMLESS

    def says_target(self, text: str) -> bool:  # noqa: ARG002 - lines of one shape tell that and what was asked for
        """Return False: every line is seen."""
        return False

    def is_prompt(self, text: str) -> bool:  # noqa: ARG002 - there is none
        """Return False: there is none."""
        return False

    def commands(self, place: str | None) -> tuple[CommandDoc, ...]:
        """Return the documented commands."""
        return tuple(command for command in self._commands if command.menu == place)

    def help_lines(self, place: str | None) -> tuple[str, ...]:  # noqa: ARG002 - there is one only
        """Return nothing: such a machine does not list its commands."""
        return ()

    def ask_commands(self, line: str, place: str | None, permit: Permit) -> tuple[CommandDoc, ...]:  # noqa: ARG002
        """Return nothing: `help_lines` has no line to ask with."""
        return ()

    def find_place(self) -> None:
        """Return None: there is one place only. LinkError when no port is open."""
        self._session().take_in()

    def go_home(self) -> None:
        """Do nothing: every line is understood everywhere."""

    def leaves(self, line: str, place: str | None) -> bool:  # noqa: ARG002 - no line does
        """Return False: there is nothing to leave."""
        return False

    def leave(self) -> RawAnswer:
        """Do nothing: there is nothing to leave."""
        return RawAnswer((), None, "")

    def type_line(
        self, line: str, place: str | None, *, takes_s: float, confirmed: Grade, permit: Permit  # noqa: ARG002
    ) -> LineTyped:  # fmt: skip
        """Send a line as it was typed."""
        return LineTyped(self._session(), line, takes_s, permit, self._boot_marks)


class LineTyped:
    """Implements `RawExchange`: the answer is what came until the machine fell quiet; perhaps nothing.

    What comes meanwhile is told as unasked too: nothing says that it answers.
    """

    def __init__(
        self, session: LineSession, line: str, takes_s: float, permit: Permit, boot_marks: tuple[str, ...]
    ) -> None:
        self._session, self._takes_s, self._boot_marks = session, takes_s, boot_marks
        self._lines: list[str] = []
        self._answer: RawAnswer | None = None
        session.take_in()
        session.on_any = self._hear
        try:
            self.sent = session.send(line, permit)
        except BaseException:
            session.on_any = None
            raise

    def _hear(self, line: HeardLine) -> None:
        self._lines.append(line.text)

    @property
    def heard_at(self) -> float:
        """When anything last arrived, in monotonic seconds."""
        return self._session.last_received

    @property
    def due(self) -> float:
        """When the answer is over, should nothing more come."""
        busy_until = self.sent + self._takes_s
        quiet = (self.heard_at if self.heard_at > self.sent else busy_until) + QUIET_S
        return min(quiet, busy_until + LONGEST_S)

    @property
    def answer(self) -> RawAnswer | None:
        """What came, once it is quiet."""
        if self._answer is None and self._session.clock.monotonic() >= self.due:
            self.end()
        return self._answer

    def end(self) -> None:
        """Take what has come for the answer; nothing is sent, as no key ends what prints on."""
        if self._answer is None:
            rest = self._session.unfinished
            lines = (*self._lines, rest) if rest else tuple(self._lines)
            refused = any(self._session.dialect.refusal(line) is not None for line in lines)
            boot_lines = tuple(line for line in lines if any(mark in line for mark in self._boot_marks))
            self._answer = RawAnswer(lines, None, "", refused=refused, boot_lines=boot_lines)
            self._session.on_any = None

    def wait(self, timeout_s: float) -> RawAnswer | None:
        """Listen until it is quiet, or for a time."""
        deadline = self._session.clock.monotonic() + timeout_s
        while self.answer is None and self._session.clock.monotonic() < deadline:
            self._session.listen(min(deadline, self.due))
        return self.answer

    def give_up(self) -> NoReply:
        """Return that nothing came: it does not happen, as no answer is one too."""
        self.end()
        return NoReply("The machine did not fall quiet.", reason=Reason.BLOCKED)
