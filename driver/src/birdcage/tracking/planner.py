"""Makes the plan of a pass, before the dish moves (DESIGN section 7, reference `tracking.md` section 3.5)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import datetime

from birdcage.sky.frames import posix_s
from birdcage.sky.observer import Observer
from birdcage.sky.passes.model import Pass
from birdcage.sky.targets.model import Satellite, Target
from birdcage.tracking.course import course as course_of
from birdcage.tracking.curve import Curve
from birdcage.tracking.forecast import forecast
from birdcage.tracking.holes import keyholes
from birdcage.tracking.incidents import incidents, loss_notes
from birdcage.tracking.itinerary import Stretch, itinerary
from birdcage.tracking.mount import Mount
from birdcage.tracking.plan import Aim, Leg, Part, Plan
from birdcage.tracking.preposition import preposition
from birdcage.tracking.rates import FIRST_SHARE
from birdcage.tracking.reached import reached
from birdcage.tracking.refraction import Refraction
from birdcage.tracking.sight import Sight
from birdcage.tracking.sky_path import sky_path

_LEAST_S = 2.0
"""Of a pass that is nearly over a plan is made for so long at least, so that there is a path to draw."""


def plan_pass(
    target: Target,
    observer: Observer,
    mount: Mount,
    now: datetime,
    *,
    passing: Pass | None = None,
    frequency_hz: float | None = None,
    refraction: Refraction = "radio",
    time_offset_s: float = 0.0,
    next_tracks: Sequence[Curve] = (),
    preposition_s: float = 60.0,
    hours: float = 1.0,
) -> Plan:
    """Return what a dish will do to follow a target through one pass, or for `hours` from now where none is given.

    `time_offset_s`: how much later than computed a satellite comes, beyond what its target says. `next_tracks`: where
    the targets after this one will be (`Plan.sky` of theirs): they decide between turns of the cable that suit this
    pass equally well. `preposition_s`: how long before the first leg the dish is to be in place.

    BirdcageError where a position is not known at some time; ValueError for a naive time.
    """
    now_s = posix_s(now)
    if passing is None or (passing.already_up and passing.still_up):
        start_s, end_s = now_s, now_s + hours * 3600.0
    else:
        start_s, end_s = posix_s(passing.aos) + time_offset_s, posix_s(passing.los) + time_offset_s
    sky = sky_path(
        target, observer, start_s, max(end_s, start_s + _LEAST_S), refraction=refraction, time_offset_s=time_offset_s
    )
    own_offset_s = target.time_offset_s if isinstance(target, Satellite) else 0.0
    aim = Aim(
        target.name, target.kind, target.elements.norad_id if isinstance(target, Satellite) else None,
        frequency_hz, own_offset_s + time_offset_s,
    )  # fmt: skip
    return _plan(aim, sky, mount, now, passing, next_tracks, preposition_s)


def _plan(
    aim: Aim, sky: Curve, mount: Mount, now: datetime, passing: Pass | None, later: Sequence[Curve],
    preposition_s: float,
) -> Plan:  # fmt: skip
    sight = Sight.of(sky, mount)
    now_s = posix_s(now)
    planned = itinerary(sight, now_s, later)
    reach = reached(sight, planned)
    notes = [*loss_notes(reach, mount.limits), *_unknowns(mount)]
    if not planned.stretches:
        found = incidents(passing, sky, (), (), reach, mount.limits)
        notes.insert(0, "Nothing of it can be followed from now on.")
        return Plan(aim, now, passing, reach, sky, None, (), None, (), None, found, tuple(notes))
    share = None if mount.model.axes_together else FIRST_SHARE
    course = course_of(sight, planned.stretches, share)
    legs = _legs(planned.stretches, course, turns=sight.bounds.cable is not None and sight.bounds.turn_known)
    holes = keyholes(sight, planned.stretches, course)
    place = preposition(sight, course, preposition_s, now_s)
    if place is None:
        notes.insert(0, "No way to where it begins keeps clear of the no-go sectors.")
    return Plan(
        aim, now, passing, reach, sky, course, legs, place, holes,
        forecast(sight, planned.stretches, course, mount.beam_deg_at(aim.frequency_hz)),
        incidents(passing, sky, legs, holes, reach, mount.limits),
        (*_rewind_notes(legs), *(_hole_note(hole.max_error_deg, hole.limit_deg) for hole in holes), *notes),
        share, share is None or not holes,
    )  # fmt: skip


def stretches_of(plan: Plan) -> tuple[Stretch, ...]:
    """Return the stretches that a plan was laid along, without their ways."""
    found: list[Stretch] = []
    rewound = False
    for leg in plan.legs:
        if leg.part is Part.REWIND:
            rewound = True
            continue
        found.append(Stretch(leg.start_s, leg.end_s, leg.turn or 0, None, rewound))
        rewound = False
    return tuple(found)


def _legs(stretches: Sequence[Stretch], course: Curve, *, turns: bool) -> tuple[Leg, ...]:
    legs: list[Leg] = []
    for stretch in stretches:
        turn = stretch.turn if turns else None
        start_deg, end_deg = course.at(stretch.start_s)[0], course.at(stretch.end_s)[0]
        stops = () if stretch.route is None else stretch.route.stops
        if stretch.rewinds and legs:
            before = legs[-1]
            legs.append(Leg(Part.REWIND, before.end_s, stretch.start_s, before.to_az_deg, start_deg, turn, stops))
            stops = ()
        legs.append(Leg(Part.FOLLOW, stretch.start_s, stretch.end_s, start_deg, end_deg, turn, stops))
    return tuple(legs)


def _rewind_notes(legs: Sequence[Leg]) -> Iterator[str]:
    for leg in legs:
        if leg.part is Part.REWIND and leg.turn is not None:
            yield (
                f"The cable does not reach all the way: it is turned back from {leg.from_az_deg:+.0f}° to "
                f"{leg.to_az_deg:+.0f}°, which takes {leg.end_s - leg.start_s:.1f} s."
            )
        elif leg.part is Part.REWIND:
            yield f"The cable may come to its stop, as its turn is not known: {leg.end_s - leg.start_s:.0f} s are kept."


def _hole_note(error_deg: float, limit_deg: float) -> str:
    return (
        f"It goes through the keyhole: up to {error_deg:.1f}° off there, where {limit_deg:.1f}° is the least possible."
    )


def _unknowns(mount: Mount) -> Iterator[str]:
    if mount.standing is None:
        yield "Where the dish stands is not known: the way to the first point may be longer."
    if mount.limits.cable is not None and not mount.limits.turn_known:
        yield "The turn of the cable is not known: only what is safe for every turn is followed."
    if mount.beam_deg is None:
        yield "The feed does not say how wide its beam is: no decibels."
