"""The commands of `MOT>` that say where an axis is, beside `h`: `sp`, `sw` and `w`.

Source: docs/reference/g2-commands.md, *MOT>*.
"""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.shell import Script
from birdcage.sim.trk.limits import motor, number


def set_position(board: G2Board, args: list[str]) -> Script | None:
    """`sp [motor] [pos]`: believe that it stands here; the shaft does not move, and the limits move with the count."""
    given = _given(board, args)
    return None if given is None else _believe(board, *given)


def _believe(board: G2Board, index: int, position_deg: float) -> Script:
    axis = board.dish.axes[index]
    axis.redefine(board.now_s, position_deg)
    axis.homed = axis.homed or board.settings.sp_homes
    yield f"Position[{index}] = {round(axis.count(board.now_s)[0] / axis.step_deg)}\n"


def set_wrap(board: G2Board, args: list[str]) -> Script | None:
    """`sw [motor] [pos]`: take this to be a certain turn of the cable; the limits of the wrap manager follow."""
    given = _given(board, args)
    return None if given is None else _shift(board, *given)


def _shift(board: G2Board, index: int, position_deg: float) -> Script:
    board.wrap_shift_deg[index] = position_deg - board.dish.axes[index].count(board.now_s)[0]
    yield board.wrap_text() if index == 0 else ""


def wrap_manager(board: G2Board, args: list[str]) -> Script | None:
    """`w [motor] [ON/OFF]`: show, or have the firmware keep the cable's limit or not. The elevation has no cable."""
    index = motor(args[0]) if args else None
    if (args and index is None) or len(args) > 2 or (len(args) == 2 and args[1].upper() not in ("ON", "OFF")):
        return None
    if index is not None and len(args) == 2:
        board.wrap_managed[index] = args[1].upper() == "ON"
    return _manager(board, (0, 1) if index is None else (index,))


def _manager(board: G2Board, which: tuple[int, ...]) -> Script:
    for index in which:
        yield f"Wrap[{index}] = {'ON' if board.wrap_managed[index] else 'OFF'}\n"


def _given(board: G2Board, args: list[str]) -> tuple[int, float] | None:
    """Read a motor and a position (setting `position_unit`)."""
    index = motor(args[0]) if len(args) == 2 else None
    position = number(args[1]) if len(args) == 2 else None
    if index is None or position is None:
        return None
    units = {"deg": 1.0, "cdeg": 0.01, "steps": board.dish.axes[index].step_deg}
    return index, position * units[board.settings.position_unit]
