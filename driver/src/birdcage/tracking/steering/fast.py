"""Steers a dish whose moves are short and can be replaced on their way (reference tracking 3.5, item 3).

At every prompt one axis is sent to where the target will be at arrival + half an interval + half a move, so that the
mean of moving and standing lies on the course. What is left of the error is the saw-tooth: rate x interval / 2 sqrt(3).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.tracking.controller import Helm
from birdcage.tracking.steering.axis_belief import AxisBelief, spans
from birdcage.tracking.steering.dead_band import dead_band_deg
from birdcage.tracking.steering.latency import Interval, Latency
from birdcage.tracking.steps import Activity, Look, Send, Wait

REST_S = 0.02
"""How long it waits where nothing has to move."""
AGAIN_S = 0.2
"""How soon it looks again where no reading came."""
LONGEST_INTERVAL_S = 1.0
"""An axis that stood still for longer was not waiting for its turn: that is no interval."""
ROUNDS = 3
"""Of the fixed point: how long the move takes depends on its goal, and the goal on how long it takes."""


@dataclass(slots=True)
class Aim:
    """Where an axis would be sent now."""

    goal_deg: float
    off_deg: float
    """How far that is from where it was sent last, on the sky."""
    due: bool
    """Whether it is beyond the dead-band."""


class Rudder:
    """One axis of a fast dish: when it was sent, and where to send it next."""

    def __init__(self, helm: Helm, column: int, belief: AxisBelief | None = None) -> None:
        self._helm = helm
        self._column = column
        axis = (helm.model.azimuth, helm.model.elevation)[column]
        self.index = axis.index
        self.belief = belief or AxisBelief(axis, (helm.start_az_deg, helm.start_el_deg)[column], helm.now_s)
        self.interval = Interval(2.0 * helm.latency_s)
        self.sent_s = helm.now_s
        self.looked_s = 0.0
        """How long readings have held the wire since it was sent."""

    def aim(self, acts_s: float, look_s: float, looking_s: float) -> Aim:
        """Choose a goal for a command that acts at a time; a reading is due at `look_s` and takes `looking_s`."""
        course, interval_s, column = self._helm.course(), self.interval.seconds, self._column
        if look_s < acts_s + interval_s:
            interval_s += looking_s  # it stands so much longer before its next turn
        goal, ahead_s = self.belief.goal_deg, interval_s / 2.0
        for _ in range(ROUNDS):
            goal = course.at(min(acts_s + ahead_s, self._helm.until_s))[column]
            move_s = self.belief.planned(goal, acts_s).duration_s
            ahead_s = (interval_s + move_s) / 2.0 if move_s < interval_s else move_s
        goal = self.belief.quantised(goal, spans(course)[column])
        off = abs(goal - self.belief.goal_deg)
        lift = math.cos(math.radians(course.at(acts_s)[1])) if column == 0 else 1.0
        return Aim(goal, off * lift, off >= dead_band_deg(self._helm, self.belief.axis))

    def sent(self, goal_deg: float, acted_s: float) -> None:
        """Take in that the dish has acted on a command."""
        gap_s = acted_s - self.sent_s - self.looked_s
        self.looked_s = 0.0
        if gap_s < LONGEST_INTERVAL_S:
            self.interval.take(gap_s)
        self.sent_s = acted_s
        self.belief.send(goal_deg, acted_s)

    def need(self, aim: Aim, acts_s: float) -> float:
        """Return how much this axis wants the next command: intervals as rate^-2/3 make the sum of squares least."""
        return aim.off_deg**2 * max(acts_s - self.sent_s, 1e-3)


def fast(helm: Helm) -> Activity:
    """Follow as fast as the prompt returns; the position that is read serves as a check."""
    yield from steer(helm, looks=True)


def steer(helm: Helm, *, looks: bool, beliefs: tuple[AxisBelief | None, AxisBelief | None] = (None, None)) -> Activity:
    """Follow with or without reading the position; `beliefs`: of a dish that is on its way already."""
    latency = Latency(helm.model, helm.latency_s)
    rudders = Rudder(helm, 0, beliefs[0]), Rudder(helm, 1, beliefs[1])
    now_s, look_s = helm.now_s, helm.now_s + helm.look_every_s
    while now_s < helm.until_s:
        if looks and now_s >= look_s:
            seen = yield Look()
            for rudder in rudders:
                rudder.looked_s += seen.now_s - now_s
            now_s = seen.now_s
            look_s = now_s + AGAIN_S if seen.az_deg is None else max(look_s + helm.look_every_s, now_s)
            for rudder, read_deg in zip(rudders, (seen.az_deg, seen.el_deg), strict=True):
                rudder.belief.check(read_deg, latency.seen_s(seen))
            continue
        best: tuple[float, Rudder, Aim] | None = None
        for rudder in rudders:
            acts_s = now_s + latency.of(rudder.index)
            aim = rudder.aim(acts_s, look_s if looks else math.inf, latency.mean_s)
            if aim.due and (best is None or rudder.need(aim, acts_s) > best[0]):
                best = rudder.need(aim, acts_s), rudder, aim
        if best is None:
            now_s = (yield Wait(min(now_s + REST_S, helm.until_s))).now_s
            continue
        _, rudder, aim = best
        acts_s = now_s + latency.of(rudder.index)
        move_s = rudder.belief.planned(aim.goal_deg, acts_s).duration_s
        answer = yield Send(rudder.index, aim.goal_deg)
        if answer.sent_s is not None:
            acts_s = latency.measure(rudder.index, answer, move_s)
        rudder.sent(aim.goal_deg, acts_s)  # where its answer is lost, the dish has most likely taken it all the same
        now_s, helm.latency_s = answer.now_s, latency.mean_s
