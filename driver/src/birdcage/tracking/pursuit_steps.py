"""The pursuit as steps of a task: wait, be in place, follow every leg, turn the cable back as announced, and park.

It can begin at any time of the pass: then it joins the course where the target is now.
"""

from __future__ import annotations

from collections.abc import Generator

from birdcage.base.geometry import shortest_turn
from birdcage.tracking import ways
from birdcage.tracking.controller_input import LEAD_S, ControllerInput
from birdcage.tracking.plan import PlanLeg, PlanPart
from birdcage.tracking.planning.routes import Point
from birdcage.tracking.pursuit_context import PursuitContext, PursuitStage, StageNotice, clock_text
from birdcage.tracking.steps import Hear, ReadPosition, Send, SlewTo, Step, StepResult, Steps, Wait

COUNTDOWN_S = 5.0
"""Before motion that no person has just asked for (`docs/decisions/0017-the-pursuit-and-the-lease.md`)."""
JUST_ASKED_S = 60.0
"""So long after a person has asked for it, a first motion is what they asked for."""
IN_PLACE_DEG = 0.1
AGAIN_S = 0.5
"""How soon it is looked again whether the dish has nothing to do for a while."""
JOIN_DEG = 1.0
"""Further from the course than this the whole dish is sent there first."""
HEAR_EVERY_S = 8.5
"""How often the tuner is read while the dish stands still: two visits and the positions between would be too much
for the wire within 10 s (`station.watches`)."""
HAIR_DEG = 1e-6
AHEAD_S = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 64.0, 128.0, 256.0, 512.0)
"""What is looked at. A target that is as slow as that over one of these spans is so within it, too."""


class Pursuer:
    """Where a pursuit stands. One use each: `run` gives its steps."""

    def __init__(self, context: PursuitContext, now_s: float) -> None:
        self._context = context
        self._begun_s = self._now_s = now_s
        self._done_s = float("-inf")
        """The end of the last leg that is over."""
        self._place: Point | None = None
        """Where the dish was sent last, as the course counts it; None before it was sent anywhere."""

    def run(self) -> Steps:
        """Carry it out."""
        context, rolling = self._context, False
        while (leg := context.leg_after(max(self._now_s, self._done_s))) is not None:
            if not rolling:
                if (yield from self._may_leave(leg)):
                    rolling = True
            elif leg.part is PlanPart.REWIND:
                yield from self._rewind(leg)
            elif self._now_s < leg.start_s - self._lead_s(leg):
                yield from self._be_ready(leg)
            else:
                yield from self._follow(leg)
        if rolling and context.park is not None:
            yield from self._park(context.park)

    def _may_leave(self, leg: PlanLeg) -> Generator[Step, StepResult, bool]:
        """Wait for the time to leave; return whether it has come, and was counted down to unless just asked for."""
        leave_s = self._context.leave_s(leg)
        asked = self._context.asked and max(leave_s, self._now_s) - self._begun_s <= JUST_ASKED_S
        begin_s = leave_s if asked else leave_s - COUNTDOWN_S
        if self._now_s < begin_s:
            self._tell(PursuitStage.WAITING, f"The dish moves at {clock_text(leave_s)}.", "pre-position", leave_s)
            yield from self._wait(begin_s)
            return False
        if not asked:
            what = "pre-position" if self._now_s < leg.start_s - COUNTDOWN_S else "follow"
            yield from self._count_down("The dish is about to move.", what, leave_s)
        return True

    def _count_down(self, why: str, what: str, at_s: float) -> Steps:
        at_s = max(at_s, self._now_s + COUNTDOWN_S)
        self._tell(PursuitStage.COUNTDOWN, why, what, at_s)
        while self._now_s < at_s:
            yield from self._wait(at_s)

    def _rewind(self, leg: PlanLeg) -> Steps:
        self._tell(
            PursuitStage.REWINDING,
            "Turning the cable back, as planned. The target is lost meanwhile.",
            "follow",
            leg.end_s,
        )
        yield from self._slew((leg.to_az_deg, self._context.course().at(leg.end_s)[1]), leg)
        self._done_s = leg.end_s

    def _be_ready(self, leg: PlanLeg) -> Steps:
        """Be where the leg begins, and wait for it."""
        start = self._context.course().at(leg.start_s)
        if not self._is_at(start, IN_PLACE_DEG):
            self._tell(
                PursuitStage.PREPOSITIONING, "Moving to where the target comes into reach.", "reach", leg.start_s
            )
            yield from self._slew(start, leg)
            return
        self._tell(
            PursuitStage.READY,
            f"In place: the target comes into reach at {clock_text(leg.start_s)}.",
            "reach",
            leg.start_s,
        )
        yield from self._wait(leg.start_s - self._context.lead_s)

    def _lead_s(self, leg: PlanLeg) -> float:
        """Return how long before a leg begins the controller takes over: longer from where the dish is in place."""
        in_place = self._is_at(self._context.course().at(leg.start_s), IN_PLACE_DEG)
        return self._context.lead_s if in_place else LEAD_S

    def _follow(self, leg: PlanLeg) -> Steps:
        context = self._context
        if not self._is_at(context.course().at(max(self._now_s, leg.start_s)), JOIN_DEG):
            self._tell(PursuitStage.PREPOSITIONING, "Moving to the target.", "follow", None)
            yield from self._join(leg)
        if self._place is None:
            return
        what, at_s = context.upcoming(self._now_s)
        waits = self._now_s < leg.start_s - LEAD_S
        if waits:
            what, at_s = "reach", leg.start_s
        self._tell(
            PursuitStage.FOLLOWING,
            f"In place: the target comes into reach at {clock_text(leg.start_s)}." if waits
            else self._on_target(leg),
            what, at_s,
        )  # fmt: skip
        guide = context.guide = ControllerInput(
            context.motor_course, context.model(), *self._place, self._now_s, leg.end_s, context.latency_s,
            context.dead_band_steps, context.dead_band_deg, from_s=leg.start_s,
            answered=context.answered(), delay_s=context.delay_s,
        )  # fmt: skip
        try:
            yield from self._steer(guide)
        finally:
            context.guide = None
        context.latency_s, self._done_s = guide.latency_s, max(guide.until_s, self._now_s)

    def _on_target(self, leg: PlanLeg) -> str:
        plan = self._context.plan
        if leg is not plan.legs[-1] or not plan.goes_on:
            return f"On the target until {clock_text(leg.end_s)}."
        if plan.reach_end_s is not None:
            return f"On the target until {clock_text(plan.reach_end_s)}."
        return "On the target."

    def _steer(self, guide: ControllerInput) -> Steps:
        """Hand the controller's steps on, and note where they send the dish."""
        controller = self._context.controller(guide)
        elevation = guide.model.elevation.index
        try:
            step, hear_s, seen = next(controller), guide.now_s + HEAR_EVERY_S, False
            while True:
                # Right after a reading of the position, which then waits no longer than the excursion takes.
                if isinstance(step, Wait) and seen and self._place is not None and self._now_s >= hear_s:
                    hear_s = self._now_s + AGAIN_S
                    if (until_s := _still_until(guide, self._place, self._now_s)) > hear_s:
                        self._now_s = (yield Hear(until_s, HEAR_EVERY_S)).now_s
                answer = yield step
                self._now_s, seen = answer.now_s, isinstance(step, ReadPosition)
                if isinstance(step, Send) and self._place is not None:
                    az_deg, el_deg = self._place
                    self._place = (az_deg, step.deg) if step.axis == elevation else (step.deg, el_deg)
                elif isinstance(step, SlewTo):
                    self._place = step.waypoints[-1]
                step = controller.send(answer)
        except StopIteration:
            return
        finally:
            controller.close()

    def _park(self, place: Point) -> Steps:
        yield from self._count_down("The pass is over. The dish is about to park.", "park", self._now_s)
        here = yield from self._here()
        if here is None:
            return
        self._tell(PursuitStage.PARKING, "Moving to the park position.", "", None)
        az_deg = ways.nearest_turn(here[0], place[0], self._context.cable)
        known = self._context.cable is not None
        yield SlewTo(self._way(here, (az_deg, place[1]), turn_known=known).stops)

    def _join(self, leg: PlanLeg) -> Steps:
        """Go to where the target will be when the dish gets there."""
        here = yield from self._here()
        if here is None:
            return
        course, known = self._context.course(), leg.turn is not None
        to = course.at(self._now_s)
        for _ in range(2):
            to = course.at(min(self._now_s + self._way(here, to, turn_known=known).seconds, leg.end_s))
        yield from self._slew(to, leg, here)

    def _slew(self, to: Point, leg: PlanLeg, here: Point | None = None) -> Steps:
        if here is None:
            here = yield from self._here()
        stops = (to,) if here is None else self._way(here, to, turn_known=leg.turn is not None).stops
        self._now_s = (yield SlewTo(stops)).now_s
        self._place = to

    def _way(self, here: Point, to: Point, *, turn_known: bool) -> ways.WaypointRoute:
        return ways.way(self._context.bounds(), self._context.model(), here, to, turn_known=turn_known)

    def _here(self) -> Generator[Step, StepResult, Point | None]:
        seen = yield ReadPosition()
        self._now_s = seen.now_s
        return None if seen.az_deg is None or seen.el_deg is None else (seen.az_deg, seen.el_deg)

    def _is_at(self, place: Point, within_deg: float) -> bool:
        here = self._place
        if here is None:
            return False
        return max(abs(shortest_turn(here[0], place[0])), abs(here[1] - place[1])) <= within_deg

    def _wait(self, until_s: float) -> Steps:
        """Wait; whoever drives may end it early, when the plan was replaced."""
        self._now_s = (yield Wait(until_s)).now_s

    def _tell(self, stage: PursuitStage, why: str, what: str, at_s: float | None) -> None:
        self._context.tell(StageNotice(stage, why, what, at_s))


def pursue(context: PursuitContext, now_s: float) -> Steps:
    """Carry out a pursuit from now on (POSIX seconds)."""
    return Pursuer(context, now_s).run()


def _still_until(guide: ControllerInput, place: Point, now_s: float) -> float:
    """Return until when the course stays as near to a place as not to be worth a command; `now_s`: not even now.

    `place`: where the motors were sent, as the course counts it. Times in POSIX seconds.
    """
    course, until_s = guide.course(), now_s
    axes = guide.model.azimuth, guide.model.elevation
    # Half a step more: it was sent to whole steps.
    bands = tuple(guide.least_way_deg(axis) + axis.step_deg / 2.0 + HAIR_DEG for axis in axes)
    for ahead_s in AHEAD_S:
        at_s = min(now_s + ahead_s, guide.until_s)
        az_deg, el_deg = course.at(at_s)
        if abs(shortest_turn(place[0], az_deg)) > bands[0] or abs(place[1] - el_deg) > bands[1]:
            break
        until_s = at_s
        if at_s >= guide.until_s:
            break
    return until_s
