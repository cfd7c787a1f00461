"""Which turn of the cable follows which part of a pass (`birdcage.sky.reach`)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.reach_limits import ReachLimits

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

_SWITCH_S = 1e-3
"""What a rewind costs beyond its time: where two ways are equal, the one without it wins."""


@dataclass(frozen=True, slots=True)
class SampleRun:
    """Samples `first` to `last` with one turn of the cable, or safe for each of `turns` where it is not known."""

    first: int
    last: int
    turns: tuple[int, ...]


def runs_of(t: Floats, az: Floats, allowed: Bools, limits: ReachLimits) -> list[SampleRun]:
    """Return which samples can be followed, at which turn k: the cable stands at azimuth - offset + 360 k.

    `az` is unrolled and true; samples that are not `allowed` need not be followed. Between two runs the dish rewinds,
    which takes the whole range of the cable at its greatest rate. Without a cable there is one run, of turn 0.
    """
    cable, indices = limits.cable, np.flatnonzero(allowed)
    if not len(indices):
        return []
    if cable is None:
        return [SampleRun(0, len(t) - 1, (0,))]
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
        return [SampleRun(0, len(t) - 1, (max(whole, key=lambda turn: float(room[turn])),))]
    return _most(t, allowed, fits, rewind_s)


def _safe_for_all(t: Floats, allowed: Bools, fits: dict[int, Bools], rewind_s: float) -> list[SampleRun]:
    """Go on while every turn at which the cable may have begun still fits, then rewind and begin anew."""
    runs: list[SampleRun] = []
    begin = 0
    while len(ahead := np.flatnonzero(allowed[begin:])):
        first = begin + int(ahead[0])
        turns = tuple(turn for turn, fit in fits.items() if fit[first])
        safe = np.logical_and.reduce([fits[turn] for turn in turns])
        stops = np.flatnonzero((allowed & ~safe)[first:])
        end = first + int(stops[0]) if len(stops) else len(t)
        runs.append(SampleRun(first, end - 1, turns))
        begin = max(end, int(np.searchsorted(t, t[end - 1] + rewind_s)))
    return runs


def _most(t: Floats, allowed: Bools, fits: dict[int, Bools], rewind_s: float) -> list[SampleRun]:
    """Return the runs that follow for the longest time in all."""
    turns, before = list(fits), np.arange(len(t)) - 1
    steps = np.diff(t)
    good = [allowed & fits[turn] for turn in turns]
    gains = [np.where(one[1:] & one[:-1], steps, 0.0).tolist() for one in good]
    back: dict[int, Sequence[int]] = {}
    for distance in range(1, len(turns)):
        ended = np.searchsorted(t, t - distance * rewind_s, side="right") - 1
        back[distance] = back[-distance] = np.minimum(ended, before).tolist()
    runs = most_followed(gains, back, _SWITCH_S, late=True)
    return [SampleRun(first, last, (turns[index],)) for first, last, index in runs]


def most_followed(
    gains: Sequence[Sequence[float]], back: Mapping[int, Sequence[int]], switch_cost: float, *, late: bool
) -> list[tuple[int, int, int]]:
    """Share samples out among turns of the cable, with rewinds between them, for the greatest gain.

    Bellman's recurrence over n samples and the turns k. Let `gains[k][i]` be what staying at turn k from sample i to
    i + 1 gains, `back[d][i]` the last sample from which a rewind by d turns is over at sample i (-1: none), and c the
    `switch_cost` of a rewind beyond its time. Then the most that is gained by sample i, the cable being at turn k, is

        best[k][0] = 0
        best[k][i] = max( best[k][i-1] + gains[k][i-1],
                          best[m][ back[k-m][i] ] - c  for every other turn m )

    From the greatest best[k][n-1] the way is followed back: where the second line won at i, a run of turn k begins at
    i, and one of turn m ends at back[k-m][i]. Of equal ways the latest rewind is taken with `late`, else none, or the
    earliest. Returns first and last sample and turn of each run, in order of time.
    """
    count, turns = len(gains[0]) + 1, range(len(gains))
    best = [[0.0] * count for _ in turns]
    came: list[list[int | None]] = [[None] * count for _ in turns]
    for i in range(1, count):
        for one in turns:
            value, origin = best[one][i - 1] + gains[one][i - 1], None
            for other in turns:
                j = -1 if other == one else back[one - other][i]
                rewound = best[other][j] - switch_cost
                if j >= 0 and (rewound > value or (late and rewound == value)):
                    value, origin = rewound, other
            best[one][i], came[one][i] = value, origin
    runs: list[tuple[int, int, int]] = []
    one, last = max(turns, key=lambda each: best[each][-1]), count - 1
    for i in range(count - 1, 0, -1):
        if i <= last and (origin := came[one][i]) is not None:
            runs.append((i, last, one))
            last, one = back[one - origin][i], origin
    runs.append((0, last, one))
    return runs[::-1]
