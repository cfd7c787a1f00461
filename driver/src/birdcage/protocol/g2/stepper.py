"""The stepper menu, `STEP>`: motors in microsteps. Its `p` and `v` move and are not here.

Source: docs/reference/g2-commands.md, *STEP>*.
"""

from __future__ import annotations

import math
import re
from typing import ClassVar

from birdcage.base.errors import CommandRefused, MotionRefused
from birdcage.base.reason import Reason
from birdcage.console.events import Reply
from birdcage.protocol.g2.gains import read_gains
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.protocol.trk.reading import END, by_motor, per_axis
from birdcage.protocol.trk.room import Room
from birdcage.rotator.feature import Value

_MAX_VEL = re.compile(rf"Max Vel\s*\[(\d)\]\s*=\s*(\d+){END}")
_AXES = {axis.index: axis for axis in (CARRYOUT_G2.azimuth, CARRYOUT_G2.elevation)}


class Stepper(Room):
    """Speeds, accelerations and gains below the angles."""

    menu: ClassVar[str] = "step"

    def max_speeds_deg_s(self) -> dict[int, float]:
        """Read the greatest speeds in force by motor number (`mv`; 7222 of 40000 microsteps a turn are 65 deg/s)."""
        return _speeds(self._run("mv"))

    def set_max_speed(self, motor: int, speed_deg_s: float) -> dict[int, float]:
        """Set the greatest speed of one motor until the dish restarts (`mv <motor> <ustep/s>`), and read it back.

        MotionRefused (`speed`, nothing sent) outside the axis' range, CommandRefused when it shows another speed then.
        """
        axis = _AXES[motor]
        if not axis.step_deg <= speed_deg_s <= axis.speed_deg_s:
            raise MotionRefused(
                f"The {axis.name} can go at up to {axis.speed_deg_s:g}°/s and more than 0, not at {speed_deg_s:g}°/s. "
                "Nothing was sent.",
                reason=Reason.SPEED,
            )
        steps = math.floor(speed_deg_s / axis.step_deg + 1e-6)
        self._run(f"mv {motor} {steps}")
        speeds = self.max_speeds_deg_s()
        now = speeds.get(motor)
        if now is None or abs(now - steps * axis.step_deg) > 1.5 * axis.step_deg:
            shown = "none" if now is None else f"{now:.2f}°/s"
            raise CommandRefused(
                f"The dish was told {speed_deg_s:.2f}°/s for the {axis.name} and shows {shown}.",
                reason=Reason.BAD_PARAMETER,
            )
        return speeds

    def set_max_acceleration(self, motor: int, acceleration_deg_s2: float) -> dict[str, Value]:
        """Set the greatest acceleration of one motor until the dish restarts (`ma <motor> <ustep/s/ms>`), read it back.

        In deg/s²; the console takes whole microsteps/s/ms, so the nearest is set, at least 1. CommandRefused when it
        shows another one then.
        """
        axis = _AXES[motor]
        steps = max(1, round(acceleration_deg_s2 / axis.step_deg / 1000.0))
        self._run(f"ma {motor} {steps}")
        told = self.max_accelerations()
        now, wanted = told.get(f"acceleration.{axis.name}"), steps * 1000.0 * axis.step_deg
        if now is None or abs(float(now) - wanted) > 0.5 * 1000.0 * axis.step_deg:
            shown = "none" if now is None else f"{float(now):.1f}°/s²"
            raise CommandRefused(
                f"The dish was told {wanted:.1f}°/s² for the {axis.name} and shows {shown}.",
                reason=Reason.BAD_PARAMETER,
            )
        return told

    def max_accelerations(self) -> dict[str, Value]:
        """Read `acceleration`, the greatest ones (`ma`, in microsteps/s/ms: 44 are 396 deg/s²), by axis."""
        raw = by_motor(self._run("ma"))
        steps_deg = {axis.name: axis.step_deg for axis in _AXES.values()}
        return per_axis("acceleration", {axis: float(raw[axis]) * 1000.0 * steps_deg[axis] for axis in raw})

    def gains(self) -> dict[str, Value]:
        """Read `step_kp` and `step_kv` by axis (`pid`: `Kp=250 Kv=50`)."""
        return read_gains(self._run("pid"), "step_")


def _speeds(reply: Reply) -> dict[int, float]:
    found = [m for line in reply.lines for m in _MAX_VEL.finditer(line)]
    return {int(m[1]): int(m[2]) * _AXES[int(m[1])].step_deg for m in found if int(m[1]) in _AXES and int(m[2]) > 0}
