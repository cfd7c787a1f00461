"""What every menu does alike: its help, leaving it, and words it does not know."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, Protocol, TypeVar

from birdcage.sim.settings import SimSettings
from birdcage.sim.shell import Enter, Script

Command = Callable[[list[str]], Script]


class MenuBoard(Protocol):
    """What a menu needs of the board."""

    @property
    def settings(self) -> SimSettings:
        """The knobs."""


AnyBoard = TypeVar("AnyBoard", bound=MenuBoard)


class TrkMenu(Generic[AnyBoard]):
    """One submenu. A subclass fills `commands` and `help_lines`."""

    prompt = ""
    help_lines: tuple[str, ...] = ()

    def __init__(self, board: AnyBoard) -> None:
        self.board = board
        self.commands: dict[str, Command] = {"?": self._help, "help": self._help, "q": self._leave}

    def run(self, words: list[str]) -> Script:
        """Carry out one line."""
        command = self.commands.get(words[0])
        if command is None:
            yield from self.unknown(words)
        else:
            yield from command(words[1:])

    def unknown(self, words: list[str]) -> Script:  # noqa: ARG002
        """Answer to a word that is no command here."""
        yield f"{self.board.settings.unknown_command}\n"

    def bad_parameter(self) -> Script:
        """Answer to a number that cannot be used."""
        yield f"{self.board.settings.bad_parameter}\n"

    def _help(self, args: list[str]) -> Script:
        if not args:
            yield "".join(f"{line}\n" for line in self.first_page)
            return
        line = next((line for line in self.help_lines if args[0] == named(line)), None)
        if line is None:
            yield from self.unknown(args)
        else:
            yield f"{line}\n"

    @property
    def first_page(self) -> tuple[str, ...]:
        """What `?` lists: everything, unless a menu has a second page."""
        return self.help_lines

    def _leave(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Enter("root")


def named(help_line: str) -> str:
    """Return the command that a line of help is about: `dvb` of `Enter <dvb> - DVB Tuner`, `a` of `a [<motor>]`."""
    first, _, rest = help_line.partition(" ")
    return rest[1:].partition(">")[0] if first == "Enter" else first
