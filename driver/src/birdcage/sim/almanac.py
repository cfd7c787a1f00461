"""Where the Sun and the geostationary slots stand in a place's sky: own formulae, nothing of the driver's."""

from __future__ import annotations

import math
from datetime import UTC, datetime

from birdcage.base.geometry import wrap_360

EARTH_RADIUS_KM = 6378.14
GEO_RADIUS_KM = 42164.17
_J2000 = datetime(2000, 1, 1, 12, tzinfo=UTC)
_TT_MINUS_UTC_S = 69.2


def sun(when: datetime, lat_deg: float, lon_deg: float) -> tuple[float, float]:
    """Return the Sun's azimuth and elevation without refraction, good to 0.01 degrees from 1950 to 2050.

    Meeus, Astronomical Algorithms, chapters 12, 13 and 25 (low accuracy, apparent place).
    """
    days = (when - _J2000).total_seconds() / 86400.0
    t = (days + _TT_MINUS_UTC_S / 86400.0) / 36525.0
    anomaly = math.radians(357.52911 + 35999.05029 * t - 0.0001537 * t * t)
    centre = (
        (1.914602 - 0.004817 * t) * math.sin(anomaly)
        + (0.019993 - 0.000101 * t) * math.sin(2 * anomaly)
        + 0.000289 * math.sin(3 * anomaly)
    )
    node = math.radians(125.04 - 1934.136 * t)
    longitude = 280.46646 + 36000.76983 * t + 0.0003032 * t * t + centre - 0.00569 - 0.00478 * math.sin(node)
    tilt = math.radians(23.439291 - 0.0130042 * t + 0.00256 * math.cos(node))
    lam = math.radians(longitude)
    right_ascension = math.atan2(math.cos(tilt) * math.sin(lam), math.cos(lam))
    declination = math.asin(math.sin(tilt) * math.sin(lam))
    sidereal_deg = 280.46061837 + 360.98564736629 * days - 0.00478 * math.sin(node) * math.cos(tilt)
    hour_angle = math.radians(sidereal_deg + lon_deg) - right_ascension
    lat = math.radians(lat_deg)
    el = math.asin(math.sin(lat) * math.sin(declination) + math.cos(lat) * math.cos(declination) * math.cos(hour_angle))
    east = -math.cos(declination) * math.sin(hour_angle)
    north = math.sin(declination) * math.cos(lat) - math.cos(declination) * math.sin(lat) * math.cos(hour_angle)
    return wrap_360(math.degrees(math.atan2(east, north))), math.degrees(el)


def geostationary(slot_deg_east: float, lat_deg: float, lon_deg: float) -> tuple[float, float]:
    """Return azimuth and elevation of a geostationary slot from a spherical Earth; negative when it has set."""
    lat, away = math.radians(lat_deg), math.radians(slot_deg_east - lon_deg)
    east = GEO_RADIUS_KM * math.sin(away)
    north = -GEO_RADIUS_KM * math.cos(away) * math.sin(lat)
    up = GEO_RADIUS_KM * math.cos(away) * math.cos(lat) - EARTH_RADIUS_KM
    return wrap_360(math.degrees(math.atan2(east, north))), math.degrees(math.atan2(up, math.hypot(east, north)))
