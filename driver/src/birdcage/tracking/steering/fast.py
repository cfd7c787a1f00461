"""Steers a dish whose moves are short and can be replaced on their way (`docs/tracking.md`, *How it follows*).

At every prompt one axis is sent to where the target will be at arrival + half an interval + half a move, so that the
mean of moving and standing lies on the course. What is left of the error is the saw-tooth: rate x interval / 2 sqrt(3).

The wire carries one command at a time, so the turns of both axes are played ahead. Intervals as rate^-2/3 make the sum
of squares of both saw-tooths least. Where one axis is twice as fast as the other its intervals are long and short by
turns: half of the one that comes is how far ahead it aims, not half of the mean of both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.base.geometry import shortest_turn
from birdcage.tracking.controller_input import ControllerInput
from birdcage.tracking.curve import Curve
from birdcage.tracking.steering.axis_belief import AxisBelief, AxisLag, spans
from birdcage.tracking.steering.latency import Latency
from birdcage.tracking.steps import ReadPosition, Send, Steps, Wait

REST_S = 0.02
"""How long it waits where nothing has to move."""
AGAIN_S = 0.2
"""How soon it looks again where no reading came."""
ABOUT_S = 0.5
"""A rate is that of so long before and after."""
ROUNDS = 3
"""Of the fixed point: how long the move takes depends on its goal, and the goal on how long it takes."""
FURTHEST = 8
"""So many commands are played ahead: one axis had none for so long only where it hardly moves."""


@dataclass(frozen=True, slots=True)
class AxisTurn:
    """What decides when it is an axis' turn; degrees on the sky, POSIX seconds."""

    rate_deg_s: float
    sent_s: float
    """When it acted on its last command."""
    latency_s: float
    least_deg: float
    """Its dead-band."""


@dataclass(frozen=True, slots=True)
class ReadingTimes:
    """When the position is read, which takes the wire as a command does."""

    next_s: float
    every_s: float
    take_s: float


@dataclass(frozen=True, slots=True)
class Interval:
    """From when an axis acts on a command until it acts on its next one."""

    mean_s: float
    variance_s2: float

    def middle_s(self, move_s: float) -> float:
        """Return how far ahead the mean of the interval lies, as a moment taken at random meets it: E[T²] / 2 E[T].

        While the axis is on its way it is half-way on the mean: that much later it aims.
        """
        return (self.mean_s + self.variance_s2 / self.mean_s + move_s) / 2.0


def _need_of(off_deg: float, waits_s: float) -> float:
    """Return how much an axis wants the next command."""
    return off_deg**2 * max(waits_s, 1e-3)


def interval_of(
    column: int, turns: tuple[AxisTurn, ...], now_s: float, looks: ReadingTimes, variance_s2: float
) -> Interval:
    """Return how long an axis will wait if it gets its command now. `variance_s2`: of one exchange."""
    acts_s = free_s = now_s + turns[column].latency_s
    look_s, exchanges = looks.next_s, 0
    sent = [turn.sent_s for turn in turns]
    sent[column] = acts_s
    while exchanges < FURTHEST:
        if free_s >= look_s:
            free_s, look_s = free_s + looks.take_s, look_s + looks.every_s
            exchanges += 1
        best, most = column, 0.0
        for other, turn in enumerate(turns):
            waits_s = free_s + turn.latency_s - sent[other]
            off_deg = turn.rate_deg_s * waits_s
            if off_deg >= turn.least_deg and _need_of(off_deg, waits_s) > most:
                best, most = other, _need_of(off_deg, waits_s)
        free_s += turns[best].latency_s
        exchanges += 1
        if best == column:
            break
        sent[best] = free_s
    return Interval(free_s - acts_s, exchanges * variance_s2)


@dataclass(slots=True)
class _AxisAim:
    """Where an axis would be sent now."""

    goal_deg: float
    off_deg: float
    """How far that is from where it was sent last, on the sky."""
    due: bool
    """Whether it is beyond the dead-band."""


class _AxisFollower:
    """One axis of a fast dish: when it was sent, and where to send it next."""

    def __init__(self, guide: ControllerInput, column: int, belief: AxisBelief | None = None) -> None:
        self._guide = guide
        self._column = column
        self.axis = (guide.model.azimuth, guide.model.elevation)[column]
        self.index = self.axis.index
        self.belief = belief or AxisBelief(self.axis, (guide.start_az_deg, guide.start_el_deg)[column], guide.now_s)
        self.sent_s = guide.now_s
        self.lag = AxisLag(self.axis.overshoot_deg)

    def aim(self, course: Curve, acts_s: float, interval: Interval) -> _AxisAim:
        """Choose a goal for a command that acts at a time, and is the last one of this axis for an interval."""
        column = self._column
        goal, ahead_s = self.belief.goal_deg, interval.mean_s / 2.0
        for _ in range(ROUNDS):
            goal = course.at(min(acts_s + ahead_s, self._guide.until_s))[column]
            move_s = self.belief.planned(goal, acts_s).duration_s
            ahead_s = interval.middle_s(move_s) if move_s < interval.mean_s else move_s
        lead_deg = self.lag.lead_deg(self._way_deg(course, acts_s))
        goal = self.belief.quantised(goal + lead_deg, spans(course)[column])
        off = abs(goal - self.belief.goal_deg)
        return _AxisAim(goal, off * self._lift(course, acts_s), off >= self._least_deg(goal - self.belief.goal_deg))

    def turn(self, course: Curve, acts_s: float, latency: Latency) -> AxisTurn:
        """Return what decides when it is its turn again."""
        lift = self._lift(course, acts_s)
        way = self._way_deg(course, acts_s)
        rate = abs(way) / (2.0 * ABOUT_S) * lift
        least = self._least_deg(way) * lift
        return AxisTurn(rate, self.sent_s, latency.of(self.index), least)

    def look(self, course: Curve, read_deg: float | None, seen_s: float) -> None:
        """Compare with a reading, and take in how far the axis stays behind its goals."""
        at_deg, _ = self.belief.at(seen_s)
        if self.belief.check(read_deg, seen_s) and read_deg is not None:
            self.lag.take(shortest_turn(read_deg, at_deg), self._way_deg(course, seen_s))

    def _way_deg(self, course: Curve, at_s: float) -> float:
        """Return how far the target turns it in the `ABOUT_S` before and after, signed."""
        return course.at(at_s + ABOUT_S)[self._column] - course.at(at_s - ABOUT_S)[self._column]

    def _least_deg(self, way_deg: float) -> float:
        """Return the least way that is worth a command."""
        return max(self._guide.least_way_deg(self.axis), self.axis.least_way_deg(way_deg))

    def _lift(self, course: Curve, at_s: float) -> float:
        return math.cos(math.radians(course.at(at_s)[1])) if self._column == 0 else 1.0

    def sent(self, goal_deg: float, acted_s: float) -> None:
        """Take in that the dish has acted on a command."""
        self.sent_s = acted_s
        self.belief.send(goal_deg, acted_s)


def fast(guide: ControllerInput) -> Steps:
    """Follow as fast as the prompt returns; the position that is read serves as a check."""
    yield from steer(guide, looks=True)


def steer(
    guide: ControllerInput, *, looks: bool, beliefs: tuple[AxisBelief | None, AxisBelief | None] = (None, None)
) -> Steps:
    """Follow with or without reading the position; `beliefs`: of a dish that is on its way already."""
    latency = Latency(guide.model, guide.latency_s)
    followers = _AxisFollower(guide, 0, beliefs[0]), _AxisFollower(guide, 1, beliefs[1])
    now_s, look_s = guide.now_s, guide.now_s + guide.look_every_s
    while now_s < guide.until_s:
        if looks and now_s >= look_s:
            seen = yield ReadPosition()
            now_s = seen.now_s
            due_s = now_s + AGAIN_S if seen.az_deg is None else look_s + guide.look_every_s
            look_s = guide.next_look_s(due_s, now_s)
            for follower, read_deg in zip(followers, (seen.az_deg, seen.el_deg), strict=True):
                follower.look(guide.course(), read_deg, latency.seen_s(seen))
            continue
        course = guide.course()
        turns = tuple(follower.turn(course, now_s, latency) for follower in followers)
        looking = ReadingTimes(look_s if looks else math.inf, guide.look_every_s, latency.mean_s)
        best: tuple[float, _AxisFollower, _AxisAim] | None = None
        for column, follower in enumerate(followers):
            acts_s = now_s + latency.of(follower.index)
            interval = interval_of(column, turns, now_s, looking, latency.variance_s2)
            aim = follower.aim(course, acts_s, interval)
            need = _need_of(aim.off_deg, acts_s - follower.sent_s)
            if aim.due and (best is None or need > best[0]):
                best = need, follower, aim
        if best is None:
            now_s = (yield Wait(min(now_s + REST_S, guide.until_s))).now_s
            continue
        _, follower, aim = best
        acts_s = now_s + latency.of(follower.index)
        move_s = follower.belief.planned(aim.goal_deg, acts_s).duration_s
        answer = yield Send(follower.index, aim.goal_deg)
        if answer.sent_s is not None:
            acts_s = latency.measure(follower.index, answer, move_s)
        follower.sent(aim.goal_deg, acts_s)  # where its answer is lost, the dish has most likely taken it all the same
        now_s, guide.latency_s = answer.now_s, latency.mean_s
