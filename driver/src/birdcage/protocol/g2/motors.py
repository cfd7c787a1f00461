"""The motor menu, `MOT>`: what it tells. Moving is the dialect's, through the gate.

Source: docs/reference/g2-commands.md, *MOT>*.

Only `elminmaxhome`, `mv` and the names of `l` are quoted. `p`, `v` and `ma` are read as `mv` is printed, by motor
number. A number with decimals is degrees, as with `a` and the settings memory; a whole angle is centidegrees, as in
`wrap_min:-42333` and in sweeps.
"""

from __future__ import annotations

import re
from typing import ClassVar

from birdcage.protocol.g2.gains import read_gains
from birdcage.protocol.g2.motor_values import Accelerations, ElevationLimits, Gains, MotorEntry, MotorSpeeds, StepCounts
from birdcage.protocol.g2.reading import END, NUMBER, by_motor, find, garbage, only_text, only_whole, search
from birdcage.protocol.g2.room import Room
from birdcage.protocol.unhomed import is_unhomed

_LIMITS = re.compile(rf"Min:\s*({NUMBER})\s+Max:\s*({NUMBER})\s+Home:\s*({NUMBER})")
_MOTOR = re.compile(r"(?<!\w)([01])\s*[=:)]\s*(AZIMUTH|ELEVATION)\b")
_STEPS = re.compile(rf"\bsteps?\s*[=:]\s*([-+]?\d+){END}", re.IGNORECASE)
_ANGLE = re.compile(rf"\bangle\s*[=:]\s*({NUMBER})", re.IGNORECASE)
_OVERFLOW = re.compile(r"\boverflow", re.IGNORECASE)
_STEEPEST_DEG = 180.0
"""More than any elevation setting: what is printed then is in no unit known here."""


class Motors(Room):
    """Reads the state of both motors."""

    menu: ClassVar[str] = "mot"

    def list(self) -> tuple[MotorEntry, ...]:
        """List the motors with what they do (`l`: `0=AZIMUTH`, `1=ELEVATION`)."""
        reply = self._run("l")
        text = "\n".join(reply.lines)
        heads = list(_MOTOR.finditer(text))
        if not heads:
            raise garbage(reply)
        ends = [head.start() for head in heads[1:]] + [len(text)]
        return tuple(
            MotorEntry(int(head[1]), head[2], text[head.end() : end].strip(" ,:-\n") or None)
            for head, end in zip(heads, ends, strict=True)
        )

    def steps(self) -> StepCounts:
        """Read the raw positions in microsteps (`p`)."""
        reply = self._run("p")
        raw = by_motor(reply)
        if "." in raw.azimuth + raw.elevation:
            raise garbage(reply)
        return StepCounts(*(None if is_unhomed(int(text)) else int(text) for text in (raw.azimuth, raw.elevation)))

    def velocities(self) -> MotorSpeeds:
        """Read how fast the axes turn now (`v`)."""
        raw = by_motor(self._run("v"))
        return MotorSpeeds(_degrees(raw.azimuth), _degrees(raw.elevation))

    def max_velocities(self) -> MotorSpeeds:
        """Read the greatest speeds (`mv`); those of `stepper`, in microsteps, are quoted with numbers."""
        raw = by_motor(self._run("mv"))
        return MotorSpeeds(_degrees(raw.azimuth), _degrees(raw.elevation))

    def max_accelerations(self) -> Accelerations:
        """Read the greatest accelerations (`ma`)."""
        raw = by_motor(self._run("ma"))
        return Accelerations(_degrees(raw.azimuth), _degrees(raw.elevation))

    def gains(self) -> tuple[Gains, ...]:
        """Read the gains of the control loops (`pid`)."""
        return read_gains(self._run("pid"))

    def life(self) -> tuple[str, ...]:
        """Read what use the motors have seen (`life`), as printed."""
        return self._run("life").lines

    def life_details(self) -> tuple[str, ...]:
        """Read what use the motors have seen, in detail (`motorlife`), as printed."""
        return self._run("motorlife").lines

    def elevation_limits(self) -> ElevationLimits:
        """Read the firmware's elevation limits and home in degrees (`elminmaxhome`)."""
        reply = self._run("elminmaxhome")
        low, high, home = (float(text) for text in find(reply, _LIMITS).groups())
        if not -_STEEPEST_DEG < low < high < _STEEPEST_DEG:
            raise garbage(reply)
        return ElevationLimits(low, high, home)

    def elevation_to_steps(self, angle_deg: float) -> int:
        """Ask how many microsteps an elevation is (`ela2s`)."""
        reply = self._run(f"ela2s {angle_deg:.2f}")
        named = search(reply, _STEPS)
        return int(named[1]) if named else only_whole(reply)

    def steps_to_elevation(self, steps: int) -> float | None:
        """Ask which elevation in degrees a count of microsteps is (`els2a`); None when the dish says overflow."""
        reply = self._run(f"els2a {steps}")
        if search(reply, _OVERFLOW):
            return None
        named = search(reply, _ANGLE)
        text = named[1] if named else only_text(reply)
        angle_deg = float(text) if "." in text else int(text) / 100.0
        if abs(angle_deg) > _STEEPEST_DEG:
            raise garbage(reply)
        return angle_deg


def _degrees(text: str) -> float | None:
    return float(text) if "." in text else None
