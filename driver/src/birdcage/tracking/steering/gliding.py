"""One axis that goes on at a matched speed, and how long a round of commands takes that tells it a new one."""

from __future__ import annotations

import math

from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.steering.axis_belief import AxisBelief, spans
from birdcage.tracking.steering.latency import Smoothed

REST_S = 0.02
PAUSES = 2.0
"""An axis is sent so many times further than a lost answer keeps the line silent: the next one may be lost as well."""
SPARE_ROUNDS = 3.0
"""And so many rounds beyond that: it must not come to rest before a late one."""
TELLING_DEG = 0.02
"""A goal that prints as the one before may count as the same command, and its speed would not come into force."""


class Glide:
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


class RoundPace:
    """How long rounds take, by how many axes are told something in one; seconds."""

    def __init__(self, round_s: float) -> None:
        self.rounds = {count: Smoothed(round_s) for count in (1, 2)}
        self.leads = {(index, count): Smoothed(round_s) for index in (0, 1) for count in (1, 2)}
        """From the begin of a round until an axis acts on its move."""

    def round_s(self, count: int) -> float:
        """Return how long a round for so many axes takes."""
        return self.rounds[count].seconds

    def lead_s(self, glide: Glide, count: int) -> float:
        """Return how long after its begin such a round moves an axis."""
        return self.leads[glide.axis.index, count].seconds
