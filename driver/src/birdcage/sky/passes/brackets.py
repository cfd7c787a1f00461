"""Step 4: a sub-grid over each interval, and between its points the crossings of the mask and the turning points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.frames import Floats
from birdcage.sky.passes import quintic
from birdcage.sky.passes.ground import ObserverTrack
from birdcage.sky.passes.nodes import Indices, Intervals

PARTS = 12
"""Sub-intervals in an interval: 6 degrees of orbit at perigee, in which the elevation turns at most once."""

_BATCH = 1024
"""Intervals at a time: their arrays stay in the cache, and BLAS starts no threads for products of this size, which on
a busy machine wait for each other longer than they work."""


@dataclass(frozen=True, slots=True)
class Brackets:
    """Stretches of time, each with one event in it; `low`, `high` and `guess` run from 0 to 1 in their interval."""

    interval: Indices
    low: Floats
    high: Floats
    guess: Floats


@dataclass(frozen=True, slots=True)
class AllBrackets:
    """All brackets of a number of intervals."""

    crossings: Brackets
    rising: NDArray[np.bool_]
    """For each crossing."""
    turns: Brackets
    highest: NDArray[np.bool_]
    """For each turning point: True for a maximum, False for a minimum."""
    lonely: NDArray[np.bool_]
    """For each turning point: nothing else tells of what it does to the mask. A maximum between two points below the
    mask, or a minimum between two above it."""


def find(ground: ObserverTrack, intervals: Intervals) -> AllBrackets:
    """Return where satellites cross the mask or turn."""
    total = len(intervals.begin_s)
    parts = [
        _find(ground, intervals, np.arange(start, min(start + _BATCH, total))) for start in range(0, total, _BATCH)
    ] or [_find(ground, intervals, np.arange(0))]
    if len(parts) == 1:
        return parts[0]
    return AllBrackets(
        crossings=_join([part.crossings for part in parts]),
        rising=np.concatenate([part.rising for part in parts]),
        turns=_join([part.turns for part in parts]),
        highest=np.concatenate([part.highest for part in parts]),
        lonely=np.concatenate([part.lonely for part in parts]),
    )


def _find(ground: ObserverTrack, intervals: Intervals, batch: Indices) -> AllBrackets:
    grid = np.linspace(0.0, 1.0, PARTS + 1)
    part = slice(batch[0], batch[-1] + 1) if len(batch) else slice(0, 0)
    begin, h = intervals.begin_s[part], intervals.length_s[part]
    r, v = quintic.on_grid(intervals.c[:, :, part], h, grid)
    sine, turn = ground.sine_and_turn(begin + grid[:, None] * h, r, v)
    above = sine - ground.sin_mask
    up, climbing = above > 0.0, turn > 0.0
    step, crossed = np.nonzero(up[1:] != up[:-1])
    below, over = above[step, crossed], above[step + 1, crossed]
    crossings = Brackets(
        batch[crossed], grid[step], grid[step + 1], grid[step] + (grid[1] - grid[0]) * below / (below - over)
    )
    rising = up[step + 1, crossed]
    # A minimum matters only where it may dip below the mask between two points that are up.
    turned = climbing[1:] != climbing[:-1]
    step, at = np.nonzero(turned & (climbing[:-1] | (up[1:] & up[:-1])))
    first, second = turn[step, at], turn[step + 1, at]
    turns = Brackets(batch[at], grid[step], grid[step + 1], grid[step] + (grid[1] - grid[0]) * first / (first - second))
    highest = climbing[step, at]
    lonely = ~highest | ~(up[step, at] | up[step + 1, at])
    return AllBrackets(crossings, rising, turns, highest, lonely)


def _join(parts: list[Brackets]) -> Brackets:
    return Brackets(
        np.concatenate([part.interval for part in parts]),
        np.concatenate([part.low for part in parts]),
        np.concatenate([part.high for part in parts]),
        np.concatenate([part.guess for part in parts]),
    )
