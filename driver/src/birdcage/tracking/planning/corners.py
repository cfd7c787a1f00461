"""Corners of a course: a cubic through its points must not swing out beyond them."""

from __future__ import annotations

import numpy as np

from birdcage.tracking.curve import Curve, Floats

JOINT_S = 1e-3
"""A corner gets a second point so near on either side, and the cubic stays at the corner."""
_SHARP_DEG = 0.004
"""A change of rate that makes less than this within a step swings out by a tenth of it at most."""


def cornered(t: Floats, az: Floats, el: Floats) -> Curve:
    """Return the curve through points, with further ones about its corners."""
    steps = np.diff(t)
    slopes = [np.diff(values) / steps for values in (az, el)]
    widest = np.maximum(steps[1:], steps[:-1])
    bend = np.maximum(*(np.abs(np.diff(slope)) for slope in slopes)) * widest
    sharp = np.flatnonzero(bend > _SHARP_DEG) + 1
    before, after = sharp[steps[sharp - 1] > 3.0 * JOINT_S], sharp[steps[sharp] > 3.0 * JOINT_S]
    times = np.concatenate([t, t[before] - JOINT_S, t[after] + JOINT_S])
    order = np.argsort(times)
    found = [
        np.concatenate([values, values[before] - slope[before - 1] * JOINT_S, values[after] + slope[after] * JOINT_S])
        for values, slope in zip((az, el), slopes, strict=True)
    ]
    return Curve(times[order], found[0][order], found[1][order])
