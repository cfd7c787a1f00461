"""By how much the air lifts what is near the horizon."""

from __future__ import annotations

from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from birdcage.tracking.curve import Floats

Refraction: TypeAlias = Literal["radio", "optical", "none"]

RADIO_N = 320.0
"""Refractivity of the air at the ground, in millionths: a middle climate."""
_PLAIN_ABOVE_DEG = 10.0
"""Down to here N cot(el) is as good as any formula; below, the air is a shell and not a slab."""
_LOWEST_DEG = -1.9
"""Where the formula for the shell has its greatest value; what is deeper is lifted by as much."""


def lift_deg(el_deg: ArrayLike, kind: Refraction = "radio") -> Floats:
    """Return how much higher than computed something at a geometric elevation is seen, in degrees.

    `radio`: N cot(el) with N = 320, continued below 10 degrees in the shape of the optical formula; `optical`:
    Bennett's, turned about for geometric elevations by Saemundsson. Continuous for every elevation.
    """
    el = np.asarray(el_deg, dtype=np.float64)
    if kind == "none":
        return np.zeros_like(el)
    if kind == "optical":
        return _optical(el)
    at_seam = RADIO_N * 1e-6 / np.tan(np.radians(_PLAIN_ABOVE_DEG))
    plain = RADIO_N * 1e-6 / np.tan(np.radians(np.maximum(el, _PLAIN_ABOVE_DEG)))
    shell = at_seam * _optical(el) / _optical(np.array(_PLAIN_ABOVE_DEG))
    lift: Floats = np.where(el >= _PLAIN_ABOVE_DEG, np.degrees(np.maximum(plain, 0.0)), np.degrees(shell))
    return lift


def _optical(el: Floats) -> Floats:
    """Return Saemundsson's formula: 10 degrees Celsius, 1010 hPa."""
    h = np.maximum(el, _LOWEST_DEG)
    lift: Floats = np.maximum(1.02 / 60.0 / np.tan(np.radians(h + 10.3 / (h + 5.11))), 0.0)
    return lift
