"""What Pushy's mechanics do, and its end of the wire."""

from __future__ import annotations

import math
from collections import deque

from birdcage.base.errors import LinkError
from birdcage.base.reason import Reason
from birdcage.link.link import Link
from birdcage.testing import SeenCommand, Truth

from birdcage_toys.motor import Motor
from birdcage_toys.plugged_twin import PluggedTwin

EVERY_S = 0.2
LATENCY_S = 0.05


class PushyTwin(PluggedTwin):
    address = "pushy"
    name, demo = "pushy", True

    def __init__(self, clock, turn_deg=100.0):
        super().__init__(clock)
        self.motors = [Motor(clock, turn_deg, 12.0), Motor(clock, 30.0, 12.0)]
        self.sent_to = []
        self.lamp, self.supply_v = 0, 12.1
        self._out, self._push_at, self._buffer = deque(), clock.monotonic(), b""

    def truth(self):
        return Truth(*(motor.deg for motor in self.motors), any(motor.moving for motor in self.motors))

    def mute(self):
        super().mute()
        self._out.clear()

    def unmute(self):
        super().unmute()
        self._push_at = self.clock.monotonic() + EVERY_S

    def dial(self, address, baud):
        if not self.plugged:
            raise LinkError("pushy is not plugged in", reason=Reason.MISSING)
        self._push_at, self._buffer = self.clock.monotonic() + EVERY_S, b""
        self._out.clear()
        return Link(self, self.clock)

    # its end of the wire
    def _check(self):
        if not self.plugged:
            raise OSError("unplugged")

    def _run(self):
        while not self.muted and self._push_at <= self.clock.monotonic():
            self._out.append((self._push_at, "P {:.2f} {:.2f}\n".format(*(motor.deg for motor in self.motors))))
            self._push_at += EVERY_S
        self._out = deque(sorted(self._out))

    def fileno(self):
        return None

    def pending(self):
        self._run()
        return not self.plugged or bool(self._out and self._out[0][0] <= self.clock.monotonic())

    def next_event(self):
        if not self.plugged:
            return -math.inf
        return min([math.inf if self.muted else self._push_at, *(at for at, _ in self._out)])

    def read(self):
        self._check()
        self._run()
        ready = ""
        while self._out and self._out[0][0] <= self.clock.monotonic():
            ready += self._out.popleft()[1]
        return ready.encode()

    def write(self, data):
        self._check()
        *lines, self._buffer = (self._buffer + data).split(b"\n")
        for line in lines if not self.muted else ():
            self._take(line.decode().split())

    def _take(self, words):
        self._run()
        self.calls += 1
        if words[0] in "LV":
            self.lamp = int(words[1]) if words[1:] else self.lamp
            told = f"L {self.lamp}\n" if words[0] == "L" else f"V {self.supply_v}\n"
            self._out.append((self.clock.monotonic() + LATENCY_S, told))
            return
        sent = {int(words[1]): float(words[2])} if words[0] == "G" else dict(enumerate(map(float, words[1:])))
        for motor, deg in sent.items():
            self.motors[motor].go(deg)
        if words[0] == "G":
            self.heard.append(SeenCommand(self.clock.monotonic(), frozenset(sent)))
            self.sent_to.append(sent)
        self._out.append((self.clock.monotonic() + LATENCY_S, "K\n" if words[0] == "G" else "S\n"))

    def discard(self):
        self._out.clear()

    def close(self):
        pass
