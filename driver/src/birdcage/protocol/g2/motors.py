"""The motor menu, `MOT>`: what it tells. Moving is the dialect's, through the gate.

Source: docs/reference/g2-commands.md, *MOT>*.

Only `elminmaxhome`, `mv` and the names of `l` are quoted. `p`, `v` and `ma` are read as `mv` is printed, by motor
number. A number with decimals is degrees, as with `a` and the settings memory; a whole angle is centidegrees, as in
`wrap_min:-42333` and in sweeps.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from decimal import Decimal
from typing import ClassVar

from birdcage.base.errors import CommandRefused
from birdcage.base.reason import Reason
from birdcage.protocol.g2.gains import read_gains
from birdcage.protocol.motors import MOTORS
from birdcage.protocol.trk.reading import END, NUMBER, by_motor, find, garbage, only_text, only_whole, per_axis, search
from birdcage.protocol.trk.room import Room
from birdcage.protocol.unhomed import is_unhomed
from birdcage.rotator.feature import Value

GAINS = ("kp", "kv", "ki")
"""Of a control loop, in the order in which `pid` takes them."""
FLOOR, CEILING, HOME = "floor", "ceiling", "home.elevation"
"""The features of the firmware's own elevations."""

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

    def states(self) -> dict[str, Value]:
        """List the motors (`l`: `0=AZIMUTH`, `1=ELEVATION`); return `motor` by axis, what each does, as printed."""
        reply = self._run("l")
        text = "\n".join(reply.lines)
        heads = list(_MOTOR.finditer(text))
        if not heads:
            raise garbage(reply)
        ends = [head.start() for head in heads[1:]] + [len(text)]
        states = {head[2]: text[head.end() : end].strip(" ,:-\n") for head, end in zip(heads, ends, strict=True)}
        return per_axis("motor", {name.lower(): state or None for name, state in states.items()})

    def steps(self) -> dict[str, Value]:
        """Read `steps` by axis, the raw positions in microsteps (`p`); none of an axis that is not homed."""
        reply = self._run("p")
        raw = by_motor(reply)
        if any("." in text for text in raw.values()):
            raise garbage(reply)
        return per_axis("steps", {axis: int(text) for axis, text in raw.items() if not is_unhomed(int(text))})

    def velocities(self) -> dict[str, Value]:
        """Read `velocity` by axis in deg/s: how fast each turns now (`v`)."""
        return per_axis("velocity", _degrees(by_motor(self._run("v"))))

    def max_velocities(self) -> dict[str, Value]:
        """Read `speed` by axis in deg/s, the greatest ones (`mv`); those of `stepper` are quoted with numbers."""
        return per_axis("speed", _degrees(by_motor(self._run("mv"))))

    def max_accelerations(self) -> dict[str, Value]:
        """Read `acceleration` by axis in deg/s², the greatest ones (`ma`)."""
        return per_axis("acceleration", _degrees(by_motor(self._run("ma"))))

    def gains(self) -> dict[str, Value]:
        """Read `kp`, `kv` and `ki` of the control loops by axis (`pid`)."""
        return read_gains(self._run("pid"))

    def set_gain(self, axis: str, name: str, value: float) -> dict[str, Value]:
        """Set one gain of an axis, `kp`, `kv` or `ki`, until the dish restarts (`pid <motor> <Kp> <Kv> <Ki>`).

        The line sets all three: the others are read first, and written as they were. Returns all gains, read back.

        NoReply (garbage, nothing written) where it does not tell all three of that axis, CommandRefused when it shows
        another value then.
        """
        reply = self._run("pid")
        told = read_gains(reply)
        before = [told.get(f"{each}.{axis}") for each in GAINS]
        if None in before:
            raise garbage(reply)
        wanted = dict(zip(GAINS, (float(gain) for gain in before if gain is not None), strict=True)) | {name: value}
        self._run(f"pid {MOTORS[axis]} " + " ".join(map(_plain, wanted.values())))
        now = self.gains()
        for each, gain in wanted.items():
            shown = now.get(f"{each}.{axis}")
            if shown is None or not math.isclose(float(shown), gain, rel_tol=1e-4, abs_tol=1e-3):
                raise CommandRefused(
                    f"The dish was told {each.capitalize()} {_plain(gain)} for the {axis} and shows "
                    f"{'none' if shown is None else _plain(float(shown))}. Set it again, or restart the dish: it "
                    "forgets gains then.",
                    reason=Reason.BAD_PARAMETER,
                )
        return now

    def life(self) -> tuple[str, ...]:
        """Read what use the motors have seen (`life`), as printed."""
        return self._run("life").lines

    def life_details(self) -> tuple[str, ...]:
        """Read what use the motors have seen, in detail (`motorlife`), as printed."""
        return self._run("motorlife").lines

    def elevation_limits(self) -> dict[str, Value]:
        """Read `floor`, `ceiling` and `home.elevation` in degrees (`elminmaxhome`): NVS 101, 102 and 103."""
        reply = self._run("elminmaxhome")
        low, high, home = (float(text) for text in find(reply, _LIMITS).groups())
        if not -_STEEPEST_DEG < low < high < _STEEPEST_DEG:
            raise garbage(reply)
        return {FLOOR: low, CEILING: high, HOME: home}

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


def _plain(number: float) -> str:
    """Return a number in digits, without an exponent: no source says that the dish takes one."""
    text = format(Decimal(repr(float(number))), "f")
    return text.rstrip("0").rstrip(".") if "." in text else text


def _degrees(printed: Mapping[str, str]) -> dict[str, Value]:
    """Return the numbers whose unit is certain: those with decimals."""
    return {axis: float(text) for axis, text in printed.items() if "." in text}
