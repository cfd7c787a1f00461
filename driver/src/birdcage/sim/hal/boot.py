"""What a Trav'ler prints and does when it gets power: homing, then the TV search.

`docs/reference/travler.md`, *Start and search*: that it logs lines all the while, and the line that ends homing, are
documented; the other lines are assumed.
"""

from __future__ import annotations

from birdcage.sim.hal.board import HalBoard
from birdcage.sim.hal.search import HalSearch
from birdcage.sim.shell import Pause, Script

LINE_S = 5.0
"""A motor that homes is told of this often (assumed)."""
HEAD_S = 0.5
REST = ((1.0, "IDU found"), (0.5, "NVS loaded"))
DONE = {"nolnb": "No LNB Voltage", "nogps": "Loc: NoGPS", "none": "Searching"}


def boot_log(board: HalBoard, search: HalSearch) -> Script:
    """Home every axis, then begin the search."""
    yield from restart_log(board)
    for index in (1, 0, 2):
        yield from _home(board, index)
    yield f"{DONE[board.settings.boot_line]}\n"
    search.start()


def restart_log(board: HalBoard) -> Script:
    """Start without homing, as after a dip of the supply."""
    for seconds, line in ((HEAD_S, board.settings.head), *REST):
        yield Pause(seconds)
        yield f"{line}\n"


def _home(board: HalBoard, index: int) -> Script:
    axis = board.dish.axes[index]
    end_s = max(board.now_s + board.settings.boot_home_s / 3.0, axis.home(board.now_s))
    while board.now_s < end_s - 1e-6:
        yield f"{axis.data.name} calibrating\n"
        yield Pause(min(LINE_S, end_s - board.now_s))
    fails = board.settings.home_fails and index == 1
    if fails or not axis.homing_done(board.now_s):
        axis.halt(board.now_s)
        if board.settings.stall_text:
            yield f"{axis.data.name} Motor Home Failure\n"
