"""The motor menu, `MOT>` (reference section 7.4). Most commands whose reply no source quotes are not there.

The lines of `p`, `v`, `ma`, `l` and `life` are [I], made like those of `a` and `mv`.
"""

from __future__ import annotations

from birdcage.sim.axis import Axis
from birdcage.sim.g2.board import INT_MAX, Board, number
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.shell import Die, Pause, Script

NAMES = ("AZIMUTH", "ELEVATION")


class Mot(G2Menu):
    """Angles, homing, current."""

    prompt = "MOT>"
    help_lines = (
        "help [<command>]",
        "a [<motor> <angle>]",
        "e",
        "elminmaxhome",
        "h <motor>",
        "l",
        "life",
        "ma",
        "mv",
        "p",
        "q",
        "r",
        "v",
    )

    def __init__(self, board: Board) -> None:
        super().__init__(board)
        self.commands |= {
            "a": self._angle,
            "h": self._home,
            "e": self._engage,
            "r": self._release,
            "l": self._list,
            "life": self._life,
            "ma": self._max_acceleration,
            "mv": self._max_velocity,
            "p": self._steps,
            "v": self._velocity,
            "elminmaxhome": self._el_limits,
        }

    def _angle(self, args: list[str]) -> Script:
        if not args:
            yield "".join(f"Angle[{index}] = {self._reported(index)}\n" for index in (0, 1))
            return
        wanted = number(args[1]) if len(args) == 2 else None
        if args[0] not in ("0", "1") or wanted is None:
            yield from self.bad_parameter()
            return
        index = int(args[0])
        axis = self.board.dish.axes[index]
        if not axis.homed:
            yield from self._unhomed(axis)
            return
        if self.board.settings.signed == "relative" and args[1][0] in "+-":
            base = axis.ordered_deg() if axis.moving(self.board.now_s) else axis.count(self.board.now_s)[0]
            wanted += base % 360.0 if index == 0 else base
        yield from self._go(index, wanted)

    def _go(self, index: int, wanted: float) -> Script:
        target = self._az_target(wanted) if index == 0 else self._el_target(wanted)
        if target is None:
            yield f"{self.board.settings.out_of_range_text}\n"
            return
        axis = self.board.dish.axes[index]
        policy = self.board.settings.second_move
        if axis.moving(self.board.now_s) and policy == "refuse":
            yield f"{self.board.settings.busy_text}\n"
            return
        if axis.moving(self.board.now_s) and policy == "block":
            yield Pause(axis.end_s() - self.board.now_s)
        if policy == "queue":
            axis.queue(self.board.now_s, target)
        else:
            axis.retarget(self.board.now_s, target)
        shown = target if index == 1 or self.board.settings.out_of_range == "clamp" else wanted
        yield f"Angle = {wanted if index == 0 else shown:.2f}\n"

    def _az_target(self, wanted: float) -> float | None:
        settings = self.board.settings
        if not settings.az_outside and not 0.0 <= wanted <= 360.0:
            return None
        return self.board.dish.cable_target(self.board.now_s, wanted)

    def _el_target(self, wanted: float) -> float | None:
        low, high = self.board.nvram.active[101], self.board.nvram.active[102]
        if low <= wanted <= high:
            return wanted
        return min(max(wanted, low), high) if self.board.settings.out_of_range == "clamp" else None

    def _reported(self, index: int) -> str:
        axis = self.board.dish.axes[index]
        if not axis.homed:
            return self.board.settings.unhomed_angle
        centideg = round(axis.count(self.board.now_s)[0] * 100)
        if index == 0 and self.board.settings.az_print == "wrapped":
            centideg %= 36000
        return f"{centideg / 100:.2f}"

    def _unhomed(self, axis: Axis) -> Script:
        if self.board.settings.unhomed_move == "deadlock":
            yield Die()
        yield f"Step to Position {axis.data.name} angle error: {INT_MAX}\n"

    def _home(self, args: list[str]) -> Script:
        which = {"0": (0,), "1": (1,), "*": (1, 0)}.get(args[0]) if len(args) == 1 else None
        if which is None:
            yield from self.bad_parameter()
            return
        for index in which:
            yield from home(self.board, index)

    def _engage(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.dish.engage(self.board.now_s)
        yield ""

    def _release(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.dish.release(self.board.now_s)
        yield ""

    def _max_velocity(self, args: list[str]) -> Script:
        if args:
            yield from self.bad_parameter()
            return
        for index, axis in enumerate(self.board.dish.axes):
            yield f"Max Vel [{index}] = {axis.data.max_rate_deg_s:.2f}\n"

    def _max_acceleration(self, args: list[str]) -> Script:
        if args:
            yield from self.bad_parameter()
            return
        for index, axis in enumerate(self.board.dish.axes):
            yield f"Max Accel [{index}] = {axis.data.accel_deg_s2:.2f}\n"

    def _steps(self, args: list[str]) -> Script:  # noqa: ARG002
        for index, axis in enumerate(self.board.dish.axes):
            steps = round(axis.count(self.board.now_s)[0] / axis.step_deg) if axis.homed else INT_MAX
            yield f"Position[{index}] = {steps}\n"

    def _velocity(self, args: list[str]) -> Script:  # noqa: ARG002
        for index, axis in enumerate(self.board.dish.axes):
            yield f"Velocity[{index}] = {axis.count(self.board.now_s)[1]:.2f}\n"

    def _list(self, args: list[str]) -> Script:  # noqa: ARG002
        for index, axis in enumerate(self.board.dish.axes):
            moving = axis.moving(self.board.now_s)
            state = "RELEASED" if axis.released else "MOVING" if moving else "HOLDING"
            yield f"{index}={NAMES[index]} {state}\n"

    def _life(self, args: list[str]) -> Script:  # noqa: ARG002
        for index, axis in enumerate(self.board.dish.axes):
            yield f"{NAMES[index]} moves: {axis.orders}\n"

    def _el_limits(self, args: list[str]) -> Script:  # noqa: ARG002
        row = self.board.nvram.active
        yield f"Min: {row[101]:.2f} Max: {row[102]:.2f} Home: {row[103]:.2f}\n"


def home(board: Board, index: int) -> Script:
    """Home one axis: blocks until done or timed out, then prints what the firmware prints."""
    axis = board.dish.axes[index]
    if axis.released:
        board.dish.engage(board.now_s)
    yield Pause(axis.home(board.now_s) - board.now_s)
    if not axis.homing_done(board.now_s):
        yield f"{axis.data.name} Motor Home Failure\n"
    elif index == 0:
        centideg = round(axis.count(board.now_s)[0] * 100)
        low, high = round(axis.data.low_deg * 100), round(axis.data.high_deg * 100)
        yield f"wrap_min:{low} wrap_max:{high}\nAZ - Angle: {centideg} Wrap: 0\n"
