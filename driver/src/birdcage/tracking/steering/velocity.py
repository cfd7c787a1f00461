"""Steers a fast dish with its speed matched to the target's: it glides from command to command (reference 3.4).

Each round sets the greatest speed of both axes and then sends both beyond where the next round will find them, so that
an axis goes on at that speed until it is told better: a late command costs next to nothing, and there is no saw-tooth.
Nobody has confirmed on a dish that its speeds may be changed so often: the owner has to allow it (`[tracking]`).
"""

from __future__ import annotations

import math
from dataclasses import replace

from birdcage.tracking.controller import Helm
from birdcage.tracking.steering.axis_belief import AxisBelief, spans
from birdcage.tracking.steering.dead_band import dead_band_deg
from birdcage.tracking.steering.latency import Latency, Smoothed
from birdcage.tracking.steps import Activity, Limit, Look, Send, Wait

REST_S = 0.02
EXCHANGES = 11
"""A first guess of what a round takes: changing menus there and back, two speeds read back, two moves."""
BEYOND = 3.0
"""How many rounds ahead an axis is sent: it must not come to rest before a late one, and goes on no longer than that
when there is none."""


TELLING_DEG = 0.02
"""A goal that prints as the one before may count as the same command, and its speed would not come into force."""
LEANS = 0.3
"""What a reading counts against the model: its last digit and its moment are as uncertain as what has added up."""


class Glide:
    """One axis: how fast it should go for the next round, and where to."""

    def __init__(self, helm: Helm, column: int) -> None:
        self._helm = helm
        self._column = column
        self.axis = (helm.model.azimuth, helm.model.elevation)[column]
        self.belief = AxisBelief(self.axis, (helm.start_az_deg, helm.start_el_deg)[column], helm.now_s)
        self.speed_deg_s = self.axis.speed_deg_s
        self.goal_deg = self.belief.goal_deg

    def plan(self, acts_s: float, round_s: float) -> bool:
        """Choose speed and goal of a round whose move acts at a time; return whether it is worth any command."""
        course = self._helm.course()
        at_deg = self.belief.at(acts_s)[0]
        next_s = min(acts_s + round_s, self._helm.until_s)
        way = course.at(next_s)[self._column] - at_deg
        # The dish counts whole steps a second.
        steps_s = max(round(abs(way) / max(next_s - acts_s, REST_S) / self.axis.step_deg), 1)
        self.speed_deg_s = min(steps_s * self.axis.step_deg, self.axis.speed_deg_s)
        beyond = at_deg + way * BEYOND
        if abs(beyond - self.belief.goal_deg) < TELLING_DEG:
            beyond = self.belief.goal_deg + math.copysign(2.0 * TELLING_DEG, way)
        self.goal_deg = self.belief.quantised(beyond, spans(course)[self._column])
        told = abs(self.goal_deg - self.belief.goal_deg) >= TELLING_DEG
        return told and abs(self.goal_deg - at_deg) >= self.axis.step_deg / 2.0

    def first_deg(self, t_s: float) -> float:
        """Return where the course will be at a time, as the motor can stand there."""
        course = self._helm.course()
        return self.belief.quantised(course.at(min(t_s, self._helm.until_s))[self._column], spans(course)[self._column])

    def sent(self, acted_s: float) -> None:
        """Take in that the dish has acted on the command."""
        self.belief.axis = replace(self.axis, speed_deg_s=self.speed_deg_s)
        self.belief.send(self.goal_deg, acted_s)


class Pace:
    """How long rounds take, by how many axes are told something in one; seconds."""

    def __init__(self, latency_s: float) -> None:
        round_s = EXCHANGES * latency_s
        self.rounds = {count: Smoothed(round_s) for count in (1, 2)}
        self.leads = {(index, count): Smoothed(round_s) for index in (0, 1) for count in (1, 2)}
        """From the begin of a round until an axis acts on its move."""

    def round_s(self, count: int) -> float:
        """Return how long a round for so many axes takes."""
        return self.rounds[count].seconds

    def lead_s(self, glide: Glide, count: int) -> float:
        """Return how long after its begin such a round moves an axis."""
        return self.leads[glide.axis.index, count].seconds


def velocity(helm: Helm) -> Activity:
    """Follow at matched speeds; at the end of the leg the speeds are as before, and the dish stands on the course."""
    latency = Latency(helm.model, helm.latency_s)
    glides = Glide(helm, 0), Glide(helm, 1)
    pace = Pace(helm.latency_s)
    now_s, look_s = helm.now_s, helm.now_s + helm.look_every_s
    for glide in glides:
        # Before the first round takes effect the target is gone already: a step meets it half-way.
        deg = glide.first_deg(now_s + helm.latency_s + pace.lead_s(glide, 2) / 2.0)
        if abs(deg - glide.belief.goal_deg) >= dead_band_deg(helm, glide.axis):
            answer = yield Send(glide.axis.index, deg)
            glide.belief.send(deg, latency.measure(glide.axis.index, answer, 0.0))
            now_s = answer.now_s
    while now_s < helm.until_s:
        if now_s >= look_s:
            seen = yield Look()
            look_s = max(look_s + helm.look_every_s, seen.now_s)
            for glide, read_deg in zip(glides, (seen.az_deg, seen.el_deg), strict=True):
                if glide.belief.check(read_deg, latency.seen_s(seen)):
                    glide.belief.lean_on(read_deg, latency.seen_s(seen), LEANS)
        began_s = now_s
        due = [glide for glide in glides if glide.plan(now_s + pace.lead_s(glide, 2), pace.round_s(2))]
        if len(due) == 1:
            due[0].plan(now_s + pace.lead_s(due[0], 1), pace.round_s(1))
        if not due:
            now_s = (yield Wait(min(now_s + REST_S, helm.until_s))).now_s
            continue
        for glide in due:
            yield Limit(glide.axis.index, glide.speed_deg_s)
        for glide in due:
            answer = yield Send(glide.axis.index, glide.goal_deg)
            now_s, acted_s = answer.now_s, latency.measure(glide.axis.index, answer, 0.0)
            glide.sent(acted_s)
            pace.leads[glide.axis.index, len(due)].take(acted_s - began_s)
        pace.rounds[len(due)].take(now_s - began_s)
        helm.latency_s = latency.mean_s
    course = helm.course()
    for glide, end_deg, span_deg in zip(glides, course.at(helm.until_s), spans(course), strict=True):
        yield Limit(glide.axis.index, glide.axis.speed_deg_s)
        yield Send(glide.axis.index, glide.belief.quantised(end_deg, span_deg))
