"""From SGP4's frame to azimuth and elevation, for arrays of times or of satellites.

SGP4 gives positions in TEME (true equator, mean equinox). The IAU 1982 sidereal time turns TEME about its pole into
the Earth's frame (Vallado et al., "Revisiting Spacetrack Report #3", AIAA 2006-6753, appendix C). Here the observer is
turned instead of the satellite, which leaves SGP4's arrays as they are. Polar motion, at most 6 arcseconds for a low
satellite (measured against astropy), and refraction are left out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from birdcage.sky import dut1 as ut1
from birdcage.sky.observer import Observer

Floats = NDArray[np.float64]

DAY_S = 86400.0
SIDEREAL_RATE_RAD_S = 2.0 * math.pi * 1.00273790935 / DAY_S
"""How fast the mean equinox turns past a place: the derivative of the 1982 formula, precession included."""

_EQUATOR_KM = 6378.137  # WGS84
_FLATTENING = 1.0 / 298.257223563
_UNIX_JD = 2440587.5
_J2000_UNIX_S = 946728000.0
_EPOCH = datetime(1970, 1, 1, tzinfo=UTC)


def posix_s(when: datetime) -> float:
    """Return an aware time as POSIX seconds, which count no leap seconds. ValueError for a naive time."""
    if when.tzinfo is None:
        raise ValueError("the time must say its zone")
    return (when - _EPOCH).total_seconds()


def utc(t_s: float) -> datetime:
    """Return POSIX seconds as an aware time."""
    return _EPOCH + timedelta(seconds=float(t_s))


def julian(t_s: ArrayLike) -> tuple[Floats, Floats]:
    """Return the Julian date of POSIX seconds in two parts, as SGP4 takes it: midnight, and the part of the day."""
    days, rest_s = np.divmod(np.asarray(t_s, dtype=np.float64), DAY_S)
    return days + _UNIX_JD, rest_s / DAY_S


@cache
def _ut1() -> tuple[Floats, Floats, Floats]:
    known = ut1.table()
    return np.array(known.starts_s), np.array(known.smooth_s), np.array(known.leaps_s)


def dut1_at(t_s: ArrayLike) -> Floats:
    """Return UT1 - UTC in seconds at POSIX seconds, as `dut1.dut1_s` does for one time."""
    starts, smooth, leaps = _ut1()
    times = np.asarray(t_s, dtype=np.float64)
    month = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, len(starts) - 1)
    return np.asarray(np.interp(times, starts, smooth) + leaps[month])


def sidereal_rad(t_s: ArrayLike, dut1: ArrayLike) -> Floats:
    """Return Greenwich mean sidereal time (IAU 1982; Aoki et al. 1982) in radians, 0 to 2 pi.

    `t_s` in POSIX seconds of UTC, `dut1` is UT1 - UTC in seconds.
    """
    ut1_s = np.asarray(t_s, dtype=np.float64) - _J2000_UNIX_S + np.asarray(dut1, dtype=np.float64)
    days: Floats = ut1_s / DAY_S
    t = days / 36525.0
    beyond_days_s = 67310.54841 + t * (8640184.812866 + t * (0.093104 - 6.2e-6 * t))
    turns: Floats = (beyond_days_s / DAY_S + days % 1.0) % 1.0
    return turns * (2.0 * math.pi)


@dataclass(frozen=True, slots=True)
class SiteVectors:
    """An observer in numbers that the transforms use, km and radians."""

    axis_km: float
    """Distance from the Earth's axis."""
    north_km: float
    """Distance north of the equator's plane."""
    sin_lat: float
    cos_lat: float
    longitude_rad: float
    latitude_rad: float
    """Geodetic."""

    @classmethod
    def of(cls, observer: Observer) -> SiteVectors:
        """Return the site of a place on the WGS84 ellipsoid."""
        latitude = math.radians(observer.latitude_deg)
        sin_lat, cos_lat = math.sin(latitude), math.cos(latitude)
        e2 = _FLATTENING * (2.0 - _FLATTENING)
        normal_km = _EQUATOR_KM / math.sqrt(1.0 - e2 * sin_lat * sin_lat)
        height_km = observer.height_m / 1000.0
        return cls(
            axis_km=(normal_km + height_km) * cos_lat,
            north_km=(normal_km * (1.0 - e2) + height_km) * sin_lat,
            sin_lat=sin_lat,
            cos_lat=cos_lat,
            longitude_rad=math.radians(observer.longitude_deg),
            latitude_rad=latitude,
        )

    @property
    def height_km(self) -> float:
        """The height of the site along its own vertical: site . up."""
        return self.axis_km * self.cos_lat + self.north_km * self.sin_lat


@dataclass(frozen=True, slots=True)
class LookArrays:
    """Where satellites stand for an observer; one entry for each satellite, or for each time.

    NaN where SGP4 has no position (it has decayed, or its elements are no orbit).
    """

    az_deg: Floats
    """0 to 360, clockwise from true north."""
    el_deg: Floats
    """Geometric: without refraction."""
    range_km: Floats
    range_rate_km_s: Floats
    """Positive while it moves away."""


def look(observer: Observer, t_s: ArrayLike, position_km: Floats, velocity_km_s: Floats) -> LookArrays:
    """Return the look angles of TEME states (n, 3) at POSIX seconds `t_s`: one time for all, or one for each."""
    times = np.asarray(t_s, dtype=np.float64)
    site = SiteVectors.of(observer)
    angle = sidereal_rad(times, dut1_at(times)) + site.longitude_rad
    c, s = np.cos(angle), np.sin(angle)
    px = position_km[:, 0] - site.axis_km * c
    py = position_km[:, 1] - site.axis_km * s
    pz = position_km[:, 2] - site.north_km
    turn = site.axis_km * SIDEREAL_RATE_RAD_S
    qx = velocity_km_s[:, 0] + turn * s
    qy = velocity_km_s[:, 1] - turn * c
    outward = c * px + s * py
    east = c * py - s * px
    north = site.cos_lat * pz - site.sin_lat * outward
    up = site.cos_lat * outward + site.sin_lat * pz
    level = np.hypot(east, north)
    range_km = np.hypot(level, up)
    az_deg = np.degrees(np.arctan2(east, north)) % 360.0
    return LookArrays(
        az_deg=np.where(az_deg == 360.0, 0.0, az_deg),
        el_deg=np.degrees(np.arctan2(up, level)),
        range_km=range_km,
        range_rate_km_s=(px * qx + py * qy + pz * velocity_km_s[:, 2]) / range_km,
    )


def line_of_sight(observer: Observer, t_s: Floats, position_km: Floats) -> Floats:
    """Return the unit vectors (n, 3), TEME, from the observer to the satellite at POSIX seconds `t_s`."""
    site = SiteVectors.of(observer)
    angle = sidereal_rad(t_s, dut1_at(t_s)) + site.longitude_rad
    here = np.stack([site.axis_km * np.cos(angle), site.axis_km * np.sin(angle), np.full(len(t_s), site.north_km)], 1)
    away = position_km - here
    found: Floats = away / np.linalg.norm(away, axis=1)[:, None]
    return found
