"""Whether the Sun shines on a satellite, or the Earth stands between."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.observer import Observer
from birdcage.sky.reach_checks import Floats
from birdcage.sky.sun_vectors import sun_vectors, unit_vectors

_EQUATOR_KM = 6378.137
_MEAN_KM = 6371.0
"""The shadow is that of a sphere: by its flattening the Earth's edge lies up to 15 km elsewhere, two seconds of a low
orbit."""
_E2 = 6.69437999014e-3  # WGS84


def earth_centre_km(observer: Observer) -> tuple[float, float, float]:
    """Return where the centre of the Earth lies, east, north and up of a place (WGS84)."""
    latitude = math.radians(observer.latitude_deg)
    curvature = _EQUATOR_KM / math.sqrt(1.0 - _E2 * math.sin(latitude) ** 2)
    north = _E2 * curvature * math.sin(latitude) * math.cos(latitude)
    return 0.0, north, -(curvature * (1.0 - _E2 * math.sin(latitude) ** 2) + observer.height_m / 1000.0)


def sunlit(observer: Observer, t_s: Floats, az_deg: Floats, el_deg: Floats, range_km: Floats) -> NDArray[np.bool_]:
    """Return where the Sun's centre is seen from the satellite.

    `t_s` (POSIX seconds) is an array in order, or one time for many satellites. NaN is not lit.
    """
    from_centre = unit_vectors(az_deg, el_deg) * np.asarray(range_km)[..., None] - np.array(earth_centre_km(observer))
    away = np.einsum("...k,...k->...", from_centre, sun_vectors(observer, t_s))
    squared = np.einsum("...k,...k->...", from_centre, from_centre)
    lit: NDArray[np.bool_] = (away >= 0.0) | (squared - away * away > _MEAN_KM**2)
    lit &= np.isfinite(squared)
    return lit
