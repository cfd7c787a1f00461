"""An axis that starts and stops at once: the mechanics of the twins."""

from __future__ import annotations

import math


class Motor:
    def __init__(self, clock, deg, speed_deg_s):
        self._clock, self._speed = clock, speed_deg_s
        self._from, self._to, self._since = deg, deg, clock.monotonic()

    @property
    def deg(self):
        way = self._to - self._from
        gone = self._speed * (self._clock.monotonic() - self._since)
        return self._to if gone >= abs(way) else self._from + math.copysign(gone, way)

    @property
    def moving(self):
        return self.deg != self._to

    def go(self, deg):
        self._from, self._to, self._since = self.deg, deg, self._clock.monotonic()

    def halt(self):
        self.go(self.deg)
