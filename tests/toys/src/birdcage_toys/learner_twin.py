"""What Learner's mechanics do, and what its library answers."""

from __future__ import annotations

import itertools

from birdcage.testing import SeenCommand, Truth, Twin

from birdcage_toys.learner import MACHINES
from birdcage_toys.motor import Motor

_numbers = itertools.count()


class LearnerTwin(Twin):
    def __init__(self, clock, az=(20.0, 340.0), el=(8.0, 72.0), speed_deg_s=9.0):
        self.clock, self.address = clock, f"learner:{next(_numbers)}"
        self.motors = [Motor(clock, 120.0, speed_deg_s), Motor(clock, 30.0, speed_deg_s)]
        self.calls = 0
        self.plugged, self.muted, self.heard, self._limits = True, False, [], (az, el)
        MACHINES[self.address] = self

    def truth(self):
        return Truth(*(motor.deg for motor in self.motors), any(motor.moving for motor in self.motors))

    def taken(self):
        return self.heard

    def received(self):
        return self.calls

    def unplug(self):
        self.plugged = False

    def plug(self):
        self.plugged = True

    def mute(self):
        self.muted = True

    def unmute(self):
        self.muted = False

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
