"""The twin of the Starter: it keeps where its zero points, which only whoever stands beside it can see."""

from __future__ import annotations

import os
import select
import threading
import tty

from birdcage.base.clock import RealClock

from birdcage_toys.motor import Motor
from birdcage_toys.pushy_twin import PushyTwin
from birdcage_toys.starter import BOOT


class StarterTwin(PushyTwin):
    address = "starter"
    name = "starter"

    def __init__(self, clock, turn_deg=0.0, zero_az_deg=200.0):
        super().__init__(clock, turn_deg)
        self.zero_az_deg = zero_az_deg

    @property
    def points_az_deg(self):
        """Where the beam really points."""
        return (self.motors[0].deg + self.zero_az_deg) % 360.0

    def restart(self):
        """Lose the power for a moment: where it stands is its zero now."""
        self.zero_az_deg = self.points_az_deg
        self.motors[0] = Motor(self.clock, 0.0, 12.0)
        self._out.append((self.clock.monotonic(), f"{BOOT}\n"))


class StarterOnPty:
    """The same at a pseudo terminal, for programs of their own. Close it."""

    def __init__(self, turn_deg=0.0, zero_az_deg=200.0):
        self.twin = StarterTwin(RealClock(), turn_deg, zero_az_deg)
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self.path = os.ttyname(self._slave)
        self._ends = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self):
        while not self._ends.is_set():
            if select.select([self._master], [], [], 0.02)[0]:
                self.twin.write(os.read(self._master, 1000))
            os.write(self._master, self.twin.read())

    def close(self):
        self._ends.set()
        self._thread.join(5)
        os.close(self._slave)
        os.close(self._master)
