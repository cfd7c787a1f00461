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

from collections.abc import Generator, Sequence
from dataclasses import replace

from birdcage.tracking.controller_input import LEAD_S, ControllerInput
from birdcage.tracking.steering.axis_belief import AxisBelief, spans
from birdcage.tracking.steering.fast import steer
from birdcage.tracking.steering.gliding import REST_S, Glide, RoundPace
from birdcage.tracking.steering.latency import Latency
from birdcage.tracking.steps import LimitSpeeds, ReadPosition, Send, Step, StepResult, Steps, Wait

SOUND = 60
"""It glides where so many lines in a row were answered in time: on a line that loses 8 %, in one case of 150."""
PREPARES_S = 16.0
"""What it takes, beside a pause of the line, to see that it is sound, to set the first speeds and to put them back."""
EXCHANGES = 9
"""A first guess of what a round takes: changing menus there and back, two speeds set and read back, two moves."""
TRIES = 3
"""How often a speed is put back where the answers are lost; whoever drives sees to the rest."""
LEANS = 0.3
"""What a reading counts against the model: its last digit and its moment are as uncertain as what has added up."""


def velocity(guide: ControllerInput) -> Steps:
    """Follow at matched speeds; at the end of the leg the speeds are as before, and the dish stands on the course."""
    yield from Glider(guide).run()


class Glider:
    """Glides as long as every answer comes in time, and steps from then on."""

    def __init__(self, guide: ControllerInput) -> None:
        self._guide = guide
        axes = (guide.model.azimuth, guide.start_az_deg), (guide.model.elevation, guide.start_el_deg)
        self._beliefs = AxisBelief(*axes[0], guide.now_s), AxisBelief(*axes[1], guide.now_s)
        self._glides = Glide(guide, 0, self._beliefs[0]), Glide(guide, 1, self._beliefs[1])
        self._latency, self._pace = Latency(guide.model, guide.latency_s), RoundPace(EXCHANGES * guide.latency_s)
        self._due: list[Glide] = []
        """The axes that have to move."""
        self._late: Glide | None = None
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
        self._pace = RoundPace(guide.now_s - began_s + 2.0 * guide.latency_s)
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
                look_s = max(look_s + guide.look_every_s, guide.now_s)
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

    def _limit(self, glides: Sequence[Glide]) -> Generator[Step, StepResult, bool]:
        """Set the speeds that were planned; return whether the answer came in time."""
        step = LimitSpeeds({glide.axis.index: glide.speed_deg_s for glide in glides})
        answer = yield from self._do(step)
        for glide in glides:
            glide.belief.axis = replace(glide.axis, speed_deg_s=glide.speed_deg_s)
        return not answer.is_lost(step)

    def _send(self, glide: Glide) -> Generator[Step, StepResult, bool]:
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
