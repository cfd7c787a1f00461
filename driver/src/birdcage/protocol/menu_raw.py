"""The raw console of a machine with menus: a dialect and its open console, behind `RawLines`."""

from __future__ import annotations

import re

from birdcage.base.errors import NoReply
from birdcage.console.events import Reply
from birdcage.console.raw import Typed
from birdcage.protocol.command_list import parse_help
from birdcage.protocol.firmware import FirmwareProtocol
from birdcage.rotator.raw import CommandDoc, Permit, RawAnswer
from birdcage.rotator.verdict import Grade, Verdict

HELP = ("?",)
"""What brings the help of a menu, unless its dialect knows better (`docs/reference/consoles.md`, *Shell*)."""

PROMPT = re.compile(r"\S{0,16}>")


class MenuRaw:
    """Implements `RawLines`; LinkError from all that talks while no console is open."""

    has_prompt = True

    def __init__(self, protocol: FirmwareProtocol) -> None:
        self._protocol = protocol

    @property
    def home(self) -> str | None:
        """The motor menu."""
        return self._protocol.motor_menu

    @property
    def delay_s(self) -> float:
        """The longest that an answer may be on its way."""
        return self._protocol.console.delay_s

    def judge(self, line: str, place: str | None, *, homed: bool | None) -> Verdict:
        """Say what a line would do in a menu."""
        return self._protocol.judge(line, place, homed=homed)

    def only_asks(self, line: str, prompt: str) -> bool:
        """Return whether a line at this prompt changes nothing but the menu."""
        return self._protocol.only_asks(line, prompt)

    def says_target(self, text: str) -> bool:
        """Return whether this is a number by its name, which is how the family says where it goes."""
        return self._protocol.says_target(text)

    def is_prompt(self, text: str) -> bool:
        """Return whether a line is shaped like a prompt: those of some dishes are in no source."""
        return PROMPT.fullmatch(text.strip()) is not None

    def commands(self, place: str | None) -> tuple[CommandDoc, ...]:
        """Return the documented commands of a menu."""
        return tuple(command for command in self._protocol.commands if command.menu == place)

    def help_lines(self, place: str | None) -> tuple[str, ...]:
        """Return the lines that bring the help of a menu."""
        return self._protocol.help_lines.get(place or "", HELP)

    def ask_commands(self, line: str, place: str | None, permit: Permit) -> tuple[CommandDoc, ...]:
        """Ask for one page of the help of the present menu."""
        return parse_help(place, self._protocol.console.exchange(line, permit=permit).lines)

    def find_place(self) -> str | None:
        """Return the menu, asked for by a bare Enter when it is not known."""
        return self._protocol.console.find_menu()

    def go_home(self) -> None:
        """Enter the motor menu."""
        self._protocol.enter_motor_menu()

    def leaves(self, line: str, place: str | None) -> bool:
        """Return whether this is the `q` of a submenu."""
        dialect = self._protocol.dialect
        return line.strip().lower() == dialect.leave and place not in dialect.ends

    def leave(self) -> RawAnswer:
        """Leave the submenu, proven first, for the one above it."""
        console = self._protocol.console
        return RawAnswer((), console.leave_one(), console.prompt)

    def type_line(self, line: str, place: str | None, *, takes_s: float, confirmed: Grade, permit: Permit) -> MenuTyped:
        """Send a line; what could leave a menu goes out at the root only where it was confirmed as what can ruin."""
        console = self._protocol.console
        at_root = confirmed is Grade.RUINS and place in console.dialect.ends
        typed = console.type_line(line, takes_s=takes_s, permit=permit, at_root=at_root)
        if "homed" in self.judge(line, place, homed=None).forgets:
            self._protocol.may_have_homed()
        return MenuTyped(self._protocol, typed)


class MenuTyped:
    """Implements `RawExchange` over a line that the console has sent."""

    def __init__(self, protocol: FirmwareProtocol, typed: Typed) -> None:
        self._protocol, self._typed = protocol, typed
        self.sent, self.due = typed.sent, typed.due

    @property
    def heard_at(self) -> float:
        """When anything last arrived, in monotonic seconds."""
        return self._typed.heard_at

    @property
    def answer(self) -> RawAnswer | None:
        """What stood before the prompt, once it has come."""
        reply = self._typed.reply
        return None if reply is None else self._told(reply)

    def end(self) -> None:
        """Send a bare Enter, never a `q`: at the root that may end the shell (`docs/decisions/0003-q-in-step.md`)."""
        self._typed.press_enter()

    def wait(self, timeout_s: float) -> RawAnswer | None:
        """Wait for the prompt."""
        reply = self._typed.wait(timeout_s)
        return None if reply is None else self._told(reply)

    def give_up(self) -> NoReply:
        """Expect no prompt any more."""
        return self._typed.give_up()

    def _told(self, reply: Reply) -> RawAnswer:
        marks = self._protocol.boot_marks
        return RawAnswer(
            reply.lines,
            reply.menu,
            reply.token,
            refused=self._protocol.console.refusal(reply) is not None,
            boot_lines=tuple(line for line in reply.lines if any(mark in line for mark in marks)),
        )
