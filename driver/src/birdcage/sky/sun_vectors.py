"""The Sun over a track, as directions east, north and up of the observer."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np

from birdcage.sky.observer import Observer
from birdcage.sky.reach_checks import Floats
from birdcage.sky.sun import sun

_APART_S = 600.0
"""The Sun is computed this often; between, its direction is interpolated to a few hundredths of a degree at most."""


def unit_vectors(az_deg: Floats, el_deg: Floats) -> Floats:
    """Return directions as unit vectors (east, north, up), along a new last axis."""
    az, el = np.radians(az_deg), np.radians(el_deg)
    return np.stack([np.cos(el) * np.sin(az), np.cos(el) * np.cos(az), np.sin(el)], axis=-1)


def sun_vectors(observer: Observer, t_s: Floats) -> Floats:
    """Return the Sun's direction at POSIX seconds in order, (n, 3)."""
    t = np.atleast_1d(np.asarray(t_s, dtype=np.float64))
    knots = np.linspace(t[0], t[-1], int((t[-1] - t[0]) / _APART_S) + 2)
    seen = np.array(
        [sun(datetime.fromtimestamp(when, UTC), observer.latitude_deg, observer.longitude_deg) for when in knots]
    )
    vectors = unit_vectors(seen[:, 0], seen[:, 1])
    between = np.stack([np.interp(t, knots, vectors[:, axis]) for axis in range(3)], axis=-1)
    directions: Floats = between / np.linalg.norm(between, axis=-1, keepdims=True)
    return directions
