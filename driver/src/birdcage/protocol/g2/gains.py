"""Reads `Kp=250 Kv=50`, with and without `Ki` and motor numbers (reference section 7.3)."""

from __future__ import annotations

import re

from birdcage.console.events import Reply
from birdcage.protocol.g2.motor_values import Gains
from birdcage.protocol.g2.reading import NUMBER, garbage

_GAINS = re.compile(
    rf"(?:\[\s*(?P<motor>[01])\s*\]|(?P<az>\bAZ\w*)|(?P<el>\bEL\w*))?[^\n=]*?\bKp\s*=\s*(?P<kp>{NUMBER})[ ,]+"
    rf"Kv\s*=\s*(?P<kv>{NUMBER})(?:[ ,]+Ki\s*=\s*(?P<ki>{NUMBER}))?"
)


def read_gains(reply: Reply) -> tuple[Gains, ...]:
    """Return the sets of gains in their order; NoReply (garbage) when there is none."""
    found = [m for line in reply.lines for m in _GAINS.finditer(line)]
    if not found:
        raise garbage(reply)
    return tuple(_gains(match) for match in found)


def _gains(match: re.Match[str]) -> Gains:
    motor = int(match["motor"]) if match["motor"] else 0 if match["az"] else 1 if match["el"] else None
    ki = match["ki"]
    return Gains(motor, float(match["kp"]), float(match["kv"]), None if ki is None else float(ki))
