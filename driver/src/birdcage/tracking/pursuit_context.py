"""What a pursuit is carried out by: the plan, which may be replaced meanwhile, and what to tell whoever drives it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from enum import Enum

from birdcage.base.geometry import shortest_turn
from birdcage.rotator.facts import Facts
from birdcage.tracking.controller_input import LEAD_S, Controller, ControllerInput
from birdcage.tracking.curve import Curve
from birdcage.tracking.plan import Plan, PlanLeg
from birdcage.tracking.planning.bounds import PlanBounds
from birdcage.tracking.steering.motor_course import course_of_motors


class PursuitStage(Enum):
    """What a pursuit does by itself; the names are those of `birdcage.station.pursuit_state.Phase`."""

    WAITING = "waiting"
    COUNTDOWN = "countdown"
    PREPOSITIONING = "prepositioning"
    READY = "ready"
    FOLLOWING = "following"
    REWINDING = "rewinding"
    PARKING = "parking"


@dataclass(frozen=True, slots=True)
class StageNotice:
    """A pursuit enters a stage."""

    stage: PursuitStage
    why: str
    """A sentence for a person."""
    next_what: str = ""
    next_at_s: float | None = None
    """POSIX seconds."""


@dataclass(slots=True)
class PursuitContext:
    """One pursuit's ways and means. Angles are the dish's own."""

    plan: Plan
    controller: Controller
    model: Callable[[], Facts]
    """With the speeds in force at that moment."""
    bounds: Callable[[], PlanBounds]
    """Of elevation and cable, and no-go sectors, at that moment."""
    tell: Callable[[StageNotice], None]
    asked: bool
    """Whether a person has just asked for it."""
    park: tuple[float, float] | None = None
    cable: tuple[float, float] | None = None
    """Between which turns the cable may stand, where that is known and limited."""
    dead_band_steps: float = 0.5
    dead_band_deg: float = 0.0
    answered: Callable[[], int] = lambda: 0
    """As `ControllerInput.answered`, at that moment."""
    delay_s: float = 2.0
    """As `ControllerInput.delay_s`."""
    lead_s: float = LEAD_S
    """How long before the target comes into reach the controller takes over, where the dish is in place by then."""
    latency_s: float = 0.06
    guide: ControllerInput | None = None
    """While it follows."""

    def course(self) -> Curve:
        """Return the present plan's course."""
        course = self.plan.course
        assert course is not None, "a plan without a course is not taken on"
        return course

    def motor_course(self) -> Curve:
        """Return the course of the motors that keeps the dish on it, as far as its gear is known."""
        bounds = self.bounds()
        az_span = bounds.cable if bounds.turn_known else None
        return course_of_motors(self.course(), self.model(), az_span, (bounds.low_el_deg, bounds.high_el_deg))

    def leg_after(self, now_s: float) -> PlanLeg | None:
        """Return the leg under way at a time, or else the next one; None when there is no more."""
        return next((leg for leg in self.plan.legs if leg.end_s > now_s), None)

    def leave_s(self, leg: PlanLeg) -> float:
        """Return when the dish has to leave for a leg at the latest; -inf for any but the first: at once."""
        wait = self.plan.preposition
        if wait is None or leg is not self.plan.legs[0]:
            return float("-inf")
        return wait.leave_s

    def replace(self, plan: Plan, now_s: float) -> None:
        """Go on by another plan of the same pass.

        Where the turn of the cable is not known, its azimuths are unrolled so that they go on from the ones before.
        """
        if plan.course is not None and not any(leg.turn is not None for leg in plan.legs):
            was, would = self.course().at(now_s)[0], plan.course.at(now_s)[0]
            plan = _turned(plan, plan.course, was - would - shortest_turn(would, was))
        self.plan = plan
        if self.guide is not None:
            leg = self.leg_after(now_s)
            self.guide.until_s = now_s if leg is None or leg.start_s > now_s else leg.end_s

    def upcoming(self, now_s: float) -> tuple[str, float | None]:
        """Return what comes next while it follows, as a word, and when."""
        leg = self.leg_after(now_s)
        if leg is None:
            return "", None
        for keyhole in self.plan.keyholes:
            if now_s < keyhole.start_s < leg.end_s:
                return "keyhole", keyhole.start_s
        after = self.leg_after(leg.end_s)
        if after is None:
            end_s = self.plan.reach_end_s
            return ("", None) if end_s is None else ("park" if self.park else "end", end_s)
        return after.part.value if after.part.value == "rewind" else "gap", leg.end_s


def _turned(plan: Plan, course: Curve, by_deg: float) -> Plan:
    if abs(by_deg) < 180.0:
        return plan
    legs = tuple(
        replace(leg, from_az_deg=leg.from_az_deg + by_deg, to_az_deg=leg.to_az_deg + by_deg) for leg in plan.legs
    )
    return replace(plan, course=Curve(course.t_s, course.az_deg + by_deg, course.el_deg), legs=legs)


def clock_text(at_s: float) -> str:
    """Return a time of day for a sentence."""
    return f"{datetime.fromtimestamp(at_s, UTC):%H:%M:%S}Z"
