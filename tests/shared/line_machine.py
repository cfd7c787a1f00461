"""A rotator that speaks in plain lines, as EasyComm controllers do: no prompt, no echo, no menus. Also its port."""

from __future__ import annotations

import math
import re
from collections import deque


class LineMachine:
    """`AZ EL` tells both axes, `AZ<deg>` turns one and is not answered, `SA SE` stops, `VE` tells who it is."""

    name = "line machine"
    demo = True

    def __init__(self, clock, line_end=b"\r\n"):
        self.clock, self.line_end = clock, line_end
        self.az_deg, self.el_deg = 180.0, 45.0
        self.written = b""
        self.heard = []
        """(time, line) of all that came."""
        self.gone = False
        self.silent = False
        self.latency_s = 0.02
        self._buffer = b""
        self._out = deque()
        self._push_every_s, self._push_at, self._pushed = 0.0, math.inf, b""

    # the port
    def fileno(self):
        return None

    def pending(self):
        self._run()
        return self.gone or (bool(self._out) and self._out[0][0] <= self.clock.monotonic())

    def next_event(self):
        self._run()
        return min(self._push_at, self._out[0][0] if self._out else math.inf)

    def read(self):
        if self.gone:
            raise OSError("unplugged")
        self._run()
        data = b""
        while self._out and self._out[0][0] <= self.clock.monotonic():
            data += self._out.popleft()[1]
        return data

    def write(self, data):
        if self.gone:
            raise OSError("unplugged")
        self.written += data
        *lines, self._buffer = re.split(rb"[\r\n]", self._buffer + data)
        for line in filter(None, lines):
            self._take(line.decode("ascii"))

    def discard(self):
        self._out.clear()

    def close(self):
        pass

    # the machine
    def say(self, data, in_s=0.0):
        """Print bytes at a time from now."""
        at = self.clock.monotonic() + in_s
        self._out.append((max(at, self._out[-1][0] if self._out else at), data))

    def push(self, text, every_s):
        """Print a line again and again, unasked."""
        self._pushed, self._push_every_s = text.encode() + self.line_end, every_s
        self._push_at = self.clock.monotonic() + every_s

    def _run(self):
        while self._push_at <= self.clock.monotonic():
            self._out.append((self._push_at, self._pushed))
            self._push_at += self._push_every_s

    def lines(self):
        return [line for _at, line in self.heard]

    def _take(self, line):
        self.heard.append((self.clock.monotonic(), line))
        if self.silent:
            return
        if line == "AZ EL":
            self._answer(f"AZ{self.az_deg:.1f} EL{self.el_deg:.1f}")
        elif line == "VE":
            self._answer("VE1.2")
        elif line == "GS":
            self._answer("GS2")
            self._answer("motors on")
        elif turned := re.fullmatch(r"(AZ|EL)(\d+(?:\.\d+)?)", line):
            setattr(self, f"{turned[1].lower()}_deg", float(turned[2]))
        elif line != "SA SE":
            self._answer("ERR unknown")

    def _answer(self, text):
        self.say(text.encode() + self.line_end, self.latency_s)
