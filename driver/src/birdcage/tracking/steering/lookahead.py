"""Which move an axis-by-axis dish should make next: two moves ahead (`docs/tracking.md`, *How it follows*).

Every pair of moves (axis, aim) x (axis, aim) is scored by the mean-square pointing error over one common horizon; a
horizon of each pair's own was measured to fail. Only a first move that lasts longer is scored until its end: by its
slow beginning alone it would look harmless. The first move of the best pair counts, the second one is a promise.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.antenna.motion import plan_axis
from birdcage.rotator.axis import Axis
from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.move_times import durations, progress, ramps
from birdcage.tracking.steering.axis_belief import spans

Whole = NDArray[np.int_]

FIRST_S = (0.0, 0.1, 0.2, 0.35, 0.5, 1.0, 2.0, 4.0)
"""How long after the end of the first move its axis may be aimed to meet the course; the first is at once."""
SECOND_S = (0.1, 0.6, 2.0)
"""The same of the second move."""
ROUNDS = 3
"""Of the fixed point between where a move ends and how long it takes."""
MOMENTS = 17
"""At which the error is taken over the horizon."""
SHORTEST_S, LONGEST_S = 0.3, 8.0
SHARE, BEYOND = 0.3, 1.1
"""The horizon: a little more than what the quicker third of all pairs takes, within these bounds. A longer one was
measured to lead a slow target by half of it, as nothing is planned beyond the second move."""

RUSHED_FIRST_S = (0.0, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0)
RUSHED_SHARE, RUSHED_DEG_S = 0.5, 2.0
"""More aims and a longer horizon where the azimuth sweeps this fast: each change of axis costs what less would miss."""


@dataclass(frozen=True, slots=True)
class Move:
    """What should be sent."""

    column: int
    """0 azimuth, 1 elevation."""
    goal_deg: float
    lasts_s: float


@dataclass(frozen=True, slots=True, eq=False)
class _Moves:
    """Some moves, from rest to rest, as arrays."""

    column: Whole
    goal: Floats
    way: Floats
    lasts: Floats
    ramp: Floats

    def taken(self, which: Whole) -> _Moves:
        return _Moves(self.column[which], self.goal[which], self.way[which], self.lasts[which], self.ramp[which])


class Lookahead:
    """Chooses moves of two axes of which only one turns at a time."""

    def __init__(self, axes: tuple[Axis, Axis], dead_bands_deg: tuple[float, float]) -> None:
        self._axes = axes
        self._dead_bands = dead_bands_deg

    def choose(self, course: Curve, at_deg: tuple[float, float], start_s: float) -> Move | None:
        """Return the best first move for a dish that stands at `at_deg` when it gets it, at `start_s`.

        The second move begins as the first one ends. None if no move is worth a command.
        """
        # An axis is due when it would be off where it meets the course, not where it would run ahead of it.
        due = np.array([self._off(course, column, at_deg[column], start_s) for column in (0, 1)]) >= self._dead_bands
        if not due.any():
            return None
        rushed = abs(course.at(start_s + 1.0)[0] - course.at(start_s)[0]) > RUSHED_DEG_S
        firsts_s, share = (RUSHED_FIRST_S, RUSHED_SHARE) if rushed else (FIRST_S, SHARE)
        first = self._aims(course, np.full(2, start_s), np.array(at_deg), firsts_s)
        count = len(first.goal)
        # For each first move, where both axes stand after it, and when the second can begin.
        after = np.tile(np.array(at_deg), (count, 1))
        after[np.arange(count), first.column] = first.goal
        begin = start_s + first.lasts
        second = self._aims(course, np.repeat(begin, 2), after.ravel(), SECOND_S)
        firsts = np.repeat(np.arange(count), 2 * len(SECOND_S))
        horizon_s = float(np.quantile(begin[firsts] + second.lasts - start_s, share)) * BEYOND
        worth = np.flatnonzero((due[first.column] & (first.way != 0.0))[firsts])
        if not len(worth):
            return None
        firsts, second = firsts[worth], second.taken(worth)
        moves, begins = first.taken(firsts), begin[firsts]
        spans_s = np.maximum(min(max(horizon_s, SHORTEST_S), LONGEST_S), moves.lasts)
        t_s = start_s + np.linspace(0.0, 1.0, MOMENTS) * spans_s[:, None]
        cost = _mean_square(course, t_s, at_deg, ((moves, np.full(len(firsts), start_s)), (second, begins)))
        best = int(firsts[np.argmin(cost)])
        return Move(int(first.column[best]), float(first.goal[best]), float(first.lasts[best]))

    def _off(self, course: Curve, column: int, at_deg: float, start_s: float) -> float:
        """Return how far an axis would have to go to meet the course."""
        axis, off = self._axes[column], 0.0
        for _ in range(ROUNDS):
            off = abs(course.at(start_s + plan_axis(axis, 0.0, off).duration_s)[column] - at_deg)
        return off

    def _aims(self, course: Curve, begin_s: Floats, at_deg: Floats, later_s: tuple[float, ...]) -> _Moves:
        """Return the moves of each axis from each of the states; states alternate azimuth, elevation."""
        shape = len(begin_s) // 2, 2, len(later_s)
        begin = np.repeat(begin_s, len(later_s)).reshape(shape)
        later = np.broadcast_to(np.array(later_s), shape)
        at = np.repeat(at_deg, len(later_s)).reshape(shape)
        goal, lasts, ramp = at.copy(), np.zeros(shape), np.full(shape, 0.5)
        limits = spans(course)
        for _ in range(ROUNDS):
            both = course.sample(begin + lasts + later)
            for index, axis in enumerate(self._axes):
                steps = np.round(both[index][:, index] / axis.step_deg) * axis.step_deg
                goal[:, index] = np.minimum(np.maximum(steps, limits[index][0]), limits[index][1])
                way = np.abs(goal[:, index] - at[:, index])
                # Of measured times a step more may be the next class of them, and a queue would grow by that.
                more = axis.step_deg if axis.times is not None else 0.0
                lasts[:, index] = durations(axis, np.where(way > 0.0, way + more, 0.0))
        for index, axis in enumerate(self._axes):
            ramp[:, index] = ramps(axis, lasts[:, index])
        column = np.broadcast_to(np.array([[[0], [1]]]), shape)
        return _Moves(column.ravel(), goal.ravel(), (goal - at).ravel(), np.maximum(lasts, 1e-3).ravel(), ramp.ravel())


def _mean_square(
    course: Curve, t_s: Floats, at_deg: tuple[float, float], moves: tuple[tuple[_Moves, Floats], ...]
) -> Floats:
    """Return the mean-square angle on the sky between the course and each row of moves, at a row of times each."""
    where = np.empty((2, *t_s.shape))
    where[0], where[1] = at_deg
    for each, begin in moves:
        gone = each.way[:, None] * progress((t_s - begin[:, None]) / each.lasts[:, None], each.ramp[:, None])
        turns = each.column[:, None] == 0
        where[0] += np.where(turns, gone, 0.0)
        where[1] += np.where(turns, 0.0, gone)
    az, el = np.radians(where)
    course_az, course_el = np.radians(course.sample(t_s))
    h = np.sin((el - course_el) / 2.0) ** 2 + np.cos(el) * np.cos(course_el) * np.sin((az - course_az) / 2.0) ** 2
    return np.asarray((np.arcsin(np.sqrt(np.minimum(h, 1.0))) ** 2).mean(axis=1))
