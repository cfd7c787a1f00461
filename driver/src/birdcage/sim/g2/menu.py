"""What every menu of the G2 does alike: its help, leaving it, and words it does not know."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.g2.board import Board
from birdcage.sim.shell import Enter, Script

Command = Callable[[list[str]], Script]


class G2Menu:
    """One submenu. A subclass fills `commands` and `help_lines`."""

    prompt = ""
    help_lines: tuple[str, ...] = ()

    def __init__(self, board: Board) -> None:
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

    def _help(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "".join(f"{line}\n" for line in self.help_lines)

    def _leave(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Enter("root")
