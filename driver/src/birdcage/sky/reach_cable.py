"""Which turn of the cable follows which part of a pass (`birdcage.sky.reach`)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.reach_limits import ReachLimits

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_SWITCH_S = 1e-3
"""What a rewind costs beyond its time: where two ways are equal, the one without it wins."""


@dataclass(frozen=True, slots=True)
class Run:
    """Samples `first` to `last` with one turn of the cable, or safe for each of `turns` where it is not known."""

    first: int
    last: int
    turns: tuple[int, ...]


def runs_of(t: Floats, az: Floats, allowed: Bools, limits: ReachLimits) -> list[Run]:
    """Return which samples can be followed, at which turn k: the cable stands at azimuth - offset + 360 k.

    `az` is unrolled and true; samples that are not `allowed` need not be followed. Between two runs the dish rewinds,
    which takes the whole range of the cable at its greatest rate. Without a cable there is one run, of turn 0.
    """
    cable, indices = limits.cable, np.flatnonzero(allowed)
    if not len(indices):
        return []
    if cable is None:
        return [Run(0, len(t) - 1, (0,))]
    low, high = cable
    dish = az - limits.az_offset_deg
    wanted = dish[indices]
    turns = range(math.ceil((low - wanted.max()) / 360.0), math.floor((high - wanted.min()) / 360.0) + 1)
    if not turns:
        return []
    rewind_s = max(high - low, 360.0) / limits.az_rate_deg_s if limits.az_rate_deg_s else 0.0
    fits = {turn: (dish + 360.0 * turn >= low) & (dish + 360.0 * turn <= high) for turn in turns}
    if not limits.turn_known:
        # With less than a circle of cable and the turn unknown, the gate refuses every motion.
        return _safe_for_all(t, allowed, fits, rewind_s) if high - low >= 360.0 else []
    whole = [turn for turn in turns if fits[turn][indices].all()]
    if whole:
        room = {turn: min(wanted.min() + 360.0 * turn - low, high - wanted.max() - 360.0 * turn) for turn in whole}
        return [Run(0, len(t) - 1, (max(whole, key=lambda turn: float(room[turn])),))]
    return _most(t, allowed, fits, rewind_s)


def _safe_for_all(t: Floats, allowed: Bools, fits: dict[int, Bools], rewind_s: float) -> list[Run]:
    """Go on while every turn at which the cable may have begun still fits, then rewind and begin anew."""
    runs: list[Run] = []
    begin = 0
    while len(ahead := np.flatnonzero(allowed[begin:])):
        first = begin + int(ahead[0])
        turns = tuple(turn for turn, fit in fits.items() if fit[first])
        safe = np.logical_and.reduce([fits[turn] for turn in turns])
        stops = np.flatnonzero((allowed & ~safe)[first:])
        end = first + int(stops[0]) if len(stops) else len(t)
        runs.append(Run(first, end - 1, turns))
        begin = max(end, int(np.searchsorted(t, t[end - 1] + rewind_s)))
    return runs


def _most(t: Floats, allowed: Bools, fits: dict[int, Bools], rewind_s: float) -> list[Run]:
    """Return the runs that follow for the longest time in all, by dynamic programming over samples and turns."""
    turns, count = list(fits), len(t)
    steps = np.diff(t)
    # How much is gained by staying at a turn from one sample to the next.
    gains = {
        turn: np.where((allowed & fits[turn])[1:] & (allowed & fits[turn])[:-1], steps, 0.0).tolist() for turn in turns
    }
    best = {turn: [0.0] * count for turn in turns}
    came: dict[int, list[int | None]] = {turn: [None] * count for turn in turns}
    back = {
        distance: np.minimum(
            np.searchsorted(t, t - distance * rewind_s, side="right") - 1, np.arange(count) - 1
        ).tolist()
        for distance in range(1, len(turns))
    }
    for i in range(1, count):
        for turn in turns:
            value, origin = best[turn][i - 1] + gains[turn][i - 1], None
            for other in turns:
                j = back[abs(other - turn)][i] if other != turn else -1
                # `>=`: of equal ways, the latest rewind.
                if j >= 0 and (with_rewind := best[other][j] - _SWITCH_S) >= value:
                    value, origin = with_rewind, other
            best[turn][i], came[turn][i] = value, origin
    runs: list[Run] = []
    turn, last = max(turns, key=lambda each: best[each][-1]), count - 1
    for i in range(count - 1, 0, -1):
        if i <= last and (origin := came[turn][i]) is not None:
            runs.append(Run(i, last, (turn,)))
            last, turn = back[abs(origin - turn)][i], origin
    runs.append(Run(0, last, (turn,)))
    return runs[::-1]
