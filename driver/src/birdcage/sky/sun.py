"""Where the Sun stands, from UTC and a place: to a hundredth of a degree from 2020 to 2050.

The PSA+ algorithm: M. J. Blanco, K. Milidonis, A. M. Bonanos, "Updating the PSA sun position algorithm", Solar Energy
212 (2020) 339-341. Its longitude and obliquity are short series fitted for those years; parallax is taken off.
Refraction is left out: it is 0.05 degrees at 18 degrees of elevation, and less above.
"""

from __future__ import annotations

import math
from datetime import UTC, datetime

_J2000 = datetime(2000, 1, 1, 12, tzinfo=UTC)
_EARTH_RADIUS_KM = 6371.01
_ASTRONOMICAL_UNIT_KM = 149597890.0


def sun(when: datetime, latitude_deg: float, longitude_deg: float) -> tuple[float, float]:
    """Return the Sun's true azimuth (0 to 360, clockwise from north) and geometric elevation, in degrees.

    `when` is aware. Latitude -90 to 90, longitude positive eastwards. ValueError for a naive time or no place.
    """
    if when.tzinfo is None:
        raise ValueError("the time must say its zone")
    if not (math.isfinite(longitude_deg) and abs(latitude_deg) <= 90.0):
        raise ValueError(f"no place on Earth: latitude {latitude_deg}, longitude {longitude_deg}")
    days = (when - _J2000).total_seconds() / 86400.0
    right_ascension, declination = _equatorial(days)
    hour = (days + 0.5) % 1.0 * 24.0
    sidereal_h = 6.697096103 + 6.570984737e-2 * days + hour
    latitude = math.radians(latitude_deg)
    hour_angle = math.radians(sidereal_h * 15.0 + longitude_deg) - right_ascension
    sin_lat, cos_lat = math.sin(latitude), math.cos(latitude)
    along = math.cos(declination) * math.cos(hour_angle)
    up = sin_lat * math.sin(declination) + cos_lat * along
    east = -math.cos(declination) * math.sin(hour_angle)
    north = cos_lat * math.sin(declination) - sin_lat * along
    az_deg = math.degrees(math.atan2(east, north)) % 360.0
    el_deg = math.degrees(math.atan2(up, math.hypot(east, north)))
    parallax_deg = math.degrees(_EARTH_RADIUS_KM / _ASTRONOMICAL_UNIT_KM) * math.cos(math.radians(el_deg))
    return (0.0 if az_deg == 360.0 else az_deg), el_deg - parallax_deg


def _equatorial(days: float) -> tuple[float, float]:
    """Return right ascension and declination in radians, `days` after noon of 1 January 2000."""
    node = 2.267127827 - 9.300339267e-4 * days
    mean_longitude = 4.895036035 + 1.720279602e-2 * days
    anomaly = 6.239468336 + 1.720200135e-2 * days
    longitude = (
        mean_longitude
        + 3.338320972e-2 * math.sin(anomaly)
        + 3.497596876e-4 * math.sin(2 * anomaly)
        - 1.544353226e-4
        - 8.689729360e-6 * math.sin(node)
    )
    obliquity = 4.090904909e-1 - 6.213605399e-9 * days + 4.418094944e-5 * math.cos(node)
    right_ascension = math.atan2(math.cos(obliquity) * math.sin(longitude), math.cos(longitude))
    return right_ascension, math.asin(math.sin(obliquity) * math.sin(longitude))
