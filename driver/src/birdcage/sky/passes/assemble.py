"""Step 7: events to passes. A pass is a run `rise, turning points, set` of one satellite."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.elements import ElementSet
from birdcage.sky.frames import Floats
from birdcage.sky.passes.exact import RISE, SET, TURN, Events
from birdcage.sky.passes.ground import ObserverTrack
from birdcage.sky.passes.nodes import Indices
from birdcage.sky.passes.table import Failure, PassTable


def assemble(
    fleet: Sequence[ElementSet], base: int, ground: ObserverTrack, events: Events, first: Floats, last: Floats,
    span_s: float, failed: tuple[Failure, ...],
) -> PassTable:  # fmt: skip
    """Return the passes that these events make.

    Events count satellites from `base` in the fleet on; `first` and `last` are the positions (n, 3) of these at both
    ends of the search. A run without its rise or set, cut off where SGP4 gave up, is
    no pass; nor is one whose highest point SGP4 puts below the mask.
    """
    satellite, kind, t, r, edge = _with_ends(ground, events, first, last, span_s)
    sine = ground.sine(t, r)
    begin, end = _runs(satellite, kind)
    best = _highest(sine, begin, end)
    real = ((kind[best] == TURN) | edge[best]) & (sine[best] > ground.sin_mask)
    begin, best, end = begin[real], best[real], end[real]
    order = np.argsort(t[begin], kind="stable")
    begin, best, end = begin[order], best[order], end[order]
    azimuth_deg = ground.azimuth_deg(t, r)
    return PassTable(
        fleet=fleet,
        fleet_index=base + satellite[begin],
        aos_s=ground.start_s + t[begin],
        tca_s=ground.start_s + t[best],
        los_s=ground.start_s + t[end],
        aos_azimuth_deg=azimuth_deg[begin],
        tca_azimuth_deg=azimuth_deg[best],
        los_azimuth_deg=azimuth_deg[end],
        max_elevation_deg=np.degrees(np.arcsin(np.clip(sine[best], -1.0, 1.0))),
        already_up=edge[begin],
        still_up=edge[end],
        failed=failed,
    )


def _with_ends(
    ground: ObserverTrack, events: Events, first: Floats, last: Floats, span_s: float
) -> tuple[Indices, NDArray[np.int8], Floats, Floats, NDArray[np.bool_]]:
    """Return the events in order, with a rise at the start and a set at the end for who is up there.

    The last array is True for these.
    """
    n = len(first)
    begins = np.flatnonzero(ground.sine(np.zeros(n), first.T) > ground.sin_mask)
    ends = np.flatnonzero(ground.sine(np.full(n, span_s), last.T) > ground.sin_mask)
    satellite = np.concatenate((events.satellite, begins, ends))
    kind = np.concatenate((events.kind, np.full(len(begins), RISE, np.int8), np.full(len(ends), SET, np.int8)))
    t = np.concatenate((np.clip(events.t, 0.0, span_s), np.zeros(len(begins)), np.full(len(ends), span_s)))
    r = np.concatenate((events.r, first[begins].T, last[ends].T), axis=1)
    edge = np.arange(len(t)) >= len(events.t)
    order = np.lexsort((kind, t, satellite))
    return satellite[order], kind[order], t[order], r[:, order], edge[order]


def _runs(satellite: Indices, kind: NDArray[np.int8]) -> tuple[Indices, Indices]:
    """Return the rise and the set of each run: each rise with the next set, where both are of one satellite."""
    begin, end = np.flatnonzero(kind == RISE), np.flatnonzero(kind == SET)
    following = np.searchsorted(end, begin)
    has_set = following < len(end)
    next_rise = np.append(begin[1:], len(kind))[has_set]
    begin, end = begin[has_set], end[following[has_set]]
    whole = (satellite[begin] == satellite[end]) & (end < next_rise)
    return begin[whole], end[whole]


def _highest(sine: Floats, begin: Indices, end: Indices) -> Indices:
    """Return the event with the greatest elevation of each run, its ends included."""
    best = begin.copy()
    if len(begin):
        bounds = np.stack((begin, end + 1), axis=1).reshape(-1)
        top = np.maximum.reduceat(np.append(sine, -2.0), bounds)[::2]
        lengths = end - begin + 1
        run = np.repeat(np.arange(len(begin)), lengths)
        event = np.arange(len(run)) - np.repeat(np.cumsum(lengths) - lengths, lengths) + begin[run]
        at_top = sine[event] == top[run]
        best[run[at_top]] = event[at_top]
    return best
