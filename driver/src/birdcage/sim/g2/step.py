"""The stepper menu, `STEP>` (docs/reference/g2-commands.md, *STEP>*): microsteps, microsteps/s, microsteps/s/ms."""

from __future__ import annotations

import math

from birdcage.sim.axis import AxisMechanics
from birdcage.sim.g2.board import G2Board
from birdcage.sim.g2.menu import G2Menu
from birdcage.sim.g2.mot_moves import FAR_DEG
from birdcage.sim.shell import Script
from birdcage.sim.trk.limits import motor as motor_number
from birdcage.sim.trk.limits import number


class StepMenu(G2Menu):
    """Below the angles: no limits, no homing asked for. What is set holds until the power goes or it reboots."""

    prompt = "STEP>"
    help_lines = (
        "help [<command>]",
        "e - Engage motors",
        "ma [motor] [ustep/sec/msec] - Max acceleration",
        "mv [motor] [ustep/sec] - Max velocity",
        "p [motor] [steps] - Go to position",
        "pid [motor] [Kp] [Kv] - PID values",
        "q",
        "r - Release motors",
        "v [motor] [ustep/sec] - Go to velocity",
    )

    def __init__(self, board: G2Board) -> None:
        super().__init__(board)
        self.commands |= {
            "e": self._engage,
            "ma": self._acceleration,
            "mv": self._velocity,
            "p": self._position,
            "pid": self._gains,
            "r": self._release,
            "v": self._spin,
        }

    def _engage(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.dish.engage(self.board.now_s)
        yield ""

    def _release(self, args: list[str]) -> Script:  # noqa: ARG002
        self.board.dish.release(self.board.now_s)
        yield ""

    def _velocity(self, args: list[str]) -> Script:
        axes = self.board.dish.axes
        if args:
            motor = self._motor(args)
            if motor is None or motor[1] <= 0:
                yield from self.bad_parameter()
                return
            motor[0].data.max_rate_deg_s = motor[1] * motor[0].step_deg
        for index, axis in enumerate(axes):
            # Rounded down: NVS 80 says 65.00 deg/s, which is 7222.2, and the dish prints 7222.
            yield f"Max Vel [{index}] = {int(axis.data.max_rate_deg_s / axis.step_deg + 1e-6)}\n"

    def _acceleration(self, args: list[str]) -> Script:
        axes = self.board.dish.axes
        if args:
            motor = self._motor(args)
            if motor is None or motor[1] <= 0:
                yield from self.bad_parameter()
                return
            motor[0].data.accel_deg_s2 = motor[1] * 1000.0 * motor[0].step_deg
        for index, axis in enumerate(axes):
            yield f"Accel[{index}] = {axis.data.accel_deg_s2 / axis.step_deg / 1000.0:.0f}\n"

    def _position(self, args: list[str]) -> Script:
        motor = self._motor(args)
        if motor is None:
            yield from self.bad_parameter()
            return
        axis, steps = motor
        axis.retarget(self.board.now_s, steps * axis.step_deg)

    def _spin(self, args: list[str]) -> Script:
        """Turn for ever: nothing but the mechanical stop ends it."""
        motor = self._motor(args)
        if motor is None:
            yield from self.bad_parameter()
            return
        axis, rate = motor[0], motor[1] * motor[0].step_deg
        if rate == 0:
            axis.brake(self.board.now_s)
        else:
            axis.retarget(self.board.now_s, math.copysign(FAR_DEG, rate), rate_deg_s=abs(rate))

    def _gains(self, args: list[str]) -> Script:
        """No Ki at this level (noted); both motors have the same unless they were told otherwise."""
        index = motor_number(args[0]) if args else 0
        values = [number(text) for text in args[1:]]
        if index is None or len(args) not in (0, 1, 3) or None in values:
            yield from self.bad_parameter()
            return
        if values:
            self.board.gains[index][:2] = [value for value in values if value is not None]
        yield "Kp={:g} Kv={:g}\n".format(*self.board.gains[index][:2])

    def _motor(self, args: list[str]) -> tuple[AxisMechanics, float] | None:
        """Return the axis and the number of `<motor> <number>`; None when it is not that."""
        value = number(args[1]) if len(args) == 2 else None
        index = motor_number(args[0]) if args else None
        return None if value is None or index is None else (self.board.dish.axes[index], value)
