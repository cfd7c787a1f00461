"""Which turn of the cable follows what, where the turn is known; and when it is turned back, if it must be."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.reach_cable import most_followed
from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.mount import Standing
from birdcage.tracking.move_times import durations
from birdcage.tracking.planning.rates import mean_rate_deg_s
from birdcage.tracking.planning.routes import HOP_DEG, SLOW, STOP_S, route
from birdcage.tracking.planning.target_track import TargetTrack

Spans = Sequence[tuple[float, float]]

_SAMPLES = 600
_LATER = 0.5
"""How much the way to a later pass counts against the way to this one."""
_LATER_PASSES = 4
_NO_WAY_S = 1e6
_HIGH_IS_WORTH = 0.3
"""How much more a second overhead counts than one at the horizon, when a place for a rewind is sought."""
_KEYHOLE_IS_WORTH = 0.3
"""What a second counts in which the azimuth cannot keep up anyway."""
_HIDDEN_IS_WORTH = 0.1
"""What a second counts behind the horizon mask, where nothing is heard."""
_SWITCH_S = 10.0
"""What a rewind must gain at least."""


@dataclass(frozen=True, slots=True)
class CableRun:
    """A time during which the cable keeps its turn."""

    start_s: float
    end_s: float
    turn: int


def runs(track: TargetTrack, spans: Spans, standing: Standing | None, later: Sequence[Curve] = ()) -> list[CableRun]:
    """Return the runs that follow `spans`: one wherever a turn fits all of it, else as few as lose the least.

    A mount without a cable, or with one of unknown turn, has one run, which begins nearest to where the dish stands.
    """
    if not spans:
        return []
    begin, end = spans[0][0], spans[-1][1]
    cable = track.bounds.cable
    if cable is None or not track.bounds.turn_known:
        az = track.at(begin, 0)[0]
        near = az % 360.0 if standing is None else standing.az_deg + (az - standing.az_deg + 180.0) % 360.0 - 180.0
        return [CableRun(begin, end, round((near - az) / 360.0))]
    t = track.sky.t_s
    wanted = _within(t, spans)
    dish = np.concatenate([track.az_deg[wanted], [track.at(edge, 0)[0] for span in spans for edge in span]])
    low, high = float(dish.min()), float(dish.max())
    turns = range(math.ceil((cable[0] - high) / 360.0), math.floor((cable[1] - low) / 360.0) + 1)
    whole = [turn for turn in turns if cable[0] <= low + 360.0 * turn and high + 360.0 * turn <= cable[1]]
    if whole:
        chosen = min(whole, key=lambda turn: _cost_s(track, spans, turn, standing, later))
        return [CableRun(begin, end, chosen)]
    return _most(track, spans, list(turns)) if turns else []


def _cost_s(track: TargetTrack, spans: Spans, turn: int, standing: Standing | None, later: Sequence[Curve]) -> float:
    """Return the time that the ways to this pass and to the later ones take."""
    start, end = track.at(spans[0][0], turn), track.at(spans[-1][1], turn)
    rate = mean_rate_deg_s(track.mount.model.azimuth)
    cable = track.bounds.cable or (0.0, 0.0)
    # The middle of the cable is the better place to be, other things equal.
    cost = abs((start[0] + end[0]) / 2.0 - sum(cable) / 2.0) / rate * (1.0 if standing is None else 1e-3)
    if standing is not None:
        taken = route(track.bounds, track.mount.model, (standing.az_deg, standing.el_deg), start)
        cost += _NO_WAY_S if taken is None else taken.seconds
    return cost + _LATER * _later_deg(track, end[0], later[:_LATER_PASSES]) / rate


def _later_deg(track: TargetTrack, from_deg: float, later: Sequence[Curve]) -> float:
    """Return how far the azimuth must turn at least between the passes that follow, each at a turn that fits it."""
    cable, limits = track.bounds.cable, track.mount.limits
    if not later or cable is None:
        return 0.0
    az = later[0].az_deg[later[0].el_deg >= limits.el_floor_deg] - limits.az_offset_deg
    if not len(az):
        return _later_deg(track, from_deg, later[1:])
    low, high = float(az.min()), float(az.max())
    first, last = math.ceil((cable[0] - low) / 360.0), math.floor((cable[1] - high) / 360.0)
    costs = [
        abs(float(az[0]) + 360.0 * turn - from_deg) + _later_deg(track, float(az[-1]) + 360.0 * turn, later[1:])
        for turn in range(first, last + 1)
    ]
    return min(costs, default=0.0)


def _within(t: Floats, spans: Spans) -> NDArray[np.bool_]:
    inside = np.zeros(len(t), dtype=np.bool_)
    for start, end in spans:
        inside |= (t >= start) & (t <= end)
    return inside


def _rewind_s(track: TargetTrack, az: Floats, el: Floats, turns: int) -> Floats:
    """Return how long it takes at the most to turn the cable by so many turns: from each sample (row) to each (column).

    As `Route.worst_s` has it.
    """
    model = track.mount.model
    ways = np.abs(az[None, :] + 360.0 * turns - az[:, None])
    hops = np.maximum(np.ceil(ways / HOP_DEG), 1.0)
    seconds: Floats = hops * (SLOW * durations(model.azimuth, ways / hops) + STOP_S)
    if track.bounds.keepouts:
        over = max(keepout.below_deg for keepout in track.bounds.keepouts)
        if over > track.bounds.high_el_deg:
            return np.full_like(seconds, np.inf)
        climb = durations(model.elevation, np.maximum(over - el, 0.0))
        seconds += SLOW * (climb[:, None] + climb[None, :]) + 2.0 * STOP_S
    return seconds


def _most(track: TargetTrack, spans: Spans, turns: list[int]) -> list[CableRun]:
    """Return the runs that follow what is worth the most, by the recurrence of `most_followed`.

    What a second is worth: w = 1 + 0.3 sin(elevation), times 0.3 in the keyhole, times 0.1 behind the horizon mask.
    """
    begin, end = spans[0][0], spans[-1][1]
    t = np.linspace(begin, end, min(_SAMPLES, max(60, int(end - begin))))
    az, el = (np.interp(t, track.sky.t_s, values) for values in (track.az_deg, track.pointed_el_deg))
    cable = track.bounds.cable or (-math.inf, math.inf)
    wanted = _within(t, spans)
    worth = np.diff(t) * (1.0 + _HIGH_IS_WORTH * np.sin(np.radians(el[1:])))
    worth[np.abs(np.diff(az) / np.diff(t)) > mean_rate_deg_s(track.mount.model.azimuth)] *= _KEYHOLE_IS_WORTH
    worth[track.hidden(t[1:])] *= _HIDDEN_IS_WORTH
    gains = []
    for turn in turns:
        good = wanted & (az + 360.0 * turn >= cable[0]) & (az + 360.0 * turn <= cable[1])
        gains.append(np.where(good[1:] & good[:-1], worth, 0.0).tolist())
    back: dict[int, Sequence[int]] = {}
    for turns_on in range(1 - len(turns), len(turns)):
        if turns_on:
            in_time = t[:, None] + _rewind_s(track, az, el, turns_on) <= t[None, :]
            latest = len(t) - 1 - np.argmax(in_time[::-1], axis=0)
            back[turns_on] = np.where(in_time.any(axis=0), latest, -1).tolist()
    found = [
        CableRun(float(t[first]), float(t[last]), turns[index])
        for first, last, index in most_followed(gains, back, _SWITCH_S, late=False)
    ]
    return [run for run in found if run.end_s > run.start_s]
