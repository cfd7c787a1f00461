"""What Learner's mechanics do, and what its library answers."""

from __future__ import annotations

import itertools

from birdcage.testing import SeenCommand, Truth

from birdcage_toys.learner import MACHINES
from birdcage_toys.motor import Motor
from birdcage_toys.plugged_twin import PluggedTwin

_numbers = itertools.count()


class LearnerTwin(PluggedTwin):
    def __init__(self, clock, az=(20.0, 340.0), el=(8.0, 72.0), speed_deg_s=9.0):
        super().__init__(clock)
        self.address, self._limits = f"learner:{next(_numbers)}", (az, el)
        self.motors = [Motor(clock, 120.0, speed_deg_s), Motor(clock, 30.0, speed_deg_s)]
        MACHINES[self.address] = self

    def truth(self):
        return Truth(*(motor.deg for motor in self.motors), any(motor.moving for motor in self.motors))

    # its library
    def _answer(self):
        self.calls += 1
        if not self.plugged:
            raise ConnectionError
        if self.muted:
            raise TimeoutError

    def limits(self):
        self._answer()
        return self._limits

    def angles(self):
        self._answer()
        return tuple(round(motor.deg, 2) for motor in self.motors)

    def go(self, sent):
        self._answer()
        for motor, deg in sent.items():
            self.motors[motor].go(deg)
        self.heard.append(SeenCommand(self.clock.monotonic(), frozenset(sent)))

    def halt(self):
        """Tells whether it was heard."""
        if not self.muted:
            for motor in self.motors:
                motor.halt()
        return not self.muted
