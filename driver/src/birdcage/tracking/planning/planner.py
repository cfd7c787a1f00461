"""Makes the plan of a pass, before the dish moves (`docs/tracking.md`, *Plan first*)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from typing import TYPE_CHECKING

from birdcage.base.errors import BirdcageError
from birdcage.sky.element_error import ElementError, element_error
from birdcage.sky.frames import posix_s
from birdcage.sky.observer import Observer
from birdcage.sky.passes.model import Pass
from birdcage.sky.reach_model import LossReason, Lost, PassReach, Stretch
from birdcage.sky.targets.model import Satellite, SlotTarget, Target
from birdcage.tracking.curve import Curve
from birdcage.tracking.day import HOURS, Day
from birdcage.tracking.mount import Mount
from birdcage.tracking.plan import Plan, PlanTarget
from birdcage.tracking.planning.assembling import Basis, complete, unfollowed
from birdcage.tracking.planning.incidents import where_words
from birdcage.tracking.planning.itinerary import Itinerary, itinerary
from birdcage.tracking.planning.rates import FIRST_SHARE
from birdcage.tracking.planning.refining import refine
from birdcage.tracking.planning.refraction import Refraction, lift_deg
from birdcage.tracking.planning.sky_path import sky_path
from birdcage.tracking.planning.target_track import TargetTrack

if TYPE_CHECKING:
    from birdcage.sky.downlinks import Downlink

__all__ = ["plan_pass", "refine"]

_LEAST_S = 2.0
"""Of a pass that is nearly over a plan is made for so long at least, so that there is a path to draw."""
_SHORTEST_S = 1e-3


def plan_pass(
    target: Target,
    observer: Observer,
    mount: Mount,
    now: datetime,
    *,
    passing: Pass | None = None,
    frequency_hz: float | None = None,
    downlink: Downlink | None = None,
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
    if target.kind == "fixed":
        refraction = "none"  # it is where the beam is to point, as in a go-to
    now_s = posix_s(now)
    if passing is not None and passing.already_up and passing.still_up:
        passing = None
    if passing is None:
        start_s, end_s = now_s, now_s + hours * 3600.0
    else:
        start_s, end_s = posix_s(passing.aos) + time_offset_s, posix_s(passing.los) + time_offset_s
    sky = sky_path(
        target, observer, start_s, max(end_s, start_s + _LEAST_S), refraction=refraction, time_offset_s=time_offset_s
    )
    own_offset_s = target.time_offset_s if isinstance(target, Satellite) else 0.0
    aim = PlanTarget(
        target.name, target.kind, target.elements.norad_id if isinstance(target, Satellite) else None,
        frequency_hz, own_offset_s + time_offset_s, refraction,
        target.skew(observer) if isinstance(target, SlotTarget) else None, downlink,
    )  # fmt: skip
    believed = None
    if isinstance(target, Satellite):
        believed = element_error(target.elements, observer, sky.start_s, sky.end_s, aim.time_offset_s)
    day = None if passing is not None else _day_ahead(target, observer, mount, now_s, refraction, time_offset_s)
    return _plan(aim, sky, mount, now, passing, next_tracks, preposition_s, believed, day)


def _plan(
    aim: PlanTarget, sky: Curve, mount: Mount, now: datetime, passing: Pass | None, later: Sequence[Curve],
    preposition_s: float, elements: ElementError | None, day: Day | None,
) -> Plan:  # fmt: skip
    track = TargetTrack.of(sky, mount)
    now_s = posix_s(now)
    planned = itinerary(track, now_s, later)
    reach = _reached(track, planned)
    if not planned.stretches or mount.model.no_following:
        return unfollowed(aim, now, passing, reach, track, elements, day)
    share = None if mount.model.axes_together else FIRST_SHARE
    return complete(Basis(aim, now, passing, reach, track, planned.stretches, preposition_s, elements, day), share)


def _day_ahead(
    target: Target, observer: Observer, mount: Mount, start_s: float, refraction: Refraction, time_offset_s: float
) -> Day | None:
    """Return the day of what does not pass, from a time on (POSIX seconds); None if a position is not always known."""
    end_s = start_s + HOURS * 3600.0
    try:
        sky = sky_path(target, observer, start_s, end_s, refraction=refraction, time_offset_s=time_offset_s)
    except BirdcageError:
        return None
    reach = TargetTrack.of(sky, mount).reached()
    limits = tuple(where_words(cause, mount.limits) for cause in reach.lost_s)
    return Day(sky, reach, limits, float(lift_deg(0.0, refraction)))


def _reached(track: TargetTrack, planned: Itinerary) -> PassReach:
    """Return the reach with the turns that the plan takes, less what it loses to turning the cable back."""
    whole = track.reached()
    if track.bounds.cable is None or not track.bounds.turn_known:
        return whole
    kept: list[Stretch] = []
    lost = list(whole.lost)
    for one in whole.intervals:
        for start, end, reason in _divided(one.start_s, one.end_s, planned.cuts):
            if reason:
                lost.append(Lost(_utc(start), _utc(end), reason))
            else:
                kept.append(Stretch(_utc(start), _utc(end), _turn(planned, (start + end) / 2.0)))
    best = whole.best_el_deg if kept else None
    if best is not None and planned.cuts:
        sky = track.sky
        tops = [sky.el_deg[(sky.t_s >= one.start_s - 0.5) & (sky.t_s <= one.end_s + 0.5)].max() for one in kept]
        best = min(best, float(max(tops)))
    return PassReach(tuple(kept), tuple(sorted(lost, key=lambda each: each.start)), best)


def _divided(
    start: float, end: float, cuts: tuple[tuple[float, float, LossReason], ...]
) -> Iterator[tuple[float, float, LossReason | None]]:
    """Yield the parts of an interval, each with why it is lost, or None."""
    at = start
    for cut_start, cut_end, reason in cuts:
        left, right = max(cut_start, at), min(cut_end, end)
        if right - left <= _SHORTEST_S:
            continue
        if left - at > _SHORTEST_S:
            yield at, left, None
        yield left, right, reason
        at = right
    if end - at > _SHORTEST_S:
        yield at, end, None


def _turn(planned: Itinerary, t_s: float) -> int | None:
    """Return the turn of the stretch at a time, or of the nearest one."""
    near = min(planned.stretches, key=lambda one: max(one.start_s - t_s, t_s - one.end_s, 0.0), default=None)
    return None if near is None else near.turn


def _utc(t_s: float) -> datetime:
    return datetime.fromtimestamp(t_s, UTC)
