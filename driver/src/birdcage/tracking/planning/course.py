"""The course: where the dish is to stand at each time, along the stretches and on the ways between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.planning.itinerary import TrackSegment
from birdcage.tracking.planning.keyhole_path import Corridor, best_elevation, least_error_deg, limited, through
from birdcage.tracking.planning.rates import azimuth_rates_deg_s, mean_rate_deg_s
from birdcage.tracking.planning.routes import sampled
from birdcage.tracking.planning.target_track import TargetTrack

_Piece = tuple[Floats, Floats, Floats]

_JOINT_S = 1e-3
"""A corner gets a second point so near on either side, and the cubic stays at the corner."""
_SHARP_DEG = 0.004
"""A change of rate that makes less than this within a step swings out by a tenth of it at most."""


def course(track: TargetTrack, stretches: Sequence[TrackSegment], share: float | None, hold: float = 0.0) -> Curve:
    """Return the course from the first stretch to the last; `share` as in `Plan`. ValueError without a stretch.

    `hold`: how far below the top the elevation stays while the azimuth sweeps, in units of what both axes at once would
    be off there: an axis that stays leaves the other one all the time.
    """
    pieces: list[_Piece] = []
    for group, last in _groups(stretches):
        taken = group[0].route
        if pieces and taken is not None:
            on_way = sampled(taken, track.mount.model, float(pieces[-1][0][-1]))
            pieces.append(_kept_before(on_way, group[0].start_s))
        pieces.append(_followed(track, group, share, hold, first=not pieces, last=last))
    t, az, el = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    rising = np.concatenate(([True], np.diff(t) > _JOINT_S / 10.0))
    return _cornered(t[rising], az[rising], el[rising])


def limit_deg(track: TargetTrack, stretches: Sequence[TrackSegment], start_s: float, end_s: float) -> float:
    """Return the least greatest error that both axes at once could keep around a time, at their greatest speeds."""
    found = 0.0
    rate = mean_rate_deg_s(track.mount.model.azimuth)
    for group, _ in _groups(stretches):
        if group[0].start_s < end_s and group[-1].end_s > start_s:
            corridor = _corridor(track, group, first=True, last=True)
            found = max(found, least_error_deg(corridor, np.full(len(corridor.t_s), rate)))
    return found


def _groups(stretches: Sequence[TrackSegment]) -> list[tuple[list[TrackSegment], bool]]:
    """Return the stretches that the dish follows in one go, each group with whether it is the last."""
    groups: list[list[TrackSegment]] = []
    for stretch in stretches:
        if groups and stretch.route is None:
            groups[-1].append(stretch)
        else:
            groups.append([stretch])
    return [(group, group is groups[-1]) for group in groups]


def _followed(
    track: TargetTrack, group: list[TrackSegment], share: float | None, hold: float, *, first: bool, last: bool
) -> _Piece:
    corridor = _corridor(track, group, first=first, last=last)
    model, t = track.mount.model, corridor.t_s
    top_deg = _top_deg(track, corridor, hold)
    az = through(corridor, azimuth_rates_deg_s(model, t, np.minimum(corridor.el_deg, top_deg), share))
    el = np.minimum(best_elevation(az - corridor.az_deg, corridor.el_deg), top_deg)
    floor, ceiling = track.elevations(t)
    way = np.concatenate(([0.0], np.cumsum(np.diff(t)))) * mean_rate_deg_s(model.elevation)
    el = limited(np.clip(el, floor, ceiling), way)
    return t, az, el


def _top_deg(track: TargetTrack, corridor: Corridor, hold: float) -> float:
    """Return the elevation that is not exceeded, so that the azimuth need not wait for it."""
    if hold <= 0.0:
        return np.inf
    rate = mean_rate_deg_s(track.mount.model.azimuth)
    below_deg = hold * least_error_deg(corridor, np.full(len(corridor.t_s), rate))
    if below_deg <= 0.0:
        return np.inf
    # Never down into a no-go sector, which the azimuth may cross above it.
    sectors = (keepout.below_deg for keepout in track.bounds.keepouts)
    return max((float(corridor.el_deg.max()) - below_deg, *sectors))


def _corridor(track: TargetTrack, group: list[TrackSegment], *, first: bool, last: bool) -> Corridor:
    """Return where the dish may be during a group. Its ends are fixed where a way begins or ends there."""
    start, end, turn = group[0].start_s, group[-1].end_s, group[0].turn
    sky_t = track.sky.t_s
    inner = sky_t[(sky_t > start + 2.0 * _JOINT_S) & (sky_t < end - 2.0 * _JOINT_S)]
    edges = [edge for one in group for edge in (one.start_s, one.end_s)][1:-1]
    corners = [at for at in _corners(track) if start < at < end]
    t = np.unique(np.concatenate(([start, start + _JOINT_S], inner, edges, corners, [end - _JOINT_S, end])))
    az, el = track.dish.sample(t)
    floor, ceiling = track.elevations(t)
    az, el = az + 360.0 * turn, np.clip(el, floor, ceiling)
    low, high = np.full(len(t), -np.inf), np.full(len(t), np.inf)
    if track.bounds.cable is not None and track.bounds.turn_known:
        low[:], high[:] = track.bounds.cable
        az = np.clip(az, low, high)
    for keepout in track.bounds.keepouts:
        under = el < keepout.below_deg
        back, on = keepout.beside(az)
        low = np.where(under, np.maximum(low, az - back), low)
        high = np.where(under, np.minimum(high, az + on), high)
    wanted = np.zeros(len(t), dtype=np.bool_)
    for one in group:
        wanted |= (t >= one.start_s) & (t <= one.end_s)
    if not first:
        low[0] = high[0] = az[0]
    if not last:
        low[-1] = high[-1] = az[-1]
    return Corridor(t, az, el, low, high, ceiling, wanted)


def _corners(track: TargetTrack) -> list[float]:
    """Return times about every moment at which the target crosses the floor or the ceiling, where the dish turns."""
    t, found = track.sky.t_s, []
    for beyond in (track.el_deg - track.low_deg, track.high_deg - track.el_deg):
        before = np.flatnonzero((beyond[:-1] < 0.0) != (beyond[1:] < 0.0))
        share = beyond[before] / (beyond[before] - beyond[before + 1])
        found += (t[before] + share * (t[before + 1] - t[before])).tolist()
    return [at + by for at in found for by in (-_JOINT_S, 0.0, _JOINT_S)]


def _kept_before(piece: _Piece, end_s: float) -> _Piece:
    """Return a way, a touch faster where it would end too late, and with the wait at its end where it ends early."""
    t, az, el = piece
    if not len(t):
        return piece
    until_s = end_s - _JOINT_S
    if t[-1] >= until_s:
        begin = t[0] - _JOINT_S
        return begin + (t - begin) * (until_s - begin) / (t[-1] - begin), az, el
    return np.append(t, until_s), np.append(az, az[-1]), np.append(el, el[-1])


def _cornered(t: Floats, az: Floats, el: Floats) -> Curve:
    """Return the curve through points, with further ones about its corners: a cubic must not swing out beyond them."""
    steps = np.diff(t)
    slopes = [np.diff(values) / steps for values in (az, el)]
    widest = np.maximum(steps[1:], steps[:-1])
    bend = np.maximum(*(np.abs(np.diff(slope)) for slope in slopes)) * widest
    sharp = np.flatnonzero(bend > _SHARP_DEG) + 1
    before, after = sharp[steps[sharp - 1] > 3.0 * _JOINT_S], sharp[steps[sharp] > 3.0 * _JOINT_S]
    times = np.concatenate([t, t[before] - _JOINT_S, t[after] + _JOINT_S])
    order = np.argsort(times)
    found = [
        np.concatenate([values, values[before] - slope[before - 1] * _JOINT_S, values[after] + slope[after] * _JOINT_S])
        for values, slope in zip((az, el), slopes, strict=True)
    ]
    return Curve(times[order], found[0][order], found[1][order])
