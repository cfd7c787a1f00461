"""Reads `Kp=250 Kv=50`, with and without `Ki` and motor numbers (docs/reference/g2-commands.md, *STEP>*)."""

from __future__ import annotations

import re

from birdcage.console.events import Reply
from birdcage.protocol.motors import AZIMUTH, ELEVATION
from birdcage.protocol.trk.reading import NUMBER, garbage, per_axis
from birdcage.rotator.feature import Value

_GAINS = re.compile(rf"\bKp\s*=\s*(?P<kp>{NUMBER})[ ,]+Kv\s*=\s*(?P<kv>{NUMBER})(?:[ ,]+Ki\s*=\s*(?P<ki>{NUMBER}))?")
_MOTOR = r"(?:\[\s*([01])\s*\]|\b(AZ)|\b(EL))"
_ANY_MOTOR = re.compile(_MOTOR)
_WHOSE = re.compile(rf"{_MOTOR}[^=\d]*$")
"""A motor right before its gains: another set whose names noise has damaged may stand between."""


def read_gains(reply: Reply, prefix: str = "") -> dict[str, Value]:
    """Return `kp`, `kv` and, where it is printed, `ki` by axis; one set without a motor stands for both.

    In the firmware's own units. NoReply (garbage) when there is none.
    """
    found: list[tuple[str, re.Match[str]]] = []
    for line in reply.lines:
        end = 0
        for match in _GAINS.finditer(line):
            found.append((line[end : match.start()], match))
            end = match.end()
    told: dict[str, Value] = {}
    for before, match in found:
        for name, text in match.groupdict().items():
            value = None if text is None else float(text)
            told |= per_axis(prefix + name, dict.fromkeys(_axes(before, alone=len(found) == 1), value))
    if not told:
        raise garbage(reply)
    return told


def _axes(before: str, *, alone: bool) -> tuple[str, ...]:
    """Return whose gains follow a text; none where that is not sure."""
    if whose := _WHOSE.search(before):
        return (AZIMUTH,) if whose[1] == "0" or whose[2] else (ELEVATION,)
    return (AZIMUTH, ELEVATION) if alone and not _ANY_MOTOR.search(before) else ()
