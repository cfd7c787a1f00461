"""Quintic Hermite interpolation of orbits, as polynomials in s = 0 to 1 over each interval.

SGP4 gives position and velocity; the acceleration of the two-body problem with J2 is near enough to make the third
condition at each end, and costs nothing (0.3 km over 70 degrees of orbit).
"""

from __future__ import annotations

import numpy as np

from birdcage.sky.frames import Floats
from birdcage.sky.passes.orbits import MU_KM3_S2

_EARTH_KM = 6378.135  # WGS72, as in SGP4
_J2 = 0.001082616


def acceleration(r: Floats) -> Floats:
    """Return the acceleration of the two-body problem with J2 (km/s^2) for positions of three rows."""
    x, y, z = r
    r2 = x * x + y * y + z * z
    pull = -MU_KM3_S2 / (r2 * np.sqrt(r2))
    flat = 1.5 * _J2 * _EARTH_KM * _EARTH_KM / r2
    tilt = 5.0 * z * z / r2
    level = pull * (1.0 + flat * (1.0 - tilt))
    return np.stack((x * level, y * level, z * pull * (1.0 + flat * (3.0 - tilt))))


def coefficients(h: Floats, r0: Floats, v0: Floats, r1: Floats, v1: Floats) -> Floats:
    """Return polynomials (6 powers, 3 rows, n) through n pairs of states (3 rows, n) that are `h` seconds apart."""
    v0, v1, a0, a1 = h * v0, h * v1, 0.5 * h * h * acceleration(r0), 0.5 * h * h * acceleration(r1)
    # What the first three powers leave to the last three, at s = 1, in position and derivatives.
    p, q, b = r1 - r0 - v0 - a0, v1 - v0 - 2.0 * a0, a1 - a0
    return np.stack((r0, v0, a0, 10.0 * p - 4.0 * q + b, -15.0 * p + 7.0 * q - 2.0 * b, 6.0 * p - 3.0 * q + b))


def on_grid(c: Floats, h: Floats, s: Floats) -> tuple[Floats, Floats]:
    """Return positions and velocities (3 rows, len(s), n) of polynomials at the same `s` in every interval."""
    powers = s[:, None] ** np.arange(6)
    slopes = np.arange(6) * s[:, None] ** np.maximum(np.arange(6) - 1, 0)
    flat = c.reshape(6, -1)
    shape = (len(s), 3, c.shape[2])
    positions = (powers @ flat).reshape(shape)
    velocities = (slopes @ flat).reshape(shape)
    velocities /= h
    return positions.swapaxes(0, 1), velocities.swapaxes(0, 1)


def at(c: Floats, h: Floats, s: Floats) -> tuple[Floats, Floats, Floats]:
    """Return positions, velocities and accelerations (3 rows, n), each polynomial at its own `s`."""
    c0, c1, c2, c3, c4, c5 = c
    r = c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5))))
    v = c1 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))
    a = 2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5))
    return r, v / h, a / (h * h)
