"""What a Carryout of 2003 does when it gets power: homing by stall, then the TV search.

Both are written, what it prints is assumed: `docs/reference/carryout-2003.md`, *Power-up*.
"""

from __future__ import annotations

from birdcage.sim.carryout.board import CarryoutBoard
from birdcage.sim.carryout.search import CarryoutSearch
from birdcage.sim.shell import Pause, Script

START_S = 1.0
LINE_S = 5.0
"""A motor that homes is told of this often."""


def boot_log(board: CarryoutBoard, search: CarryoutSearch, *, home: bool) -> Script:
    """Home both axes and begin the search; neither where tracking is disabled (written), or without `home`."""
    yield from _line(board, "HandEra HAL 1.00.065")
    yield Pause(START_S)
    if not home or not board.memory.tracks:
        return
    for index in (1, 0):
        yield from _home(board, index)
    if board.settings.search:
        search.start()


def _home(board: CarryoutBoard, index: int) -> Script:
    axis = board.dish.axes[index]
    end_s = max(board.now_s + board.settings.boot_home_s / 2.0, axis.home(board.now_s))
    while board.now_s < end_s - 1e-6:
        yield from _line(board, f"{axis.data.name} calibrating")
        yield Pause(min(LINE_S, end_s - board.now_s))
    if (board.settings.home_fails and index == 1) or not axis.homing_done(board.now_s):
        axis.halt(board.now_s)


def _line(board: CarryoutBoard, text: str) -> Script:
    if board.settings.boot_text:
        yield f"{text}\n"
