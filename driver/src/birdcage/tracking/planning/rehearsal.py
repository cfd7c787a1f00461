"""A rehearsal: the controller that will steer follows the plan with a dish that is no more than its kinematics."""

from __future__ import annotations

import random
from bisect import bisect_right
from collections.abc import Callable, Sequence

import numpy as np

from birdcage.antenna.motion import plan_axis
from birdcage.kinematics import Slew
from birdcage.rotator.facts import Facts
from birdcage.rotator.values import MOTOR_AZIMUTH, MOTOR_ELEVATION
from birdcage.tracking.controller_input import Controller, ControllerInput
from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.mount import Mount
from birdcage.tracking.plan import Forecast, Plan, PlanPart
from birdcage.tracking.planning.forecast import Offsets, made, offsets_deg
from birdcage.tracking.planning.target_track import TargetTrack
from birdcage.tracking.steering.whole import RESTS_S
from birdcage.tracking.steps import LimitSpeeds, ReadPosition, Send, Step, StepResult, Wait
from birdcage.tracking.steps import SlewTo as SlewStep

Span = tuple[float, float]

LATENCY_S = (0.02, 0.1)
"""Of a command, at the least and at the most (assumed, as in the benchmark)."""
_LINE_BITS = 120.0
_REPLY_BITS = 260.0
_SAMPLE_S = 0.1
_MOST_SAMPLES = 8000
_MOST_STEPS = 200_000


def rehearse(
    plan: Plan, mount: Mount, controller: Controller, *, within: Sequence[Span] | None = None, seed: int = 1
) -> Forecast:
    """Return the error that a controller leaves on a plan: perfect elements and clock, no wind, exact kinematics.

    `within`: only during these spans of POSIX seconds. Each leg, or part of one, begins with the dish in place. The
    same seed gives the same latencies. ValueError for a plan that follows nothing then.
    """
    course = plan.course
    spans = _spans([(leg.start_s, leg.end_s) for leg in plan.legs if leg.part is PlanPart.FOLLOW], within)
    if course is None or not spans:
        raise ValueError("a plan that follows nothing")
    dish = TargetTrack.of(plan.sky, mount).dish
    step_s = max(_SAMPLE_S, sum(end - start for start, end in spans) / _MOST_SAMPLES)
    times, errors = [], []
    chance = random.Random(seed)  # noqa: S311 - latencies, not secrets
    for span in spans:
        t = np.linspace(*span, max(2, round((span[1] - span[0]) / step_s) + 1))
        az, el = _follow(span, course, mount.model, controller, chance)(t)
        times.append(t)
        errors.append(offsets_deg(*dish.sample(t), az, el))
    across, up = (np.concatenate(one) for one in zip(*errors, strict=True))
    return made(np.concatenate(times), Offsets(across, up), mount.beam_at(plan.aim.frequency_hz))


def _spans(legs: Sequence[Span], within: Sequence[Span] | None) -> list[Span]:
    if within is None:
        return list(legs)
    cut = [(max(a, start), min(b, end)) for a, b in legs for start, end in within]
    return [(start, end) for start, end in cut if end > start]


def _follow(
    span: Span, course: Curve, model: Facts, controller: Controller, chance: random.Random
) -> Callable[[Floats], tuple[Floats, Floats]]:
    """Return where both axes were over time."""
    start_s, end_s = span
    az, el = course.at(start_s)
    stage = _Stage(model, az, el, start_s, chance)
    activity = controller(ControllerInput(lambda: course, model, az, el, start_s, end_s))
    try:
        step = next(activity)
        for _ in range(_MOST_STEPS):
            if stage.now_s > end_s:
                break
            step = activity.send(stage.carry_out(step))
    except StopIteration:
        pass
    finally:
        activity.close()
    return lambda t: (stage.axes[MOTOR_AZIMUTH].sample(t), stage.axes[MOTOR_ELEVATION].sample(t))


class _Motion:
    """One axis: the slews that it was sent on, each from when it began."""

    def __init__(self, angle_deg: float, at_s: float) -> None:
        self._begun = [at_s - 1.0]
        self._slews = [Slew(angle_deg, ())]

    def at(self, t_s: float) -> tuple[float, float]:
        """Return angle and velocity."""
        index = max(bisect_right(self._begun, t_s) - 1, 0)
        return self._slews[index].at(t_s - self._begun[index])

    def go(self, begin_s: float, slew: Slew) -> None:
        """Take on a slew."""
        self._begun.append(begin_s)
        self._slews.append(slew)

    def sample(self, t: Floats) -> Floats:
        """Return angles at many times."""
        return np.array([self.at(one)[0] for one in t.tolist()])


class _Stage:
    """The dish and the wire to it."""

    def __init__(self, model: Facts, az_deg: float, el_deg: float, now_s: float, chance: random.Random) -> None:
        self._model, self._chance, self.now_s = model, chance, now_s
        self.axes = {MOTOR_AZIMUTH: _Motion(az_deg, now_s), MOTOR_ELEVATION: _Motion(el_deg, now_s)}
        self._queues = model.moves_in_turn
        self._busy_s = self._turn_s = now_s

    def carry_out(self, step: Step) -> StepResult:
        """Do what a controller asks for."""
        sent_s = self.now_s
        if isinstance(step, Wait):
            self.now_s = max(self.now_s, step.until_s)
            return StepResult(self.now_s)
        self.now_s = max(self.now_s, self._turn_s)
        self._turn_s = self.now_s + (self._model.least_line_interval_s or 0.0)
        self.now_s += self._model.bits_s(_LINE_BITS) + self._chance.uniform(*LATENCY_S)
        seen_s = self.now_s
        if isinstance(step, SlewStep):
            return self._slew(step)
        if isinstance(step, Send):
            self._send(step)
        elif isinstance(step, LimitSpeeds):
            raise TypeError(f"a rehearsal has no {type(step).__name__}")
        self.now_s += self._model.bits_s(_REPLY_BITS)
        if isinstance(step, ReadPosition):
            az, el = (self.axes[axis].at(seen_s)[0] for axis in (MOTOR_AZIMUTH, MOTOR_ELEVATION))
            return StepResult(self.now_s, az_deg=az, el_deg=el, seen_s=seen_s)
        return StepResult(self.now_s, sent_s=sent_s)

    def _send(self, step: Send) -> None:
        axis = self._model.numbered[step.axis]
        begin_s = max(self.now_s, self._busy_s) if self._queues else self.now_s
        at, velocity = self.axes[step.axis].at(begin_s)
        slew = plan_axis(axis, at, round(step.deg / axis.step_deg) * axis.step_deg, velocity)
        self.axes[step.axis].go(begin_s, slew)
        self._busy_s = begin_s + slew.duration_s

    def _slew(self, step: SlewStep) -> StepResult:
        """Send both axes at once, and wait for the proof that they rest. That they go at once is not known."""
        to = dict(zip((MOTOR_AZIMUTH, MOTOR_ELEVATION), step.waypoints[-1], strict=True))
        begin_s = self.now_s
        for motor, deg in to.items():
            axis = self._model.numbered[motor]
            slew = plan_axis(axis, self.axes[motor].at(begin_s)[0], round(deg / axis.step_deg) * axis.step_deg)
            self.axes[motor].go(begin_s, slew)
            begin_s += slew.duration_s
        self.now_s = begin_s + RESTS_S
        az, el = (self.axes[motor].at(self.now_s)[0] for motor in to)
        return StepResult(self.now_s, az_deg=az, el_deg=el, seen_s=self.now_s)
