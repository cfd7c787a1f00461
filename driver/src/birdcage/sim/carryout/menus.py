"""The menus of a Carryout of 2003: root, `target`, `motor`, `dvb`, `os`, `nvs`.

Their names are written, their texts are open: `docs/reference/carryout-2003.md`, *Menus*.
"""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.carryout.board import CarryoutBoard, number
from birdcage.sim.carryout.search import CarryoutSearch
from birdcage.sim.shell import Enter, Pause, Script, quitting

Command = Callable[[list[str]], Script]
SUBMENUS = ("target", "motor", "dvb", "os", "nvs")
SAVE_S = 0.5
"""How long flash takes (assumed)."""


class CarryoutMenu:
    """One menu: its help, leaving it, and words it does not know. `motor` and `dvb` have no command that is known."""

    def __init__(self, board: CarryoutBoard, name: str, *lists: str) -> None:
        self.board = board
        settings = board.settings
        own = "TRK>" if name == "root" else f"{name.upper()}>"
        self.prompt = settings.prompt_alike if settings.prompts == "alike" else own
        self.commands: dict[str, Command] = {"?": self._help, "q": self._leave}
        self._lists = (*lists, "q")

    def run(self, words: list[str]) -> Script:
        """Carry out one line."""
        command = self.commands.get(words[0])
        yield from self.unknown() if command is None else command(words[1:])

    def unknown(self) -> Script:
        """Answer to a word that is no command here."""
        yield f"{self.board.settings.unknown_command}\n"

    def bad_parameter(self) -> Script:
        """Answer to a number that cannot be used."""
        yield f"{self.board.settings.bad_parameter}\n"

    def _help(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "".join(f"{line}\n" for line in self._lists)

    def _leave(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Enter("root")


class CarryoutRootMenu(CarryoutMenu):
    """Enters submenus. What `q` does here is a setting."""

    def __init__(self, board: CarryoutBoard) -> None:
        super().__init__(board, "root", *SUBMENUS)
        self.commands |= {name: self._enters(name) for name in SUBMENUS}

    def _enters(self, name: str) -> Command:
        def enter(args: list[str]) -> Script:  # noqa: ARG001
            yield Enter(name)

        return enter

    def _leave(self, args: list[str]) -> Script:  # noqa: ARG002
        yield from quitting(self.board.settings.root_q, self.unknown)


class OsMenu(CarryoutMenu):
    """Lists and quits processes (written); the two words are those of a Trav'ler (assumed)."""

    def __init__(self, board: CarryoutBoard, search: CarryoutSearch) -> None:
        super().__init__(board, "os", "tasks", "kill <name>")
        self.commands |= {"tasks": self._tasks, "kill": self._kill}
        self._search = search

    def _tasks(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "Shell\nMotor\n" + ("Search\n" if self._search.running else "")

    def _kill(self, args: list[str]) -> Script:
        if args != ["Search"] or not self.board.settings.os_kills:
            yield from self.bad_parameter()
            return
        self._search.stop()


class CarryoutNvsMenu(CarryoutMenu):
    """Shows, edits and saves settings: `d`, `d <i>`, `e <i>`, `e <i> <v>`, `s` (all but `d` written)."""

    def __init__(self, board: CarryoutBoard) -> None:
        super().__init__(board, "nvs", "d [<index>]", "e <index> [<value>]", "s")
        self.commands |= {"d": self._show, "e": self._edit, "s": self._save}

    def _show(self, args: list[str]) -> Script:
        index = self._index(args)
        if args and index is None:
            yield from self.bad_parameter()
            return
        for row in sorted(self.board.memory.rows) if index is None else [index]:
            yield self._row(row)

    def _edit(self, args: list[str]) -> Script:
        index = self._index(args[:1])
        value = number(args[1]) if len(args) == 2 else None
        if index is None or (len(args) > 1 and value is None):
            yield from self.bad_parameter()
            return
        if value is not None:
            self.board.memory.write(index, value)
        yield self._row(index)

    def _save(self, args: list[str]) -> Script:  # noqa: ARG002
        yield Pause(SAVE_S)
        self.board.memory.save()
        yield "Saved.\n"

    def _row(self, index: int) -> str:
        return f"{index:3d}) {self.board.memory.rows[index].name:<26}{self.board.memory.ram[index]:>11.2f}\n"

    def _index(self, args: list[str]) -> int | None:
        index = int(args[0]) if len(args) == 1 and args[0].isdecimal() else None
        return index if index in self.board.memory.rows else None
