"""The command `h` of `MOT>`: finds the reference of an axis by its stop (docs/reference/g2-motors.md, *Homing*)."""

from __future__ import annotations

from typing import Protocol

from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.mechanics import TrkDish


class HomingBoard(Protocol):
    """What homing needs of the board."""

    @property
    def dish(self) -> TrkDish:
        """The motors."""

    @property
    def now_s(self) -> float:
        """Dish time."""

    def referenced(self, index: int) -> str:
        """Take note that an axis has found its reference, and return what is printed then."""


def home(board: HomingBoard, index: int) -> Script:
    """Home one axis: blocks until done or timed out, then prints what the firmware prints."""
    axis = board.dish.axes[index]
    if axis.released:
        board.dish.engage(board.now_s)
    yield Pause(axis.home(board.now_s) - board.now_s)
    if not axis.homing_done(board.now_s):
        yield f"{axis.data.name} Motor Home Failure\n"
        return
    yield board.referenced(index)


def homing(board: HomingBoard, args: list[str]) -> Script | None:
    """`h <id>` or `h *`: the elevation first, as at power-on."""
    which = {"0": (0,), "1": (1,), "*": (1, 0)}.get(args[0]) if len(args) == 1 else None
    return None if which is None else _home(board, which)


def _home(board: HomingBoard, which: tuple[int, ...]) -> Script:
    for index in which:
        yield from home(board, index)
