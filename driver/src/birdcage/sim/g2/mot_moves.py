"""The commands of `MOT>` that move (docs/reference/g2-motors.md) beside `a`: `g`, `vms`, `motorboth` and `sd`.

The arguments are quoted (noted); but for `a`, what is printed and how the shell waits is assumed or a setting.
"""

from __future__ import annotations

from birdcage.sim.axis import STALL_DWELL_S, AxisMechanics
from birdcage.sim.g2.board import G2Board
from birdcage.sim.shell import Listen, Pause, Script
from birdcage.sim.trk.limits import motor, number, target, unhomed
from birdcage.sim.trk.moves import show

FAR_DEG = 1e6
"""Farther than any stop: an axis that is told to spin goes there."""


def both(board: G2Board, args: list[str]) -> Script | None:
    """`g <az> <el>`: both axes at once; the shell listens, and any byte breaks the move off.

    Source: docs/reference/consoles.md, *Moving*.
    """
    wanted = [number(text) for text in args]
    if len(wanted) != 2 or wanted[0] is None or wanted[1] is None:
        return None
    return _go(board, wanted[0], wanted[1])


def _go(board: G2Board, az_deg: float, el_deg: float) -> Script:
    axes = board.dish.axes
    for axis in axes:
        if not axis.homed:
            yield from unhomed(board, axis)
            return
    goals = target(board, 0, az_deg), target(board, 1, el_deg)
    if goals[0] is None or goals[1] is None:
        yield f"{board.settings.out_of_range_text}\n"
        return
    for axis, goal in zip(axes, goals, strict=True):
        axis.retarget(board.now_s, goal or 0.0)
    key = yield Listen(max(axis.end_s() for axis in axes) - board.now_s)
    if key:
        for axis in axes:
            axis.brake(board.now_s)
    if board.settings.g_reply == "angles":
        yield from show(board)


def velocity(board: G2Board, args: list[str]) -> Script | None:
    """`vms [motor] [deg_per_rev] [ms]`: spin for so long, inside the limits; the second is read as deg/s."""
    numbers = [number(text) for text in args[1:]]
    index = motor(args[0]) if args else None
    if index is None or len(numbers) != 2 or numbers[0] is None or numbers[1] is None or numbers[1] < 0:
        return None
    return _spin(board, index, numbers[0], numbers[1] / 1000.0)


def _spin(board: G2Board, index: int, rate_deg_s: float, seconds: float) -> Script:
    axis = board.dish.axes[index]
    end_s = board.now_s + seconds
    if rate_deg_s:
        low, high = board.bounds(index) if axis.homed else (-FAR_DEG, FAR_DEG)
        axis.retarget(
            board.now_s, min(high, FAR_DEG) if rate_deg_s > 0 else max(low, -FAR_DEG), rate_deg_s=abs(rate_deg_s)
        )
        _brake_at(board, axis, end_s)
    if board.settings.vms_blocks:
        yield Pause(seconds)
    else:
        yield ""


def _brake_at(board: G2Board, axis: AxisMechanics, end_s: float) -> None:
    order = axis.orders

    def brake() -> None:
        if axis.orders == order and axis.moving(board.now_s):
            axis.brake(board.now_s)

    board.machine.at_dish(end_s, brake)


def test_both(board: G2Board, args: list[str]) -> Script | None:
    """`motorboth`: turn both motors out and back at the same time; nothing listens meanwhile."""
    return None if args else _out_and_back(board)


def _out_and_back(board: G2Board) -> Script:
    axes = board.dish.axes
    for axis in axes:
        if not axis.homed:
            yield from unhomed(board, axis)
            return
    starts = [axis.count(board.now_s)[0] for axis in axes]
    outs = []
    for index, start in enumerate(starts):
        low, high = board.bounds(index)
        by = board.settings.motorboth_deg
        outs.append(min(start + by, high) if start + by <= high else max(start - by, low))
    for goals in (outs, starts):
        for axis, goal in zip(axes, goals, strict=True):
            axis.retarget(board.now_s, goal)
        yield Pause(max(*(axis.end_s() for axis in axes), board.now_s) - board.now_s)


def stall_test(board: G2Board, args: list[str]) -> Script | None:
    """`sd [motor] [direction] [timeout]`: run until it stalls; direction 1, or 0 or -1 for back; milliseconds."""
    index = motor(args[0]) if len(args) == 3 else None
    timeout = number(args[2]) if len(args) == 3 else None
    if index is None or timeout is None or timeout <= 0 or args[1] not in ("1", "+1", "0", "-1"):
        return None
    return _until_stall(board, index, 1 if args[1] in ("1", "+1") else -1, timeout / 1000.0)


def _until_stall(board: G2Board, index: int, direction: int, seconds: float) -> Script:
    axis = board.dish.axes[index]
    axis.retarget(board.now_s, direction * FAR_DEG, rate_deg_s=axis.data.homing_rate_deg_s)
    struck_s = axis.end_s()
    end_s = min(struck_s, board.now_s + seconds)
    yield Pause(end_s - board.now_s)
    if end_s < struck_s:
        axis.brake(board.now_s)
        yield f"{axis.data.name} - No stall\n"
    elif axis.released:
        yield f"{axis.data.name} MOTOR STALLED\n"
    elif axis.stalled:
        yield Pause(STALL_DWELL_S)  # blocked or at a stop, the motor says so by itself
