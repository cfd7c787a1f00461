"""The command `a` of `MOT>`: where the axes stand, and where one is to go (docs/reference/g2-motors.md)."""

from __future__ import annotations

from birdcage.sim.shell import Pause, Script
from birdcage.sim.trk.limits import MotorBoard, motor, number, target, unhomed


def reported(board: MotorBoard, index: int) -> str:
    """Print where an axis believes to be, as `a` does."""
    axis = board.dish.axes[index]
    if not axis.homed:
        return board.settings.unhomed_angle
    centideg = round(axis.count(board.now_s)[0] * 100)
    if index == 0 and board.settings.az_print == "wrapped":
        centideg %= 36000
    return f"{centideg / 100:.2f}"


def angle(board: MotorBoard, args: list[str]) -> Script | None:
    """`a`: show both angles, or move one axis; None when the arguments are no good."""
    if not args:
        return show(board)
    wanted = number(args[1]) if len(args) == 2 else None
    index = motor(args[0])
    if index is None or wanted is None:
        return None
    axis = board.dish.axes[index]
    if not axis.homed:
        return unhomed(board, axis)
    if board.settings.signed == "relative" and args[1][0] in "+-":
        base = axis.ordered_deg() if board.now_s < axis.end_s() else axis.count(board.now_s)[0]
        wanted += base % 360.0 if index == 0 else base
    return _one(board, index, wanted)


def show(board: MotorBoard) -> Script:
    """Print both angles."""
    yield "".join(f"Angle[{index}] = {reported(board, index)}\n" for index in (0, 1))


def _one(board: MotorBoard, index: int, wanted: float) -> Script:
    goal = target(board, index, wanted)
    if goal is None:
        yield f"{board.settings.out_of_range_text}\n"
        return
    axis = board.dish.axes[index]
    policy = board.settings.second_move
    if axis.moving(board.now_s) and policy == "refuse":
        yield f"{board.settings.busy_text}\n"
        return
    if (waits_s := _waits_s(board, index)) > 0.0:
        yield Pause(waits_s)
    if policy == "queue":
        axis.queue(board.now_s, goal)
    elif policy == "in_turn":
        axis.queue(board.now_s, goal, not_before_s=max(each.end_s() for each in board.dish.axes))
    else:
        axis.retarget(board.now_s, goal)
    yield taken(board, index, wanted if index == 0 else goal)


def _waits_s(board: MotorBoard, index: int) -> float:
    """Return how long the shell blocks before an axis takes its next command."""
    settings, now_s = board.settings, board.now_s
    same, other = settings.second_move == "block", settings.second_other == "block"
    ends = (each.end_s() for at, each in enumerate(board.dish.axes) if (same if at == index else other))
    return max((end_s - now_s for end_s in ends), default=0.0)


def taken(board: MotorBoard, index: int, deg: float) -> str:
    """Return what is answered to the command of a move (setting `move_reply`)."""
    match board.settings.move_reply:
        case "none":
            return ""
        case "np":
            return f"m {index}  a {round(deg * 100)}  np {round(deg * board.settings.np_per_deg)}\n"
        case _:
            return f"Angle = {deg:.2f}\n"
