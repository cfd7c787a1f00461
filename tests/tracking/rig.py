"""A dish in closed form and a link with a latency, to try controllers on without any console: times are exact."""

from __future__ import annotations

import random
from dataclasses import dataclass, field, replace

import numpy as np
from birdcage.antenna.motion import plan_axis
from birdcage.base.geometry import separation
from birdcage.kinematics import Slew
from birdcage.protocol.g2.model import CARRYOUT_G2
from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.curve import Curve
from birdcage.tracking.steps import LimitSpeeds, ReadPosition, Send, StepResult, Wait

REPLY_S = 0.0026
"""The answer on its way, at 115200 baud."""

LATE_S = 0.15
"""What is waited for the answer to a line of a stream."""
DELAY_S = 2.0
LINES = 8
"""Menus there and back, two speeds set and read back."""


def straight(az_rate, el_rate, *, seconds=120.0, az_deg=100.0, el_deg=30.0, start_s=1000.0):
    """A course at constant rates."""
    t = start_s + np.arange(0.0, seconds + 1.0, 1.0)
    return Curve(t, az_deg + az_rate * (t - start_s), el_deg + el_rate * (t - start_s))


@dataclass
class Rig:
    """Drives a controller. `mode`: retarget (prompt at once), blocking (prompt after the move), queue."""

    course: Curve
    model: object = CARRYOUT_G2
    mode: str = "retarget"
    latency: tuple[float, float] = (0.02, 0.1)
    lost: float = 0.0
    """Part of the moves that the dish never gets."""
    unanswered: float = 0.0
    """Part of the lines whose answers are lost: a stream goes on soon, any other exchange waits for a quiet line."""
    early_s: float = 0.0
    """How long before the course begins it starts."""
    seed: int = 1
    tells: bool = True
    steps: list = field(default_factory=list)
    """(when it was yielded, step)."""
    largest_backlog: int = 0

    def __post_init__(self):
        self.now = self.course.start_s - self.early_s
        self.quiet_at = self.now
        self.random = random.Random(self.seed)
        az, el = self.course.at(self.now)
        self.ways = {0: [(self.now - 10.0, Slew(az, ()))], 1: [(self.now - 10.0, Slew(el, ()))]}
        self.ends = []
        self.speeds = {}

    def guide(self, **changes):
        az, el = self.course.at(self.now)
        return ControllerInput(
            course=lambda: self.course, model=self.model, start_az_deg=az, start_el_deg=el, now_s=self.now,
            until_s=changes.pop("until_s", self.course.end_s), from_s=self.course.start_s,
            answered=changes.pop("answered", self.answered()), delay_s=DELAY_S, **changes,
        )  # fmt: skip

    def answered(self):
        """How many lines in a row were answered up to now."""
        chance = random.Random(self.seed)
        return next((n for n in range(1000) if chance.random() < self.unanswered), 1000)

    def run(self, controller, *, each=None, **changes):
        activity = controller(self.guide(**changes))
        answer = None
        for _ in range(100_000):
            try:
                step = next(activity) if answer is None else activity.send(answer)
            except StopIteration:
                return self
            self.steps.append((self.now, step))
            if each is not None:
                each(self, step)
            answer = self.do(step)
        raise AssertionError("the controller spins")

    def do(self, step):
        sent = self.now
        if isinstance(step, Wait):
            self.now = max(self.now, step.until_s)
            return StepResult(self.now)
        if isinstance(step, LimitSpeeds):
            return self.limit(step, sent)
        self.now = max(self.now, self.quiet_at) + self.random.uniform(*self.latency)
        answered = self.random.random() >= self.unanswered
        if isinstance(step, ReadPosition):
            if not self.tells or not answered:
                self.now += 0.0 if answered else LATE_S
                return StepResult(self.now)
            return StepResult(self.now, az_deg=self.at(0) % 360.0, el_deg=self.at(1), seen_s=self.now)
        assert isinstance(step, Send)
        if self.random.random() >= self.lost:
            self.move(step)
        if self.mode == "blocking":
            self.now = max(self.now, self.ends[-1])
        self.now += REPLY_S if answered else LATE_S
        return StepResult(self.now, sent_s=sent if answered else None)

    def limit(self, step, sent):
        """There and back through the menus; an answer that is lost there is waited for in full (decision 0003)."""
        self.now = max(self.now, self.quiet_at)
        for _ in range(LINES):
            self.now += self.random.uniform(*self.latency)
            if self.random.random() < self.unanswered:
                self.now, self.quiet_at = self.now + DELAY_S, self.now + 2 * DELAY_S
                return StepResult(self.now)
        self.speeds |= step.speeds_deg_s
        return StepResult(self.now, sent_s=sent)

    def move(self, step):
        axis = self.model.numbered[step.axis]
        goal = round(step.deg / axis.step_deg) * axis.step_deg
        begin = self.now
        if self.mode == "queue":
            self.ends = [end for end in self.ends if end > self.now + 1e-9]
            self.largest_backlog = max(self.largest_backlog, len(self.ends))
            begin = max([self.now, *self.ends])
        at, velocity = self.state(step.axis, begin)
        axis = self.limited(axis)
        slew = plan_axis(axis, at, goal, min(max(velocity, -axis.speed_deg_s), axis.speed_deg_s))
        self.ways[step.axis].append((begin, slew))
        self.ends.append(begin + slew.duration_s)

    def limited(self, axis):
        return replace(axis, speed_deg_s=self.speeds.get(axis.index, axis.speed_deg_s))

    def state(self, axis, when):
        began, slew = next((b, s) for b, s in reversed(self.ways[axis]) if b <= when)
        return slew.at(when - began)

    def at(self, axis, when=None):
        return self.state(axis, self.now if when is None else when)[0]

    def errors(self, *, settle_s=3.0, until_s=None):
        """The angle on the sky between course and dish, at 20 Hz."""
        end = self.course.end_s - 1.0 if until_s is None else until_s
        times = np.arange(self.course.start_s + settle_s, end, 0.05)
        return np.array([
            separation(*self.course.at(float(t)), self.at(0, t), self.at(1, t)) for t in times
        ])  # fmt: skip

    def rms(self, **options):
        return float(np.sqrt(np.mean(self.errors(**options) ** 2)))

    def sends(self, axis=None):
        return [(at, s) for at, s in self.steps if isinstance(s, Send) and axis in (None, s.axis)]
