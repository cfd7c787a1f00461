"""What every menu of the Trav'ler does alike: its help, leaving it, and words it does not know."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.hal.board import HalBoard
from birdcage.sim.shell import Enter, Script

Command = Callable[[list[str]], Script]


class HalMenu:
    """One submenu. A subclass fills `commands` (documented) and `help_lines` (what `?` prints: open)."""

    help_lines: tuple[str, ...] = ()
    above = "root"
    """Where `q` leads."""

    def __init__(self, board: HalBoard, prompt: str) -> None:
        self.board = board
        self.prompt = board.settings.prompt_alike if board.settings.prompts == "alike" else prompt
        self.commands: dict[str, Command] = {"?": self._help, "q": self._leave}

    def run(self, words: list[str]) -> Script:
        """Carry out one line."""
        command = self.commands.get(words[0])
        if command is None:
            yield from self.unknown()
        else:
            yield from command(words[1:])

    def unknown(self) -> Script:
        """Answer to a word that is no command here."""
        yield f"{self.board.settings.unknown_command}\n"

    def bad_parameter(self) -> Script:
        """Answer to a number that cannot be used."""
        yield f"{self.board.settings.bad_parameter}\n"

    def _help(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "".join(f"{line}\n" for line in self.help_lines)

    def _leave(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Enter(self.above)
