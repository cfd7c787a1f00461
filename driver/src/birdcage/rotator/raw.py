"""The wire of a machine, for a person who types.

A *place* is where a line is understood: a menu. None is a place that is not known, or that of a machine without menus.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from birdcage.base.errors import NoReply
from birdcage.rotator.verdict import Grade, Verdict

Permit = Callable[[], None]
"""Asked, with writing locked, just before a line goes out; raises to keep it back."""


@dataclass(frozen=True, slots=True)
class CommandDoc:
    """One command of one place."""

    menu: str | None
    """None on a machine without menus."""
    name: str
    usage: str
    """With its arguments: `a <motor> <angle>`."""
    help: str
    """What it does; empty if undocumented."""


@dataclass(frozen=True, slots=True)
class RawAnswer:
    """What a machine answered to one line."""

    lines: tuple[str, ...]
    """Neither echo nor prompt."""
    place: str | None
    """Where the machine is now."""
    prompt: str
    """As the machine wrote it: `MOT>`. Empty where it shows none."""
    refused: bool = False
    """Whether it says that nothing was done."""
    boot_lines: tuple[str, ...] = ()
    """Those of `lines` that it prints only when it starts."""


class RawExchange(Protocol):
    """One line under way. Somebody must keep listening to the machine, or its answer is never heard."""

    @property
    def sent(self) -> float:
        """When it went out, in monotonic seconds."""

    @property
    def due(self) -> float:
        """When its answer is there at the latest, if the machine is well and does not print on."""

    @property
    def heard_at(self) -> float:
        """When anything last arrived; before `sent` when nothing did since."""

    @property
    def answer(self) -> RawAnswer | None:
        """The answer, when it is there."""

    def end(self) -> None:
        """End what prints on, by the key that does so; where no key does, by waiting no longer."""

    def wait(self, timeout_s: float) -> RawAnswer | None:
        """Wait for the answer, listening; None when it did not come within a time."""

    def give_up(self) -> NoReply:
        """Expect no answer any more, and return why there may be none."""


class RawLines(Protocol):
    """What a machine's language offers to a raw console. The owner's thread only, where nothing else is said.

    What talks raises `LinkError` when the port is gone and `NoReply` when the machine does not answer.
    """

    @property
    def has_prompt(self) -> bool:
        """Whether the machine shows a prompt. Without one it has no menus, and an answer ends when it is quiet."""

    @property
    def home(self) -> str | None:
        """The place where motions are understood, and what stops them."""

    @property
    def delay_s(self) -> float:
        """How long an answer that has begun may pause."""

    def judge(self, line: str, place: str | None, *, homed: bool | None) -> Verdict:
        """Say what a line would do there. Sends nothing; any thread."""

    def only_asks(self, line: str, prompt: str) -> bool:
        """Return whether a line that went out at this prompt changes nothing but the place. Any thread."""

    def says_target(self, text: str) -> bool:
        """Return whether a line from the machine does nothing but name the angle that it was sent to. Any thread."""

    def is_prompt(self, text: str) -> bool:
        """Return whether a line from the machine is a prompt and nothing else. Any thread."""

    def commands(self, place: str | None) -> tuple[CommandDoc, ...]:
        """Return the documented commands of a place. Any thread."""

    def help_lines(self, place: str | None) -> tuple[str, ...]:
        """Return the lines that bring the machine's own list of commands, page by page; empty if it has none."""

    def ask_commands(self, line: str, place: str | None, permit: Permit) -> tuple[CommandDoc, ...]:
        """Send one of the `help_lines` and return the commands that it lists; CommandRefused if it is not taken."""

    def find_place(self) -> str | None:
        """Return where the machine is; asked only when that is not known."""

    def go_home(self) -> None:
        """Bring the machine to `home`; nothing is sent when it is there already."""

    def leaves(self, line: str, place: str | None) -> bool:
        """Return whether a line does nothing but leave this place: then `leave` does it safely."""

    def leave(self) -> RawAnswer:
        """Leave the present place, and return where the machine is then."""

    def type_line(
        self, line: str, place: str | None, *, takes_s: float, confirmed: Grade, permit: Permit
    ) -> RawExchange:
        """Send a line that a person typed in this place, as it is; the owner goes on, and collects the answer.

        `takes_s`: how long it may keep the machine busy. `confirmed`: how bad a person was told that it is;
        CommandRefused for a line that could end the machine's shell there, and was not confirmed as that.
        """
