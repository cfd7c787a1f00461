"""What will happen during a plan, on its time axis; and what a person should know of it beforehand."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime

from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.reach_model import LossCause, LossReason, Lost, PassReach
from birdcage.tracking.curve import Curve
from birdcage.tracking.plan import Incident, Keyhole, PlanLeg, PlanPart

_SHORT_LOSS_S = 1.0
_EDGE_S = 2.0


def incidents(
    passing: Pass | None, sky: Curve, legs: tuple[PlanLeg, ...], holes: tuple[Keyhole, ...], reach: PassReach,
    limits: ReachLimits,
) -> tuple[Incident, ...]:  # fmt: skip
    """Return all of them, in order of time."""
    found = list(_of_pass(passing, sky))
    found.extend(Incident(hole.start_s, "keyhole", f"keyhole, up to {hole.max_error_deg:.1f}° off") for hole in holes)
    for before, leg in zip((None, *legs), legs, strict=False):
        if leg.part is PlanPart.REWIND:
            how = "cable turns back" if leg.turn is not None else "cable may turn back"
            found.append(Incident(leg.start_s, "rewind", f"{how}, up to {leg.end_s - leg.start_s:.1f} s"))
        elif before is None or before.end_s < leg.start_s - 1e-3 or before.part is PlanPart.REWIND:
            found.append(Incident(leg.start_s, "reach", "in reach"))
    for index, leg in enumerate(legs):
        after = legs[index + 1] if index + 1 < len(legs) else None
        lost = _lost_after(leg.end_s, reach)
        goes_on = after is not None and after.start_s <= leg.end_s + 1e-3
        turns_back = after is not None and after.part is PlanPart.REWIND
        # A rewind that begins where the target goes out of reach anyway waits for that.
        if leg.part is PlanPart.FOLLOW and (
            lost is not None and lost.reason is not LossReason.CABLE if turns_back else not goes_on
        ):
            if lost is None and passing is None and leg.end_s >= sky.end_s - 1.0:
                continue  # only the plan ends there
            found.append(Incident(leg.end_s, "unreach", "ends" if lost is None else where_words(lost.cause, limits)))
    return tuple(sorted(found, key=lambda one: one.at_s))


def _of_pass(passing: Pass | None, sky: Curve) -> Iterator[Incident]:
    if passing is None:
        return
    times = (
        ("aos", passing.aos, f"rises, az {passing.aos_azimuth_deg:.0f}°", passing.already_up),
        ("tca", passing.tca, f"highest, {passing.max_elevation_deg:.0f}°", False),
        ("los", passing.los, f"sets, az {passing.los_azimuth_deg:.0f}°", passing.still_up),
    )
    for what, when, text, cut in times:
        at_s = when.timestamp()
        if not cut and sky.start_s - 1.0 <= at_s <= sky.end_s + 1.0:
            yield Incident(at_s, what, text)


def _lost_after(at_s: float, reach: PassReach) -> Lost | None:
    """Return the loss whose limit ends a leg; None if none does."""
    for lost in _limiting(reach):
        if _s(lost.start) - _EDGE_S < at_s < _s(lost.end):
            return lost
    return None


def _limiting(reach: PassReach) -> Iterator[Lost]:
    """Yield what the dish cannot follow; behind the horizon mask it can."""
    return (lost for lost in reach.lost if lost.reason is not LossReason.HORIZON)


def _s(when: datetime) -> float:
    return when.timestamp()


def loss_notes(reach: PassReach, limits: ReachLimits) -> Iterator[str]:
    """Yield a sentence for every limit that takes a part of the pass."""
    for cause, lost_s in reach.lost_s.items():
        if lost_s >= _SHORT_LOSS_S:
            where = where_words(cause, limits)
            heard = ": the dish follows, nothing is heard" if cause.reason is LossReason.HORIZON else ""
            yield f"{where[:1].upper()}{where[1:]} for {_length(lost_s)}{heard}."


def _length(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 100.0 else f"{seconds / 60.0:.1f} min"


def where_words(cause: LossCause, limits: ReachLimits) -> str:
    """Return where the target is that a limit keeps out of reach: `below the 18° floor`."""
    if cause.reason is LossReason.FLOOR:
        return f"below the {limits.el_floor_deg:g}° floor"
    if cause.reason is LossReason.CEILING:
        return f"above the {limits.el_ceiling_deg:g}° ceiling"
    if cause.reason is LossReason.HORIZON:
        return "behind the horizon mask"
    if cause.reason is LossReason.CABLE:
        return "beyond the cable stop"
    return f"in {cause.words}" if cause.sector else cause.words
