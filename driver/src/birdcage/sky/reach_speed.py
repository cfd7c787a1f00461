"""Where an axis is too slow to follow: the keyhole near the zenith (`birdcage.sky.reach`).

The dish may be anywhere within the tolerance of the satellite; at each moment that is an interval of azimuth. A path
through all of them at a limited rate exists if and only if no two are further apart than the rate allows, which a
running minimum and maximum tell.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_MOST = 16
"""Keyholes of one pass: a satellite culminates a few times a day at most."""


def azimuth_room(el_deg: Floats, tolerance_deg: float, ceiling_deg: float | Floats) -> Floats:
    """Return how far off in azimuth a dish may stand and still point within the tolerance, in degrees.

    It takes the elevation that is best for it: sin el' = sin el / cos tolerance, below the ceiling. 180 if any
    azimuth will do. A satellite above the ceiling by more than the tolerance leaves no room.
    """
    el, tolerance = np.radians(el_deg), np.radians(tolerance_deg)
    best = np.arcsin(np.clip(np.sin(el) / np.cos(tolerance), -1.0, 1.0))
    best = np.minimum(best, np.radians(ceiling_deg))
    across = np.cos(el) * np.cos(best)
    with np.errstate(divide="ignore", invalid="ignore"):
        cosine = np.where(across > 1e-9, (np.cos(tolerance) - np.sin(el) * np.sin(best)) / across, -1.0)
    room: Floats = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return room


def too_fast(t: Floats, low: Floats, high: Floats, rate_deg_s: float) -> list[tuple[float, float]]:
    """Return the spans of time to leave out so that the rest can be followed, each as short as can be.

    An axis shall stay between `low` and `high` (infinite where it is free) and turns at `rate_deg_s` at most.
    """
    low, high, spans = low.copy(), high.copy(), []
    for _ in range(_MOST):
        upper, lower = _forward(t, low, high, rate_deg_s)
        bad = np.flatnonzero(lower > upper + 1e-9)
        if not len(bad):
            break
        # Two moments that exclude each other lie so near that the axis could not turn once and a bit meanwhile.
        about = float(t[bad[0]])
        near = np.flatnonzero(np.abs(t - about) <= 400.0 / rate_deg_s)
        window = slice(int(near[0]), int(near[-1]) + 1)
        first, last = _shortest(t[window], low[window], high[window], rate_deg_s)
        out = slice(window.start + first, window.start + last + 1)
        # From the last moment that is kept to the first that is kept again.
        spans.append((float(t[max(out.start - 1, 0)]), float(t[min(out.stop, len(t) - 1)])))
        low[out], high[out] = -np.inf, np.inf
    return spans


def _forward(t: Floats, low: Floats, high: Floats, rate: float) -> tuple[Floats, Floats]:
    """Return the highest and lowest angle that can be reached in time, for each moment."""
    way = rate * (t - t[0])
    return np.minimum.accumulate(high - way) + way, np.maximum.accumulate(low + way) - way


def _shortest(t: Floats, low: Floats, high: Floats, rate: float) -> tuple[int, int]:
    """Return the first and last sample of the shortest window without which the rest can be followed."""
    count, way = len(t), rate * (t - t[0])
    upper, lower = _forward(t, low, high, rate)
    feasible = lower <= upper + 1e-9
    kept_before = count if feasible.all() else int(np.argmin(feasible))  # samples 0 .. kept_before - 1 may be kept
    back_upper, back_lower = (each[::-1] for each in _forward(-t[::-1], low[::-1], high[::-1], rate))
    feasible = (back_lower <= back_upper + 1e-9)[::-1]
    kept_after = count if feasible.all() else int(np.argmin(feasible))
    # Keep samples up to a - 1 and from b on: for each a the first b at which the axis can be in time.
    a = np.arange(kept_before + 1)
    top = np.concatenate(([np.inf], upper - way))[a]  # falls with a
    bottom = np.concatenate(([-np.inf], lower + way))[a]  # rises with a
    needs_top = np.append(back_lower - way, -np.inf)  # falls with b
    needs_bottom = np.append(back_upper + way, np.inf)  # rises with b
    b = np.maximum(
        np.searchsorted(-needs_top, -top - 1e-9, side="left"), np.searchsorted(needs_bottom, bottom - 1e-9, side="left")
    )
    b = np.maximum(np.maximum(b, count - kept_after), a)
    cost = np.append(t, t[-1])[np.minimum(b, count)] - np.concatenate(([t[0]], t))[a]
    cost = np.where(b > a, cost, np.inf)
    best = int(np.argmin(cost))
    return int(a[best]), int(b[best]) - 1
