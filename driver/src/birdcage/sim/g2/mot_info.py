"""The commands of `MOT>` that only tell (docs/reference/g2-commands.md, *MOT>*).

`mv` and `elminmaxhome` are quoted (noted), and `0=AZIMUTH`, `1=ELEVATION` of `l`. What the others tell is noted,
their lines are assumed, made like these.
"""

from __future__ import annotations

from birdcage.sim.g2.board import G2Board
from birdcage.sim.shell import Script
from birdcage.sim.trk.limits import INT_MAX, motor, number

NAMES = ("AZIMUTH", "ELEVATION")


def motors(board: G2Board) -> Script:
    """`l`: the motors and their states."""
    for index, axis in enumerate(board.dish.axes):
        moving = axis.moving(board.now_s)
        yield f"{index}={NAMES[index]} {'RELEASED' if axis.released else 'MOVING' if moving else 'HOLDING'}\n"


def life(board: G2Board) -> Script:
    """`life`: how often and how far each motor has turned."""
    for name, axis in zip(NAMES, board.dish.axes, strict=True):
        yield f"{name} moves: {axis.orders}\n{name} degrees: {axis.wear(board.now_s)[0]:.0f}\n"


def motor_life(board: G2Board) -> Script:
    """`motorlife`: the same in full."""
    for name, axis in zip(NAMES, board.dish.axes, strict=True):
        degrees, seconds = axis.wear(board.now_s)
        yield f"{name} moves: {axis.orders} homings: {axis.homings}\n"
        yield f"{name} degrees: {degrees:.2f} steps: {degrees / axis.step_deg:.0f} seconds: {seconds:.1f}\n"


def accelerations(board: G2Board) -> Script:
    """`ma`: in degrees per second squared."""
    for index, axis in enumerate(board.dish.axes):
        yield f"Max Accel [{index}] = {axis.data.accel_deg_s2:.2f}\n"


def speeds(board: G2Board) -> Script:
    """`mv`: in degrees per second."""
    for index, axis in enumerate(board.dish.axes):
        yield f"Max Vel [{index}] = {axis.data.max_rate_deg_s:.2f}\n"


def steps(board: G2Board) -> Script:
    """`p`: raw step positions."""
    for index, axis in enumerate(board.dish.axes):
        count = round(axis.count(board.now_s)[0] / axis.step_deg) if axis.homed else INT_MAX
        yield f"Position[{index}] = {count}\n"


def velocities(board: G2Board) -> Script:
    """`v`: how fast the motors turn, in degrees per second."""
    for index, axis in enumerate(board.dish.axes):
        yield f"Velocity[{index}] = {axis.count(board.now_s)[1]:.2f}\n"


def el_limits(board: G2Board) -> Script:
    """`elminmaxhome`: NVS 101, 102 and 103."""
    row = board.nvram.active
    yield f"Min: {row[101]:.2f} Max: {row[102]:.2f} Home: {row[103]:.2f}\n"


def el_to_steps(board: G2Board, args: list[str]) -> Script | None:
    """`ela2s <deg>`: centidegrees inside (noted)."""
    angle = number(args[0]) if len(args) == 1 else None
    if angle is None:
        return None
    centideg = round(angle * 100)
    return _line(f"Angle: {centideg} Steps: {round(centideg / 100 / board.dish.axes[1].step_deg)}\n")


def steps_to_el(board: G2Board, args: list[str]) -> Script | None:
    """`els2a <steps>`: reports overflow when out of range (noted; setting `els2a_most`)."""
    count = number(args[0]) if len(args) == 1 else None
    if count is None or count != int(count):
        return None
    if abs(count) > board.settings.els2a_most:
        return _line(f"Steps: {count:.0f} overflow\n")
    return _line(f"Steps: {count:.0f} Angle: {round(count * board.dish.axes[1].step_deg * 100)}\n")


def gains(board: G2Board, args: list[str]) -> Script | None:
    """`pid [motor] [Kp] [Kv] [Ki]`: show or set, until the next power-on; the motion does not change."""
    index = motor(args[0]) if args else None
    values = [number(text) for text in args[1:]]
    if (args and index is None) or len(args) not in (0, 1, 4) or None in values:
        return None
    if index is not None and values:
        board.gains[index] = [value for value in values if value is not None]
    return _gains(board, (0, 1) if index is None else (index,))


def _gains(board: G2Board, which: tuple[int, ...]) -> Script:
    for index in which:
        yield "PID[{}] Kp={:g} Kv={:g} Ki={:g}\n".format(index, *board.gains[index])


def _line(text: str) -> Script:
    yield text
