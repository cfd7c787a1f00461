"""The menu of tasks of HAL 0.0.00: `kill Search` ends the TV search (`docs/reference/travler-older.md`, *Search*)."""

from __future__ import annotations

from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.knobs import Hal000Settings
from birdcage.sim.hal.menu import HalMenu
from birdcage.sim.hal.search import HalSearch
from birdcage.sim.shell import Die, Script

SEARCH, SHELL = "Search", "Shell"
"""The task that is killed by this name (written), and the one that answers: its name is assumed. More may run."""


class TaskMenu(HalMenu):
    """`tasks` lists the tasks, `kill <name>` ends one. Names count as they are written (assumed)."""

    help_lines = ("tasks", "kill <name>", "q")

    def __init__(self, board: HalBoard, search: HalSearch, settings: Hal000Settings) -> None:
        super().__init__(board, settings.prompt_os)
        self.commands |= {"tasks": self._list, "kill": self._kill}
        self._search, self._settings = search, settings

    def _running(self) -> tuple[str, ...]:
        return (SHELL, SEARCH) if self._search.running else (SHELL,)

    def _list(self, args: list[str]) -> Script:  # noqa: ARG002
        yield "".join(f"{name}\n" for name in self._running())

    def _kill(self, args: list[str]) -> Script:
        if len(args) != 1:
            yield from self.bad_parameter()
            return
        if args[0] not in self._running():
            yield f"{self._settings.no_task_text}\n"
            return
        if args[0] == SHELL:
            yield Die()
        self._search.stop()
        if self._settings.search_stopped_text:
            yield f"{self._settings.search_stopped_text}\n"
