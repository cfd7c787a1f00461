"""Reads `Kp=250 Kv=50`, with and without `Ki` and motor numbers (docs/reference/g2-commands.md, *STEP>*)."""

from __future__ import annotations

import re

from birdcage.console.events import Reply
from birdcage.protocol.g2.motor_values import Gains
from birdcage.protocol.g2.reading import NUMBER, garbage

_GAINS = re.compile(rf"\bKp\s*=\s*(?P<kp>{NUMBER})[ ,]+Kv\s*=\s*(?P<kv>{NUMBER})(?:[ ,]+Ki\s*=\s*(?P<ki>{NUMBER}))?")
_WHOSE = re.compile(r"\[\s*([01])\s*\]|\b(AZ)|\b(EL)")


def read_gains(reply: Reply) -> tuple[Gains, ...]:
    """Return the sets of gains in their order; NoReply (garbage) when there is none."""
    found: list[Gains] = []
    for line in reply.lines:
        end = 0
        for match in _GAINS.finditer(line):
            found.append(_gains(line[end : match.start()], match))
            end = match.end()
    if not found:
        raise garbage(reply)
    return tuple(found)


def _gains(before: str, match: re.Match[str]) -> Gains:
    whose, ki = _WHOSE.search(before), match["ki"]
    motor = None if whose is None else int(whose[1]) if whose[1] else 0 if whose[2] else 1
    return Gains(motor, float(match["kp"]), float(match["kv"]), None if ki is None else float(ki))
