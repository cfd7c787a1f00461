"""What such a console answers: where it points, and where it was sent (docs/reference/g2-kin.md, *Answers*)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from birdcage.base.errors import PositionUnknown
from birdcage.base.geometry import shortest_turn
from birdcage.base.reason import Reason
from birdcage.protocol.unhomed import is_unhomed, unreadable
from birdcage.rotator.values import Position

_DEGREES = r"[-+]?\d+(?:\.\d+)?(?=\s+[A-Za-z]|\s*$)"
"""A number with a word behind it, or nothing: what noise has cut in two is none."""
_ANGLE = re.compile(rf"Angle\[(\d)\]\s*=\s*({_DEGREES})")
_PLAUSIBLE = (-720.0, 720.0), (-90.0, 180.0)
"""Azimuth and elevation, wider than any dish turns: what lies outside is a misread number, not an angle."""


@dataclass(frozen=True, slots=True)
class MoveAnswer:
    """How a dish says where it was sent."""

    pattern: re.Pattern[str]
    """Group `angle`, and `motor` where it names that."""
    per_deg: int = 1
    """Of its numbers, how many are a degree."""

    def told(self, motor_id: int, lines: Iterable[str]) -> str | None:
        """Return the angle that the last such line names for a motor, as printed; None without one."""
        found = [match for match in map(self.pattern.search, lines) if match]
        own = [match["angle"] for match in found if match.groupdict().get("motor", str(motor_id)) == str(motor_id)]
        return own[-1] if own else None

    def shown(self, printed: str) -> str:
        """Return a printed angle in degrees, as a person reads it."""
        return printed if self.per_deg == 1 else f"{float(printed) / self.per_deg:.2f}"

    def confirms(self, printed: str, degrees: float, *, turns: bool) -> bool:
        """Return whether an angle was commanded, by its print: with its own decimals, and on any turn of the cable."""
        told_deg = float(printed) / self.per_deg
        off_deg = shortest_turn(degrees, told_deg) if turns else told_deg - degrees
        finest_deg = 10.0 ** -len(printed.partition(".")[2]) / self.per_deg
        return abs(off_deg) <= max(finest_deg, 0.01) + 0.001


ANGLE = MoveAnswer(re.compile(rf"Angle\s*=\s*(?P<angle>{_DEGREES})"))
"""`Angle = 46.00`: the angle that was commanded, before the motion is over."""


def angles_in(lines: Iterable[str]) -> Mapping[int, str]:
    """Return what `Angle[0] = 180.00` and `Angle[1] = 45.00` say, as printed, by motor."""
    return {int(match[1]): match[2] for match in _ANGLE.finditer(" ".join(lines))}


def position_of(lines: Iterable[str]) -> tuple[Position, float]:
    """Return where it points, and how fine its angles are printed, both in degrees.

    PositionUnknown (`unhomed`) for an axis that does not know where it is, UnreadablePosition unless both axes were
    printed as angles.
    """
    lines = tuple(lines)
    printed = angles_in(lines)
    angles = {axis: float(text) for axis, text in printed.items()}
    if set(angles) != {0, 1}:
        raise unreadable(f"The dish answered `a` with {' / '.join(lines)!r}, not two angles.", lines)
    if any(map(is_unhomed, angles.values())):
        raise PositionUnknown(
            "The dish is not homed, so it does not know where it points. Home it first.", reason=Reason.UNHOMED
        )
    if not all(low <= angles[axis] <= high for axis, (low, high) in enumerate(_PLAUSIBLE)):
        raise unreadable(f"The dish answered `a` with {' / '.join(lines)!r}: no such angles.", lines)
    finest_deg = max(10.0 ** -len(text.partition(".")[2]) for text in printed.values())
    return Position(angles[0], angles[1]), finest_deg
