"""Step 6: SGP4 itself at each event, and a second-order correction; again only where that was not small."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from birdcage.sky import propagate
from birdcage.sky.frames import Floats, julian
from birdcage.sky.passes.ground import ObserverTrack
from birdcage.sky.passes.newton import crossing_step, turning_step
from birdcage.sky.passes.nodes import Indices, Intervals
from birdcage.sky.passes.quintic import acceleration

RISE, TURN, SET = 0, 1, 2

_ROUNDS = 12
_LIMIT = 0.02
"""The longest step, in intervals: a quarter of the sub-grid's."""
_NEAR_S = 0.5
"""After a step of this size a second-order root is good to 0.1 ms, also near the zenith at 400 km."""
_SWIFT_RAD_S = 1e-3
"""Slower satellites than this one must come nearer in proportion: SGP4's velocity is not quite the derivative of its
position, which tells the more the less a satellite moves against the ground."""
_NEAR_TURN_S = 1.0
_SETTLED_S = 5e-4
_GRAZING = 0.1
"""The share of the slope that a step may change before the root counts as grazing, and is stepped to until settled."""


Kinds = NDArray[np.int8]


@dataclass(frozen=True, slots=True)
class Guesses:
    """Where events are, about."""

    satellite: Indices
    kind: Kinds
    """`RISE`, `TURN` or `SET`."""
    t: Floats
    """Seconds from the start of the search."""
    limit_s: Floats
    """The longest step that a correction may take."""

    @classmethod
    def on(cls, intervals: Intervals, which: Indices, s: Floats, kind: NDArray[np.integer]) -> Guesses:
        """Return events at `s` (0 to 1) of the intervals `which`."""
        h = intervals.length_s[which]
        return cls(intervals.satellite[which], kind.astype(np.int8), intervals.begin_s[which] + s * h, h * _LIMIT)

    @classmethod
    def joined(cls, parts: Sequence[Guesses]) -> Guesses:
        """Return all of them."""
        columns = [np.concatenate([getattr(part, name) for part in parts]) for name in cls.__slots__]
        return cls(*columns)


@dataclass(frozen=True, slots=True)
class Events:
    """Rises, sets and turning points where SGP4 puts them, in order of satellites; columns as in `Guesses`."""

    satellite: Indices
    kind: Kinds
    t: Floats
    limit_s: Floats
    r: Floats
    """TEME position at `t` (3 rows, n); NaN where SGP4 has none."""

    def guesses(self, which: NDArray[np.bool_], kind: NDArray[np.integer], after_s: Floats) -> Guesses:
        """Return some of these again, as other kinds and so much later."""
        return Guesses(
            self.satellite[which], kind[which].astype(np.int8), (self.t + after_s)[which], self.limit_s[which]
        )


class Exact:
    """SGP4 for the satellites of one search."""

    def __init__(
        self, satrecs: Sequence[propagate.Record], ground: ObserverTrack, offsets: Mapping[int, float]
    ) -> None:
        self._satrecs = satrecs
        self._ground = ground
        self._offsets = offsets

    def refine(self, guesses: Guesses) -> Events:
        """Return these events where SGP4 puts them."""
        order = np.argsort(guesses.satellite, kind="stable")
        satellite, kind = guesses.satellite[order], guesses.kind[order]
        t, limit_s = guesses.t[order], guesses.limit_s[order]
        r = np.full((3, len(t)), np.nan)
        active = np.arange(len(t))
        for _ in range(_ROUNDS):
            if not len(active):
                break
            at, v = self._states(satellite[active], t[active])
            a = acceleration(at)
            course = self._ground.course(t[active], at, v, a)
            turning = kind[active] == TURN
            crossing = crossing_step(course, self._ground.sin_mask, kind[active] == RISE)
            step = np.where(turning, turning_step(course), crossing)
            step = np.clip(step, -limit_s[active], limit_s[active])
            t[active] += step
            r[:, active] = at + step * (v + 0.5 * step * a)
            size = np.abs(step)
            grazing = (size > _SETTLED_S) & (np.abs(step * course.bend) > _GRAZING * np.abs(course.rate))
            near = np.clip(_NEAR_S / _SWIFT_RAD_S * np.abs(course.rate), _SETTLED_S, _NEAR_S)
            active = active[np.where(turning, size > _NEAR_TURN_S, (size > near) | grazing)]
        return Events(satellite, kind, t, limit_s, r)

    def bends(self, events: Events) -> tuple[Floats, Floats]:
        """Return for each event the sine of its elevation over the mask's, and the second derivative of it."""
        at, v = self._states(events.satellite, events.t)
        course = self._ground.course(events.t, at, v, acceleration(at))
        return course.sine - self._ground.sin_mask, course.bend

    def _states(self, satellite: Indices, t: Floats) -> tuple[Floats, Floats]:
        """Return positions and velocities (3 rows, n); `satellite` is sorted, so that each is asked once."""
        absolute = self._ground.start_s + t
        if self._offsets:
            absolute -= np.array([self._offsets.get(int(index), 0.0) for index in satellite])
        day, part = julian(absolute)
        r, v = np.empty((len(t), 3)), np.empty((len(t), 3))
        cuts = np.flatnonzero(np.diff(satellite, prepend=-1, append=-1)).tolist()
        for begin, end in pairwise(cuts):
            error, r[begin:end], v[begin:end] = propagate.over_times(
                self._satrecs[satellite[begin]], day[begin:end], part[begin:end]
            )
            if error.any():
                r[begin:end][error != 0] = np.nan
        return np.ascontiguousarray(r.T), np.ascontiguousarray(v.T)
