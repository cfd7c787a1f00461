"""A station with the motor test, at a simulated dish, and where that dish really went."""

from __future__ import annotations

from birdcage.diagnostics.motor_test_records import MotorTestBook
from birdcage.diagnostics.motor_test_task import KIND, MotorTests
from birdcage.station.events import TaskChanged
from birdcage.station.requests import BeginTask

from tests.station.conftest import Bench

LATE = "latency_min=0.02&latency_max=0.1"
"""What a slow adapter makes of each answer."""


class MotorBench(Bench):
    """`begin` a test, `end` it, and look at `seen`: the true cable and elevation every 10 ms."""

    def __init__(self, options="", journal=None, firmware="g2", **rules):
        self.tests = MotorTests(MotorTestBook(journal))
        super().__init__(f"{firmware}?{options or 'seed=1'}", {"tasks": self.tests.tasks, **rules}, firmware=firmware)
        self.tests.attach(self.station)
        self.seen = []
        self.connect(6.0)

    def set_motors(self, *figures):
        """Set the true speed and acceleration of each axis."""
        for axis, (speed, acceleration) in zip(self.device.dish.axes, figures, strict=False):
            axis.data.max_rate_deg_s, axis.data.accel_deg_s2 = speed, acceleration

    def begin(self, **values):
        self.do(BeginTask(KIND, values, "you"))

    def look(self, seconds):
        for _ in range(round(seconds / 0.01)):
            self.step(0.01)
            truth = self.device.truth()
            self.seen.append((truth.cable_deg, truth.el_deg))

    def end(self, seconds=200.0):
        until = self.clock.monotonic() + seconds
        while self.state.tasks and self.clock.monotonic() < until:
            self.step(0.5)
        return self.last

    @property
    def last(self):
        return [event.task for event in self.events if isinstance(event, TaskChanged)][-1]

    def turn_until(self, there, seconds=60.0):
        """Go on until the true cable angle and elevation are somewhere."""
        until = self.clock.monotonic() + seconds
        while self.clock.monotonic() < until:
            self.step(0.01)
            truth = self.device.truth()
            if there(truth):
                return truth
        raise AssertionError("it never got there")
