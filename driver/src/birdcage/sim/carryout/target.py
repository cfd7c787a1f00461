"""The menu `target`: `g <az> <el>` moves both axes, and tells where they are as long as they run.

`docs/reference/carryout-2003.md`, *Moving*.
"""

from __future__ import annotations

from birdcage.sim.carryout.board import CarryoutBoard, number
from birdcage.sim.carryout.menus import CarryoutMenu
from birdcage.sim.carryout.search import CarryoutSearch
from birdcage.sim.shell import Die, Listen, Pause, Script

EVERY_KEY = bytes(range(256))
LAST_RECORD_S = 0.001
"""How long after the last record the prompt comes (assumed)."""


class TargetMenu(CarryoutMenu):
    """Angles in degrees, whole or with decimals (written)."""

    def __init__(self, board: CarryoutBoard, search: CarryoutSearch) -> None:
        super().__init__(board, "target", "g <az> <el>")
        self.commands["g"] = self._go
        self._search = search

    def _go(self, args: list[str]) -> Script:
        board, settings = self.board, self.board.settings
        numbers = [number(arg) for arg in args]
        if len(numbers) != 2 or None in numbers:
            yield from self.bad_parameter()
            return
        if not board.homed:
            if settings.unhomed_move == "deadlock":
                yield Die()
            yield f"{settings.unhomed_text}\n"
            return
        target = board.target(numbers[0] or 0.0, numbers[1] or 0.0)
        if target is None:
            board.tell(settings.refusal_text)
        elif not self._takes(target):
            board.tell(settings.busy_text)
        else:
            board.records.begin()
            yield from self._watch()

    def _takes(self, target: tuple[float, float]) -> bool:
        """Begin the move, or have it wait; return whether it is taken."""
        board, settings = self.board, self.board.settings
        if self._search.running:
            if settings.search_move == "refuse":
                return False
            self._search.halt()
            board.drive.retarget(*target)
        elif board.drive.busy and settings.second_move == "refuse":
            return False
        elif board.drive.busy and settings.second_move == "queue":
            board.drive.go(*target)
        else:
            board.drive.retarget(*target)
        return True

    def _watch(self) -> Script:
        """Keep the shell as long as setting `second_move` has it."""
        board, settings = self.board, self.board.settings
        if settings.second_move not in ("block", "abort") and settings.prompt_when == "at_once":
            return
        key = False
        while board.drive.busy and not key:
            wait_s = board.drive.end_s - board.now_s + LAST_RECORD_S
            if settings.second_move == "block":
                yield Pause(wait_s)
            else:
                key = bool((yield Listen(wait_s, takes=EVERY_KEY if settings.second_move == "abort" else b"")))
        if key and settings.records == "key":
            board.records.end()
        if key and settings.second_move == "abort":
            board.drive.brake()
