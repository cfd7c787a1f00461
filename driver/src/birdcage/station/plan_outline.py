"""A plan in a few plain values: what other programs are told of one, in place of its curves."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from birdcage.tracking.plan import Plan


@dataclass(frozen=True, slots=True)
class AimOutline:
    """What a plan follows."""

    name: str
    kind: str
    """`satellite`, `slot`, `body`, `star` or `fixed`."""
    norad_id: int | None = None


@dataclass(frozen=True, slots=True)
class PlanOutline:
    """What a plan follows, when, and how well. A program that reads `PursuitChanged` has this as its plan."""

    aim: AimOutline
    made_at: datetime
    begins: datetime | None
    """When its first leg begins; None if nothing can be reached."""
    ends: datetime | None
    """When its last leg ends."""
    rms_error_deg: float | None
    """The pointing error to expect of the dish alone; None if nothing is followed."""


def outline(plan: Plan | PlanOutline) -> PlanOutline:
    """Return the outline of a plan; an outline is its own."""
    if isinstance(plan, PlanOutline):
        return plan
    legs, forecast = plan.legs, plan.forecast
    return PlanOutline(
        AimOutline(plan.aim.name, plan.aim.kind, plan.aim.norad_id),
        plan.made_at,
        datetime.fromtimestamp(legs[0].start_s, UTC) if legs else None,
        datetime.fromtimestamp(legs[-1].end_s, UTC) if legs else None,
        None if forecast is None else float(forecast.rms_deg),
    )
