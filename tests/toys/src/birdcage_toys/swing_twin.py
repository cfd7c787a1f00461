"""What Swing's mechanics do, and what its library answers. The mount is turned here, and not calculated."""

from __future__ import annotations

import itertools
import threading
from math import asin, atan2, cos, degrees, radians, sin

from birdcage.testing import SeenCommand, Truth

from birdcage_toys.motor import Motor
from birdcage_toys.plugged_twin import PluggedTwin
from birdcage_toys.swing import MACHINES

_numbers = itertools.count()
DECLINATIONS = {48.0: -7.13, -33.0: 5.39}
"""What the arc is off the equator of the sky, by latitude: an orbit of 42164 km as seen from a globe of 6378 km."""


def turned(east, north, up, by_deg):
    """Return a direction turned about the east, from north upwards."""
    by = radians(by_deg)
    return east, north * cos(by) - up * sin(by), north * sin(by) + up * cos(by)


class SwingTwin(PluggedTwin):
    def __init__(self, clock, latitude_deg=48.0, hour_deg=-20.0, speed_deg_s=2.0):
        super().__init__(clock)
        self.address, self.latitude_deg = f"swing:{next(_numbers)}", latitude_deg
        self.motor = Motor(clock, hour_deg, speed_deg_s)
        self.free = threading.Event()
        """While it is not set, `halt` waits, as a real one does for its motor."""
        self.free.set()
        MACHINES[self.address] = self

    def direction(self):
        """Where the beam points: off the celestial pole by its declination, about the pole by the hour angle."""
        hour, declination = radians(self.motor.deg), radians(DECLINATIONS[self.latitude_deg])
        # As it stands on the North Pole: up is the axis, south is the meridian of the place.
        east, north, up = turned(
            -sin(hour) * cos(declination), -cos(hour) * cos(declination), sin(declination), self.latitude_deg - 90.0
        )
        return degrees(atan2(east, north)) % 360.0, degrees(asin(up))

    def truth(self):
        return Truth(*self.direction(), self.motor.moving)

    # its library
    def _answer(self):
        if not self.plugged:
            raise ConnectionError
        if self.muted:
            raise TimeoutError
        self.calls += 1

    def ping(self):
        self._answer()

    def turn(self, hour_deg):
        self._answer()
        self.motor.go(round(hour_deg, 1))
        self.heard.append(SeenCommand(self.clock.monotonic(), frozenset({0, 1})))

    def halt(self):
        self._answer()
        self.motor.halt()
        self.free.wait()
