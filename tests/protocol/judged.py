"""A dialect whose raw lines are judged with the gate of its antenna, as a person at the console gets to see it."""

from __future__ import annotations

from birdcage.antenna.gate import MotionGate
from birdcage.antenna.raw_limits import limited


class Judged:
    """`judge` of a dialect at a position."""

    def __init__(self, protocol, position):
        self.protocol = protocol
        self.commands, self.only_asks = protocol.commands, protocol.only_asks
        self.gate = MotionGate(protocol.model)
        self.gate.see(position)

    def judge(self, line, menu, *, homed):
        """Return the verdict of a line."""
        return limited(self.protocol.judge(line, menu, homed=homed), self.gate)
