"""Refines a plan in the background: the share of the azimuth's time is chosen by rehearsing the pass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from birdcage.tracking.controller_input import Controller
from birdcage.tracking.curve import Floats
from birdcage.tracking.mount import Mount
from birdcage.tracking.plan import Forecast, Keyhole, Plan, PlanLeg, PlanPart
from birdcage.tracking.planning.assembling import Basis, complete
from birdcage.tracking.planning.itinerary import TrackSegment
from birdcage.tracking.planning.rates import HOLDS, SHARES
from birdcage.tracking.planning.rehearsal import rehearse
from birdcage.tracking.planning.routes import Route
from birdcage.tracking.planning.target_track import TargetTrack
from birdcage.tracking.steering.choice import controller_for

_GOOD_RATIO, _WORTH_DEG = 2.6, 0.5
"""The greatest error in a keyhole is to stay within so many times the physical limit, where that is over half a
degree: a goal that we have set."""
SEEDS = (1, 2)
"""In a keyhole the order of moves hangs on milliseconds of latency: what counts is the worse of some rehearsals."""
_AROUND_S = 20.0
"""How much before and after a keyhole is rehearsed."""


def refine(
    plan: Plan,
    mount: Mount,
    controller: Controller | None = None,
    *,
    preposition_s: float = 60.0,
    shares: Sequence[float] = SHARES,
) -> Plan:
    """Return the plan with the share that leaves the least error, and with the error that the rehearsal has shown.

    `controller` is the one that will steer, by default the one that suits the dish. The mount must be the one that the
    plan was made for. A plan that has nothing to choose, as the axes move together or no keyhole is on the way, comes
    back as it is, but for `refined`. Takes seconds.
    """
    if plan.course is None or plan.share is None or not plan.keyholes:
        return replace(plan, refined=True)
    steers = controller_for(mount.model)[1] if controller is None else controller
    track = TargetTrack.of(plan.sky, mount)
    basis = Basis(
        plan.aim, plan.made_at, plan.passing, plan.reach, track, _stretches(plan, track), preposition_s, plan.elements,
        plan.day,
    )  # fmt: skip
    about = _about(plan)
    tried: list[tuple[Plan, Forecast]] = []
    hard = max(hole.limit_deg for hole in plan.keyholes) > _WORTH_DEG
    for share, hold in product(shares, HOLDS if hard else HOLDS[:1]):
        drawn = complete(basis, share, hold=hold)
        runs = [rehearse(drawn, mount, steers, within=about, seed=seed) for seed in (SEEDS if hard else SEEDS[:1])]
        seen = _spliced(drawn, max(runs, key=lambda run: run.max_deg), about)
        tried.append((complete(basis, share, seen, hold=hold), seen))
    # Not the keyholes of each: of a course that asks for more than the dish can do there may be none.
    return min(tried, key=lambda one: _badness(plan.keyholes, one[1]))[0]


def _badness(holes: Sequence[Keyhole], seen: Forecast) -> tuple[float, float]:
    """Return how much worse than it should be a keyhole is, and then the error on average."""
    excess = 0.0
    for hole in holes:
        near = (seen.t_s >= hole.start_s - _AROUND_S) & (seen.t_s <= hole.end_s + _AROUND_S)
        if near.any():
            excess = max(excess, float(seen.error_deg[near].max()) / max(hole.limit_deg, _WORTH_DEG))
    return max(excess - _GOOD_RATIO, 0.0), seen.rms_deg


def _about(plan: Plan) -> list[tuple[float, float]]:
    """Return the spans about the keyholes: only there does the share matter."""
    found: list[tuple[float, float]] = []
    for hole in plan.keyholes:
        start, end = hole.start_s - _AROUND_S, hole.end_s + _AROUND_S
        if found and start <= found[-1][1]:
            found[-1] = found[-1][0], end
        else:
            found.append((start, end))
    return found


def _spliced(plan: Plan, seen: Forecast, about: Sequence[tuple[float, float]]) -> Forecast:
    """Return the forecast of a plan with what the rehearsal has shown in its place."""
    drawn = plan.forecast
    assert drawn is not None, "a plan with a keyhole has a forecast"
    apart = np.ones(len(drawn.t_s), dtype=np.bool_)
    for start, end in about:
        apart &= (drawn.t_s < start) | (drawn.t_s > end)
    # The averages of the forecast are half a second apart and the errors seen a tenth: of one weight for a second.
    grid = np.arange(seen.t_s[0], seen.t_s[-1], np.median(np.diff(drawn.t_s)))
    inside = np.zeros(len(grid), dtype=np.bool_)
    for start, end in about:
        inside |= (grid >= start) & (grid <= end)
    grid = grid[inside]
    t = np.concatenate([drawn.t_s[apart], grid])
    order = np.argsort(t)

    def joined(drawn_values: Floats, seen_values: Floats) -> Floats:
        both: Floats = np.concatenate([drawn_values[apart], np.interp(grid, seen.t_s, seen_values)])[order]
        return both

    errors = joined(drawn.error_deg, seen.error_deg)
    losses = None
    if drawn.loss_db is not None and seen.loss_db is not None:
        losses = joined(drawn.loss_db, seen.loss_db)
    greatest = max(seen.max_deg, float(errors.max()))
    return Forecast(t[order], errors, losses, float(np.sqrt(np.mean(errors**2))), greatest)


def _stretches(plan: Plan, track: TargetTrack) -> tuple[TrackSegment, ...]:
    """Return the stretches along which a plan was laid."""
    course = plan.course
    assert course is not None, "a plan without a course has no stretches"
    found: list[TrackSegment] = []
    rewind: PlanLeg | None = None
    for leg in plan.legs:
        if leg.part is PlanPart.REWIND:
            rewind = leg
            continue
        stops, taken = leg.waypoints if rewind is None else rewind.waypoints, None
        if stops:
            before_s, there_s = found[-1].end_s, leg.start_s if rewind is None else rewind.end_s
            taken = Route(course.at(before_s), stops, there_s - before_s)
        turn = round((leg.from_az_deg - track.dish.at(leg.start_s)[0]) / 360.0) if leg.turn is None else leg.turn
        found.append(TrackSegment(leg.start_s, leg.end_s, turn, taken, rewind is not None))
        rewind = None
    return tuple(found)
