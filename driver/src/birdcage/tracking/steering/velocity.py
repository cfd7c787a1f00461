"""Steers a fast dish with its speed matched to the target's: it glides from command to command.

`docs/tracking.md`, *How it follows*, has what that gains. Each round sets the greatest speed of both axes and then
sends both beyond where the next round will find them, so that an axis goes on at that speed until it is told better: a
late command costs next to nothing, and there is no saw-tooth. It is unconfirmed on a dish that its speeds may be
changed so often: the owner has to allow it (`[tracking]`).

A round changes menus and reads speeds back, so an answer that is lost in it holds everything up for twice the longest
delay, where a stream of targets (`fast`) goes on at once. So it begins on a line that has proved sound, and while the
dish waits for its target; an axis is sent further than such a pause lasts; and from the first answer that does not come
in time the dish steps, at its own speeds, until the leg ends (decision 0031).
"""

from __future__ import annotations

import math
from collections.abc import Generator, Sequence
from dataclasses import replace

from birdcage.tracking.controller_input import LEAD_S, ControllerInput
from birdcage.tracking.steering.axis_belief import AxisBelief, spans
from birdcage.tracking.steering.fast import steer
from birdcage.tracking.steering.latency import Latency, Smoothed
from birdcage.tracking.steps import LimitSpeeds, ReadPosition, Send, Step, StepResult, Steps, Wait

REST_S = 0.02
PAUSES = 2.0
"""An axis is sent so many times further than a lost answer keeps the line silent: the next one may be lost as well."""
SPARE_ROUNDS = 3.0
"""And so many rounds beyond that: it must not come to rest before a late one."""
TELLING_DEG = 0.02
"""A goal that prints as the one before may count as the same command, and its speed would not come into force."""


PREPARES_S = 16.0
"""What it takes, beside a pause of the line, to see that it is sound, to set the first speeds and to put them back."""
EXCHANGES = 9
"""A first guess of what a round takes: changing menus there and back, two speeds set and read back, two moves."""
TRIES = 3
"""How often a speed is put back where the answers are lost; whoever drives sees to the rest."""
LEANS = 0.3
"""What a reading counts against the model: its last digit and its moment are as uncertain as what has added up."""


class _Glide:
    """One axis: how fast it should go for the next round, and where to."""

    def __init__(self, guide: ControllerInput, column: int, belief: AxisBelief) -> None:
        self._guide = guide
        self._column = column
        self.axis = (guide.model.azimuth, guide.model.elevation)[column]
        self.belief = belief
        self.speed_deg_s = self.axis.speed_deg_s
        self.goal_deg = self.belief.goal_deg

    def plan(self, acts_s: float, round_s: float) -> bool:
        """Choose speed and goal of a round whose move acts at a time; return whether it is worth any command."""
        course = self._guide.course()
        at_deg = self.belief.at(acts_s)[0]
        next_s = min(acts_s + round_s, self._guide.until_s)
        wanted_deg = course.at(next_s)[self._column]
        turns_deg = wanted_deg - course.at(acts_s)[self._column]
        if turns_deg:
            # An axis that does not come to rest lacks the overshoot that the course of the motor counts on, or that
            # stepping has against an unknown play (decision 0035).
            wanted_deg += self.axis.gliding_lead_deg(turns_deg)
        way, way_s = wanted_deg - at_deg, max(next_s - acts_s, REST_S)
        # The dish counts whole steps a second.
        steps_s = max(round(abs(way) / way_s / self.axis.step_deg), 1)
        self.speed_deg_s = min(steps_s * self.axis.step_deg, self.axis.speed_deg_s)
        glide_s = PAUSES * 2.0 * self._guide.delay_s + SPARE_ROUNDS * round_s
        self.goal_deg = self._told(at_deg, way * glide_s / way_s)
        told = abs(self.goal_deg - self.belief.goal_deg) >= TELLING_DEG
        return told and abs(self.goal_deg - at_deg) >= self.axis.step_deg / 2.0

    def _told(self, at_deg: float, way: float) -> float:
        """Return the goal of a way, which is made longer, or shorter, where it prints as the goal before."""
        span_deg, before_deg = spans(self._guide.course())[self._column], self.belief.goal_deg
        for by in (0.0, 2.0 * TELLING_DEG, -2.0 * TELLING_DEG):
            goal = self.belief.quantised((before_deg if by else at_deg + way) + math.copysign(by, by * way), span_deg)
            if abs(goal - before_deg) >= TELLING_DEG and (goal - at_deg) * way > 0.0:
                return goal
        return before_deg


class _RoundPace:
    """How long rounds take, by how many axes are told something in one; seconds."""

    def __init__(self, round_s: float) -> None:
        self.rounds = {count: Smoothed(round_s) for count in (1, 2)}
        self.leads = {(index, count): Smoothed(round_s) for index in (0, 1) for count in (1, 2)}
        """From the begin of a round until an axis acts on its move."""

    def round_s(self, count: int) -> float:
        """Return how long a round for so many axes takes."""
        return self.rounds[count].seconds

    def lead_s(self, glide: _Glide, count: int) -> float:
        """Return how long after its begin such a round moves an axis."""
        return self.leads[glide.axis.index, count].seconds


SOUND = 60
"""It glides where so many lines in a row were answered in time: on a line that loses 8 %, in one case of 150."""


def velocity(guide: ControllerInput) -> Steps:
    """Follow at matched speeds; at the end of the leg the speeds are as before, and the dish stands on the course."""
    yield from Glider(guide).run()


class Glider:
    """Glides as long as every answer comes in time, and steps from then on."""

    def __init__(self, guide: ControllerInput) -> None:
        self._guide = guide
        axes = (guide.model.azimuth, guide.start_az_deg), (guide.model.elevation, guide.start_el_deg)
        self._beliefs = AxisBelief(*axes[0], guide.now_s), AxisBelief(*axes[1], guide.now_s)
        self._glides = _Glide(guide, 0, self._beliefs[0]), _Glide(guide, 1, self._beliefs[1])
        self._latency, self._pace = Latency(guide.model, guide.latency_s), _RoundPace(EXCHANGES * guide.latency_s)
        self._due: list[_Glide] = []
        """The axes that have to move."""
        self._late: _Glide | None = None
        """The axis whose move was not answered in time."""

    def run(self) -> Steps:
        """Follow until the leg ends."""
        guide = self._guide
        if (yield from self._is_sound()):
            if (yield from self._prepare()):
                yield from self._glide()
            yield from self._restore()
        yield from steer(guide, looks=True, beliefs=self._beliefs)
        course = guide.course()
        for glide, end_deg, span_deg in zip(self._glides, course.at(guide.until_s), spans(course), strict=True):
            goal = glide.belief.quantised(end_deg, span_deg)
            if abs(goal - glide.belief.goal_deg) >= glide.axis.step_deg / 2.0:
                yield Send(glide.axis.index, goal)

    def _is_sound(self) -> Generator[Step, StepResult, bool]:
        """Return whether the line is sound, and the dish waits long enough yet to prepare and to mend what is lost."""
        guide, sound = self._guide, self._guide.answered
        latest_s = guide.from_s - 2.0 * guide.delay_s - LEAD_S
        while sound < SOUND and guide.now_s < min(latest_s, guide.until_s):
            if not (yield from self._look()):
                return False
            sound += 1
        return sound >= SOUND and guide.now_s <= latest_s

    def _prepare(self) -> Generator[Step, StepResult, bool]:
        """Set the speeds at which the target will come, and wait for it; return whether the answer came in time."""
        guide = self._guide
        began_s = guide.now_s
        self._due = [glide for glide in self._glides if glide.plan(guide.from_s, self._pace.round_s(2))]
        if not (yield from self._limit(self._glides)):
            return False
        self._pace = _RoundPace(guide.now_s - began_s + 2.0 * guide.latency_s)
        begin_s = guide.from_s - guide.latency_s
        while guide.now_s < min(begin_s, guide.until_s):
            yield from self._do(Wait(min(begin_s, guide.until_s)))
        return True

    def _glide(self) -> Steps:
        """Glide at the speeds that are set, and then at better ones, until an answer is lost.

        Or until shortly before the leg ends: a rewind may follow, for which the dish needs its own speeds.
        """
        guide, pace = self._guide, self._pace
        pause_s = 2.0 * guide.delay_s + LEAD_S
        look_s = guide.now_s + guide.look_every_s
        for glide in self._due:
            if not (yield from self._send(glide)):
                return
        while guide.now_s < guide.until_s - pause_s:
            if guide.now_s >= look_s:
                if not (yield from self._look()):
                    return
                look_s = guide.next_look_s(look_s + guide.look_every_s, guide.now_s)
            began_s = guide.now_s
            due = [glide for glide in self._glides if glide.plan(began_s + pace.lead_s(glide, 2), pace.round_s(2))]
            if len(due) == 1:
                due[0].plan(began_s + pace.lead_s(due[0], 1), pace.round_s(1))
            if not due:
                yield from self._do(Wait(min(began_s + REST_S, guide.until_s)))
                continue
            if not (yield from self._limit(due)):
                return
            for glide in due:
                if not (yield from self._send(glide)):
                    return
                pace.leads[glide.axis.index, len(due)].take(glide.belief.began_s - began_s)
            pace.rounds[len(due)].take(guide.now_s - began_s)
            guide.latency_s = self._latency.mean_s

    def _restore(self) -> Steps:
        """Put the speeds back, and see where the dish is."""
        guide, late = self._guide, self._late
        if late is not None:
            # Once a line of the other axis is answered, nothing of the late one is under way any more (decision 0018):
            # only then the menu can be left at once. And the dish is aimed anew, in case that takes long.
            for glide in sorted(self._glides, key=lambda each: each is late):
                glide.plan(guide.now_s + self._latency.of(glide.axis.index), self._pace.round_s(2))
                yield from self._send(glide)
        for _ in range(TRIES):
            limit = LimitSpeeds({glide.axis.index: glide.axis.speed_deg_s for glide in self._glides})
            if not (yield from self._do(limit)).is_lost(limit):
                break
        for glide in self._glides:
            glide.belief.axis = glide.axis
        if guide.now_s < guide.until_s:
            yield from self._look()

    def _do(self, step: Step) -> Generator[Step, StepResult, StepResult]:
        answer = yield step
        self._guide.now_s = answer.now_s
        return answer

    def _limit(self, glides: Sequence[_Glide]) -> Generator[Step, StepResult, bool]:
        """Set the speeds that were planned; return whether the answer came in time."""
        step = LimitSpeeds({glide.axis.index: glide.speed_deg_s for glide in glides})
        answer = yield from self._do(step)
        for glide in glides:
            glide.belief.axis = replace(glide.axis, speed_deg_s=glide.speed_deg_s)
        return not answer.is_lost(step)

    def _send(self, glide: _Glide) -> Generator[Step, StepResult, bool]:
        """Send an axis where it was planned; return whether the answer came in time."""
        step = Send(glide.axis.index, glide.goal_deg, beyond=True)
        answer = yield from self._do(step)
        # Where its answer is lost, the dish has most likely taken it all the same.
        glide.belief.send(glide.goal_deg, self._latency.measure(glide.axis.index, answer, 0.0))
        if answer.is_lost(step):
            self._late = glide
        return not answer.is_lost(step)

    def _look(self) -> Generator[Step, StepResult, bool]:
        """Read where the dish is; return whether the answer came in time."""
        seen = yield from self._do(ReadPosition())
        seen_s = self._latency.seen_s(seen)
        for glide, read_deg in zip(self._glides, (seen.az_deg, seen.el_deg), strict=True):
            if glide.belief.check(read_deg, seen_s):
                glide.belief.lean_on(read_deg, seen_s, LEANS)
        return seen.az_deg is not None
