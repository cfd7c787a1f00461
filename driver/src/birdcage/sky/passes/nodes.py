"""Steps 2 and 3: SGP4 at the nodes of each group, and the intervals between them in which a satellite may be up."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky import propagate
from birdcage.sky.frames import SIDEREAL_RATE_RAD_S, Floats, julian
from birdcage.sky.passes.ground import ObserverTrack
from birdcage.sky.passes.orbits import MU_KM3_S2, Orbits
from birdcage.sky.passes.quintic import coefficients

_EARTH_KM = 6400.0

Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Intervals:
    """Stretches of orbits that may reach above the mask."""

    satellite: Indices
    """Index among the satellites of this search."""
    begin_s: Floats
    length_s: Floats
    c: Floats
    """The orbit's polynomial (`quintic`): 6 powers, 3 rows, n."""

    @classmethod
    def joined(cls, parts: Sequence[Intervals]) -> Intervals:
        """Return all of them."""
        if not parts:
            return cls(np.empty(0, np.intp), np.empty(0), np.empty(0), np.empty((6, 3, 0)))
        return cls(
            np.concatenate([part.satellite for part in parts]),
            np.concatenate([part.begin_s for part in parts]),
            np.concatenate([part.length_s for part in parts]),
            np.concatenate([part.c for part in parts], axis=2),
        )


@dataclass(frozen=True, slots=True)
class OrbitEnd:
    """SGP4 gave no position for one satellite from some time on."""

    satellite: int
    code: int
    """Of SGP4."""
    t_s: float
    """The first node without a position, in seconds from the start of the search."""


@dataclass(frozen=True, slots=True)
class Sampled:
    """What one group's nodes yield."""

    intervals: Intervals
    last: Floats
    """Positions at the end of the search (n, 3), for the satellites of the group in order; NaN where there is none."""
    stops: tuple[OrbitEnd, ...]


def groups(orbits: Orbits, chosen: Indices, offsets: Mapping[int, float]) -> list[tuple[float, float, Indices]]:
    """Return (step in s, time offset in s, satellites) of those that can share nodes."""
    steps = orbits.step_s(chosen)
    shift = np.array([offsets.get(int(index), 0.0) for index in chosen]) if offsets else np.zeros(len(chosen))
    keys, which = np.unique(np.stack((steps, shift)), axis=1, return_inverse=True)
    which = which.reshape(-1)
    return [(float(keys[0, group]), float(keys[1, group]), chosen[which == group]) for group in range(keys.shape[1])]


def sample(
    satrecs: Sequence[propagate.Record], ground: ObserverTrack, orbits: Orbits, members: Indices, span_s: float,
    step_s: float,
    offset_s: float,
) -> Sampled:  # fmt: skip
    """Run SGP4 over the nodes of one group; keep the intervals that may hold something above the mask."""
    count = max(3, math.ceil(span_s / step_s) + 1)
    t = np.linspace(0.0, span_s, count)
    day, part = julian(ground.start_s - offset_s + t)
    error, r, v = propagate.over_grid([satrecs[index] for index in members], day, part)
    stops: tuple[OrbitEnd, ...] = ()
    if error.any():
        stops = _stops(error, members, t)
        r[np.maximum.accumulate(error != 0, axis=1)] = np.nan  # from the first error on: a gap would join two passes
    h = t[1] - t[0]
    who, node = np.nonzero(_may_be_up(ground, orbits, members, t, r, v))
    lengths = np.full(len(who), h)
    c = coefficients(lengths, r[who, node].T, v[who, node].T, r[who, node + 1].T, v[who, node + 1].T)
    return Sampled(Intervals(members[who], t[node], lengths, c), r[:, -1], stops)


def _may_be_up(
    ground: ObserverTrack, orbits: Orbits, members: Indices, t: Floats, r: Floats, v: Floats
) -> NDArray[np.bool_]:
    """Return (n, intervals): False where the satellite certainly stays below the horizon's plane.

    g = p . up is known at the nodes with two derivatives, and so at the middle. Between two points that are h/2
    apart it lies above the higher by at most max|g''| (h/2)^2 / 8, and |g''| by 1.4 times what the apogee would have
    with the perigee's rate against the turning plane. NaN (no position) is False.
    """
    h = t[1] - t[0]
    c, s = ground.turned(t)
    cos_lat, sin_lat = ground.site.cos_lat, ground.site.sin_lat
    up = np.stack((cos_lat * c, cos_lat * s, np.full_like(c, sin_lat)), axis=-1)
    up_rate = SIDEREAL_RATE_RAD_S * np.stack((-cos_lat * s, cos_lat * c, np.zeros_like(c)), axis=-1)
    outward = np.einsum("ntk,tk->nt", r, up)
    g = outward - ground.site.height_km
    g1 = np.einsum("ntk,tk->nt", v, up) + np.einsum("ntk,tk->nt", r, up_rate)
    r2 = np.einsum("ntk,ntk->nt", r, r)
    g2 = -MU_KM3_S2 / (r2 * np.sqrt(r2)) * outward
    before, after = slice(None, -1), slice(1, None)
    middle = (
        0.5 * (g[:, before] + g[:, after])
        + (5.0 * h / 32.0) * (g1[:, before] - g1[:, after])
        + (h * h / 64.0) * (g2[:, before] + g2[:, after])
    )
    highest = np.maximum(np.maximum(g[:, before], g[:, after]), middle)
    rate = orbits.perigee_rad_s[members] + SIDEREAL_RATE_RAD_S
    bound = 1.4 * orbits.apogee_km[members] * rate * rate * h * h / 32.0
    # A mask below the horizon counts more as up, by what it is below over the greatest distance.
    lowest = min(ground.sin_mask, 0.0) * (orbits.apogee_km[members] + _EARTH_KM)
    return np.asarray(highest > (lowest - bound)[:, None])


def _stops(error: NDArray[np.uint8], members: Indices, t: Floats) -> tuple[OrbitEnd, ...]:
    first = (error != 0).argmax(axis=1)
    return tuple(
        OrbitEnd(int(members[row]), int(error[row, first[row]]), float(t[first[row]]))
        for row in np.flatnonzero(error.any(axis=1))
    )
