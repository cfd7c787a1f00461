"""The point on Earth under a satellite, and the line that it draws."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from birdcage.sky.elements import ElementSet
from birdcage.sky.frames import Floats, dut1_at, julian, sidereal_rad
from birdcage.sky.propagate import over_times, satrec

_EQUATOR_KM = 6378.137  # WGS84
_FLATTENING = 1.0 / 298.257223563
_E2 = _FLATTENING * (2.0 - _FLATTENING)
_ROUNDS = 4
"""Of the iteration for latitude, each of which takes the error to a hundredth or less."""


@dataclass(frozen=True, slots=True)
class SubPoints:
    """Points under satellites; NaN where SGP4 has no position."""

    t_s: Floats
    """POSIX seconds, UTC."""
    latitude_deg: Floats
    """Geodetic (WGS84)."""
    longitude_deg: Floats
    """-180 to 180, east positive."""
    altitude_km: Floats
    """Above the ellipsoid."""


def sub_points(t_s: ArrayLike, position_km: Floats) -> SubPoints:
    """Return the points under TEME positions (n, 3) at POSIX seconds: one time for all, or one for each."""
    times = np.broadcast_to(np.asarray(t_s, dtype=np.float64), position_km.shape[:1])
    x, y, z = position_km[:, 0], position_km[:, 1], position_km[:, 2]
    east = np.degrees(np.arctan2(y, x) - sidereal_rad(times, dut1_at(times)))
    axis = np.hypot(x, y)
    latitude = np.arctan2(z, axis)
    normal = np.full_like(axis, _EQUATOR_KM)
    for _ in range(_ROUNDS):
        sine = np.sin(latitude)
        normal = _EQUATOR_KM / np.sqrt(1.0 - _E2 * sine * sine)
        latitude = np.arctan2(z + _E2 * normal * sine, axis)
    sine = np.sin(latitude)
    normal = _EQUATOR_KM / np.sqrt(1.0 - _E2 * sine * sine)
    # Along the vertical, which holds at the poles too.
    height = axis * np.cos(latitude) + z * sine - normal * (1.0 - _E2 * sine * sine)
    return SubPoints(times, np.degrees(latitude), (east + 180.0) % 360.0 - 180.0, height)


def ground_track(elements: ElementSet, times: ArrayLike, time_offset_s: float = 0.0) -> SubPoints:
    """Return the points under one satellite at `times` (POSIX seconds).

    `time_offset_s`: how much later than computed the satellite comes.
    """
    t_s = np.atleast_1d(np.asarray(times, dtype=np.float64))
    error, position, _ = over_times(satrec(elements), *julian(t_s - time_offset_s))
    position[error != 0] = np.nan
    return sub_points(t_s, position)


def orbit_track(elements: ElementSet, middle_s: float, time_offset_s: float = 0.0, step_deg: float = 2.0) -> SubPoints:
    """Return the line under one satellite from an orbit before `middle_s` to an orbit after it.

    Points lie `step_deg` of the map apart or closer, also where an eccentric orbit is fast and near the poles.
    """
    times = np.linspace(middle_s - elements.period_s, middle_s + elements.period_s, 241)
    coarse = ground_track(elements, times, time_offset_s)
    turn = np.abs((np.diff(coarse.longitude_deg) + 180.0) % 360.0 - 180.0)
    apart = np.nan_to_num(np.hypot(turn, np.diff(coarse.latitude_deg)))
    pieces = np.clip(np.ceil(apart / step_deg), 1, 60).astype(int)
    if pieces.max() == 1:
        return coarse
    fine = [np.linspace(times[n], times[n + 1], count, endpoint=False) for n, count in enumerate(pieces)]
    return ground_track(elements, np.concatenate([*fine, times[-1:]]), time_offset_s)
