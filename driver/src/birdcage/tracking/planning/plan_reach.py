"""The reach of a plan: as every page tells it, less what this plan loses to turning the cable back."""

from __future__ import annotations

from collections.abc import Iterator
from datetime import UTC, datetime

from birdcage.sky.reach_model import LossReason, Lost, PassReach, Stretch
from birdcage.tracking.planning.itinerary import Itinerary
from birdcage.tracking.planning.target_track import TargetTrack

_SHORTEST_S = 1e-3


def reached(track: TargetTrack, planned: Itinerary) -> PassReach:
    """Return the reach with the turns that the plan takes."""
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
