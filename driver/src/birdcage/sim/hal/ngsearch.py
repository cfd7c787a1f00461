"""The menu of the TV search: `s` stops it, `q` leaves (`docs/reference/travler.md`, *Start and search*)."""

from __future__ import annotations

from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.menu import HalMenu
from birdcage.sim.hal.search import HalSearch
from birdcage.sim.shell import Script


class NgsearchMenu(HalMenu):
    """Stops the search until the next power-up; whether it can be started from here no source says."""

    help_lines = ("s", "q")

    def __init__(self, board: HalBoard, search: HalSearch) -> None:
        super().__init__(board, board.settings.prompt_ngsearch)
        self.commands["s"] = self._stop
        self._search = search

    def _stop(self, args: list[str]) -> Script:  # noqa: ARG002
        self._search.stop()
        if self.board.settings.search_stopped_text:
            yield f"{self.board.settings.search_stopped_text}\n"
