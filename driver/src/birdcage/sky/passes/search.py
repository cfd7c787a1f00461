"""All passes of many satellites over one place, in one search.

What it does, a room of this package for each step:

1. `orbits`: leave out who never comes near the observer's latitude; group the rest by angular rate at perigee.
2. `nodes`: five SGP4 positions for each turn at that rate, for a whole group at once;
3. the satellite's height over the observer's horizontal plane throws most intervals between nodes away.
4. `brackets`: on the rest, a quintic Hermite polynomial (`quintic`), a sub-grid on it, and the crossings of the mask
   and turning points between its points.
5. `newton`: these on the polynomial, all at once.
6. `exact`: SGP4 itself at each event.
7. `assemble`: runs of events are passes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.frames import Floats, posix_s
from birdcage.sky.observer import Observer
from birdcage.sky.passes import brackets, newton
from birdcage.sky.passes.assemble import assemble
from birdcage.sky.passes.exact import RISE, SET, TURN, Events, Exact, Guesses
from birdcage.sky.passes.ground import ObserverTrack
from birdcage.sky.passes.nodes import Intervals, OrbitEnd, groups, sample
from birdcage.sky.passes.orbits import Orbits
from birdcage.sky.passes.table import Failure, PassTable
from birdcage.sky.propagate import Codes, Fleet, sgp4_complaint

_SLAB = 2048
"""Satellites that are searched at once, which bounds the memory."""
_STATES = 150_000
"""SGP4 states that are held at once."""
_FIRST_PART = 64
_DOUBTFUL = 4e-3
"""How far (in the sine of the elevation) the polynomial may be wrong about who reaches the mask, with much to spare."""


def search(
    fleet: Fleet, observer: Observer, start: datetime, hours: float, min_elevation_deg: float = 0.0,
    time_offsets: Mapping[int, float] | None = None,
) -> PassTable:  # fmt: skip
    """Return every pass of every satellite of `fleet` within `hours` of `start`, in order of AOS.

    A pass is the time above `min_elevation_deg` (geometric, -90 < mask < 90). `time_offsets`: how many seconds
    later than computed a satellite comes, by its index in the fleet. Satellites without a position, decayed or with
    elements that are no orbit, are named in `failed`. ValueError for a naive time, a span that is not above 0, or no
    such mask.
    """
    ground = _ground(observer, start, hours, min_elevation_deg)
    return PassTable.joined(list(_parts(fleet, ground, hours * 3600.0, time_offsets or {}, _SLAB)))


def search_in_parts(
    fleet: Fleet, observer: Observer, start: datetime, hours: float, min_elevation_deg: float = 0.0,
    time_offsets: Mapping[int, float] | None = None,
) -> Iterator[PassTable]:  # fmt: skip
    """Yield what `search` returns, a few satellites at a time, in the order of the fleet: the first part comes soon.

    Closing the iterator ends the search. Each table is in order of AOS; `PassTable.joined` makes one of them.
    """
    ground = _ground(observer, start, hours, min_elevation_deg)
    return _parts(fleet, ground, hours * 3600.0, time_offsets or {}, _FIRST_PART)


def _ground(observer: Observer, start: datetime, hours: float, min_elevation_deg: float) -> ObserverTrack:
    if not (math.isfinite(hours) and hours > 0.0):
        raise ValueError(f"no span to search: {hours} hours")
    if not abs(min_elevation_deg) < 90.0:
        raise ValueError(f"no elevation to rise above: {min_elevation_deg} degrees")
    return ObserverTrack.of(observer, posix_s(start), hours * 3600.0, min_elevation_deg)


def _parts(
    fleet: Fleet, ground: ObserverTrack, span_s: float, time_offsets: Mapping[int, float], part: int
) -> Iterator[PassTable]:
    begin = 0
    error, r, v = fleet.states(ground.start_s, time_offsets)
    while begin < len(fleet) or not begin:
        end = min(begin + part, len(fleet))
        offsets = {index - begin: shift for index, shift in time_offsets.items() if begin <= index < end}
        some = slice(begin, end)
        yield _search(fleet, begin, ground, span_s, offsets, error[some], r[some], v[some])
        begin, part = max(end, 1), min(part * 4, _SLAB)


def _search(
    fleet: Fleet, base: int, ground: ObserverTrack, span_s: float, offsets: Mapping[int, float],
    error: Codes, first: Floats, velocity: Floats,
) -> PassTable:  # fmt: skip
    """Search the satellites from `base` on, of which error, position and velocity at the start are given.

    From here on they are counted from 0, and times are seconds from the start.
    """
    satrecs = fleet.satrecs[base : base + len(first)]
    orbits = Orbits.of(first, velocity)
    last = np.full_like(first, np.nan)
    stops = [OrbitEnd(int(index), int(error[index]), 0.0) for index in np.flatnonzero(error)]
    kept: list[Intervals] = []
    for step_s, offset_s, members in groups(orbits, np.flatnonzero(orbits.may_rise(ground)), offsets):
        batch = max(1, int(_STATES / (span_s / step_s + 2.0)))
        for some in np.split(members, range(batch, len(members), batch)):
            sampled = sample(satrecs, ground, orbits, some, span_s, step_s, offset_s)
            kept.append(sampled.intervals)
            last[some] = sampled.last
            stops.extend(sampled.stops)
    events = _events(ground, Intervals.joined(kept), Exact(satrecs, ground, offsets))
    return assemble(fleet, base, ground, events, first, last, span_s, _failures(fleet, base, ground, stops))


def _failures(fleet: Fleet, base: int, ground: ObserverTrack, stops: list[OrbitEnd]) -> tuple[Failure, ...]:
    return tuple(
        Failure(
            fleet_index=base + stop.satellite,
            name=fleet[base + stop.satellite].name,
            norad_id=fleet[base + stop.satellite].norad_id,
            t_s=ground.start_s + stop.t_s,
            why=sgp4_complaint(stop.code),
        )
        for stop in sorted(stops, key=lambda stop: stop.satellite)
    )


def _events(ground: ObserverTrack, intervals: Intervals, exact: Exact) -> Events:
    """Return the rises, sets and highest points of all intervals, where SGP4 puts them."""
    found = brackets.find(ground, intervals)
    turns = newton.turning_points(ground, intervals, found.turns, found.highest)
    near = np.where(found.highest, turns.above, -turns.above) > -_DOUBTFUL
    s = newton.crossings(ground, intervals, found.crossings, found.rising)
    guesses = Guesses.joined(
        [
            Guesses.on(intervals, found.crossings.interval, s, np.where(found.rising, RISE, SET)),
            _turns(intervals, found, turns, near & ~found.lonely),
            _hidden(exact, _turns(intervals, found, turns, near & found.lonely)),
        ]
    )
    return exact.refine(guesses)


def _turns(intervals: Intervals, found: brackets.AllBrackets, turns: newton.Turns, which: NDArray[np.bool_]) -> Guesses:
    s = turns.s[which]
    return Guesses.on(intervals, found.turns.interval[which], s, np.full(len(s), TURN))


def _hidden(exact: Exact, turns: Guesses) -> Guesses:
    """Return the lonely maxima that SGP4 puts above the mask and minima that it puts below, each with both crossings.

    A parabola through the turning point says where the crossings are.
    """
    settled = exact.refine(turns)
    above, bend = exact.bends(settled)
    peak, dip = (above > 0.0) & (bend < 0.0), (above < 0.0) & (bend > 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        half_s = np.sqrt(np.abs(2.0 * above / bend))
    before = settled.guesses(peak | dip, np.where(peak, RISE, SET), -half_s)
    after = settled.guesses(peak | dip, np.where(peak, SET, RISE), half_s)
    return Guesses.joined([before, settled.guesses(peak, np.full(len(peak), TURN), np.zeros(len(peak))), after])
