"""From stretches to a plan: the course, what is to be expected of it, and what a person should know beforehand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from birdcage.sky.element_error import ElementError
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import PassReach
from birdcage.tracking.curve import Curve
from birdcage.tracking.day import Day
from birdcage.tracking.mount import Mount
from birdcage.tracking.plan import Forecast, Keyhole, Plan, PlanLeg, PlanPart, PlanTarget, Preposition
from birdcage.tracking.planning.course import course as course_of
from birdcage.tracking.planning.forecast import forecast
from birdcage.tracking.planning.incidents import incidents, loss_notes
from birdcage.tracking.planning.itinerary import TrackSegment
from birdcage.tracking.planning.keyholes import keyholes, simulated
from birdcage.tracking.planning.routes import Route, route
from birdcage.tracking.planning.target_track import TargetTrack
from birdcage.tracking.pointing_error import STILL_FLIES, pointing_error

_AT_ONCE_S = 0.5
"""A rewind that ends no longer than this before the target is followed again ends with that."""
_SEEN_DEG = 0.05
"""What a person is told of: five steps of a motor."""
_STOP_S = 1.0
"""For each stop on the way: the command, and until it is seen that the dish has come there."""


@dataclass(frozen=True, slots=True)
class Basis:
    """What of a plan is settled before its course."""

    aim: PlanTarget
    made_at: datetime
    passing: Pass | None
    reach: PassReach
    track: TargetTrack
    stretches: tuple[TrackSegment, ...]
    preposition_s: float
    elements: ElementError | None
    day: Day | None = None


def complete(basis: Basis, share: float | None, seen: Forecast | None = None, *, hold: float = 0.0) -> Plan:
    """Return the plan that follows the stretches; `seen` is what a simulation of its course has shown.

    `share` and `hold` as `course` takes them.
    """
    track, stretches, mount = basis.track, basis.stretches, basis.track.mount
    course = course_of(track, stretches, share, hold)
    legs = _legs(stretches, course, turns=track.bounds.cable is not None and track.bounds.turn_known)
    beam = mount.beam_at(basis.aim.frequency_hz)
    holes = keyholes(track, stretches, course, beam)
    if seen is not None:
        holes = simulated(holes, seen, beam)
    place = _preposition(track, course, basis.preposition_s, basis.made_at.timestamp())
    own = seen or forecast(track, stretches, course, beam)
    notes = [
        *_element_notes(basis.elements),
        *_rewind_notes(legs),
        *map(_hole_note, holes),
        *_beyond_notes(track, stretches),
        *_border_notes(track),
        *_notes(basis.reach, mount),
    ]
    if place is None:
        notes.insert(0, "No path to its start keeps clear of the no-go sectors.")
    return Plan(
        basis.aim, basis.made_at, basis.passing, basis.reach, track.sky, course, legs, place, holes,
        own, incidents(basis.passing, track.sky, legs, holes, basis.reach, mount.limits),
        tuple(notes), share, share is None or not holes or seen is not None, basis.elements,
        pointing_error(own, basis.elements, beam), basis.day,
    )  # fmt: skip


def unfollowed(
    aim: PlanTarget, made_at: datetime, passing: Pass | None, reach: PassReach, track: TargetTrack,
    elements: ElementError | None,
    day: Day | None = None,
) -> Plan:  # fmt: skip
    """Return the plan of what cannot be followed, which says why."""
    limits, never = track.mount.limits, track.mount.model.no_following
    notes = (never,) if never else (
        *_element_notes(elements), _nothing_note(track, passing, day), *_border_notes(track),
        *_notes(PassReach((), (), None) if day is not None else reach, track.mount),
    )  # fmt: skip
    return Plan(
        aim, made_at, passing, reach, track.sky, None, (), None, (), None,
        incidents(passing, track.sky, (), (), reach, limits), notes, elements=elements, day=day,
    )  # fmt: skip


def _nothing_note(track: TargetTrack, passing: Pass | None, day: Day | None) -> str:
    """Return that nothing can be followed: of a pass, or, of what does not pass, for as long as was looked ahead."""
    if passing is not None:
        return "No more of it can be followed."
    if day is not None and day.standing:
        return f"{day.standing[0].upper()}{day.standing[1:]}."
    start_s = None if day is None else day.reach_start_s(track.sky.start_s)
    if start_s is not None:
        return f"It comes into reach at {datetime.fromtimestamp(start_s, UTC):%H:%M}Z."
    if day is not None:
        return "Out of reach for the next 24 hours."
    return f"Nothing of it can be followed for {(track.sky.end_s - track.sky.start_s) / 60.0:.0f} min from now."


def _legs(stretches: Sequence[TrackSegment], course: Curve, *, turns: bool) -> tuple[PlanLeg, ...]:
    legs: list[PlanLeg] = []
    for stretch in stretches:
        turn = stretch.turn if turns else None
        start_deg, end_deg = course.at(stretch.start_s)[0], course.at(stretch.end_s)[0]
        stops = () if stretch.route is None else stretch.route.stops
        if stretch.rewinds and legs:
            before, done_s = legs[-1], stretch.start_s
            if turn is not None and stretch.route is not None:
                turned_s = before.end_s + stretch.route.worst_s
                done_s = turned_s if turned_s < done_s - _AT_ONCE_S else done_s
            legs.append(PlanLeg(PlanPart.REWIND, before.end_s, done_s, before.to_az_deg, start_deg, turn, stops))
            stops = ()
        legs.append(PlanLeg(PlanPart.FOLLOW, stretch.start_s, stretch.end_s, start_deg, end_deg, turn, stops))
    return tuple(legs)


def _element_notes(elements: ElementError | None) -> Iterator[str]:
    if elements is not None and elements.closest.reentry is not None:
        yield f"{elements.unknown[0].upper()}{elements.unknown[1:]}: {STILL_FLIES}."


def _rewind_notes(legs: Sequence[PlanLeg]) -> Iterator[str]:
    for leg in legs:
        if leg.part is PlanPart.REWIND and leg.turn is not None:
            yield (
                f"The cable is too short for the whole pass: it turns back from {leg.from_az_deg:+.0f}° to "
                f"{leg.to_az_deg:+.0f}°, which takes up to {leg.end_s - leg.start_s:.1f} s."
            )
        elif leg.part is PlanPart.REWIND:
            yield f"The cable may reach its stop, as its turn is unknown: {leg.end_s - leg.start_s:.0f} s are kept."


def _hole_note(hole: Keyhole) -> str:
    lost = "" if hole.max_loss_db is None else f", {hole.max_loss_db:.1f} dB,"
    return (
        f"It crosses the keyhole: up to {hole.max_error_deg:.1f}° off{lost} there, where "
        f"{hole.limit_deg:.1f}° is the least possible."
    )


def _beyond_notes(track: TargetTrack, stretches: Sequence[TrackSegment]) -> Iterator[str]:
    """Yield that the dish stays at its ceiling, while the target is less than the tolerance above it."""
    t, over = track.sky.t_s, track.el_deg - track.high_deg
    within = np.zeros(len(t), dtype=np.bool_)
    for one in stretches:
        within |= (t >= one.start_s) & (t <= one.end_s)
    beyond = within & (over > _SEEN_DEG)
    if beyond.any():
        seconds = float(np.gradient(t)[beyond].sum())
        yield (
            f"Above its ceiling the dish waits there while that is near enough: up to {over[beyond].max():.1f}° off "
            f"for {seconds:.0f} s."
        )


def _border_notes(track: TargetTrack) -> Iterator[str]:
    """Yield that a no-go sector keeps the dish from where it may turn the other way round."""
    within = track.el_deg >= track.low_deg
    if (track.bounds.blocked(track.az_deg, track.pointed_el_deg, borders_only=True) & within).any():
        highest = max(keepout.below_deg for keepout in track.bounds.keepouts)
        yield (
            f"Below {highest:.0f}° it is not followed across north or a cable stop. With its turn unknown the dish "
            "may swing through a no-go sector. Home the dish to know its turn."
        )


def _notes(reach: PassReach, mount: Mount) -> Iterator[str]:
    yield from loss_notes(reach, mount.limits)
    if mount.standing is None:
        yield "The dish's position is not known. The move to the first point may take longer."
    if mount.limits.cable is not None and not mount.limits.turn_known:
        yield "The turn of the cable is unknown: only what is safe for every turn is followed."
    if mount.beam is None:
        yield "No loss in dB: the beam width is unknown. Set the feed's band, or its measured width."


def _preposition(track: TargetTrack, course: Curve, before_s: float, now_s: float) -> Preposition | None:
    """Return where the dish waits, the first point of the course, and the way there; None if no way is safe.

    `before_s`: how long before the first leg the dish is to be in place. While the position is not known the way has
    one stop, and begins early enough for the longest slew there is.
    """
    az, el = course.at(course.start_s)
    true_az, true_el = track.mount.alignment.to_true(az, el)
    model, standing = track.mount.model, track.mount.standing
    if standing is None:
        low, high = track.bounds.cable or (0.0, 360.0)
        longest = route(track.bounds, model, (az - (high - low), track.bounds.low_el_deg), (az, el))
        taken: Route | None = Route((az, el), ((az, el),), 60.0 if longest is None else longest.seconds)
    else:
        taken = route(track.bounds, model, (standing.az_deg, standing.el_deg), (az, el))
    if taken is None:
        return None
    leave_s = course.start_s - before_s - taken.seconds - _STOP_S * len(taken.stops)
    return Preposition(az, el, true_az % 360.0, true_el, taken.stops, max(leave_s, now_s), taken.seconds)
