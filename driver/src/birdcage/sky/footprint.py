"""From where a satellite is seen: the ring on Earth along which it stands in the horizon."""

from __future__ import annotations

import math

_EQUATOR_KM = 6378.137  # WGS84
_POLE_KM = 6356.752314245
_MEAN_KM = 6371.0088


def footprint(
    latitude_deg: float, longitude_deg: float, altitude_km: float, points: int = 180
) -> tuple[tuple[float, float], ...]:
    """Return the ring as (latitude, longitude) in degrees, geodetic: its first point again as its last.

    The satellite is given by the point under it and its height above the ellipsoid. Along the ring it stands at 0
    degrees geometric over the WGS84 ellipsoid. Empty for one that is not above ground.

    A satellite stands in the horizon of a place whose tangent plane it lies in. Stretched along its axis the Earth
    is a sphere, planes stay planes and what touches still touches: so the ring is a circle there.
    """
    if not altitude_km > 0.0:
        return ()
    latitude, longitude = math.radians(latitude_deg), math.radians(longitude_deg)
    flat = 1.0 - (_POLE_KM / _EQUATOR_KM) ** 2
    normal_km = _EQUATOR_KM / math.sqrt(1.0 - flat * math.sin(latitude) ** 2)
    # Where the satellite is on that sphere of radius 1.
    axis = (normal_km + altitude_km) * math.cos(latitude) / _EQUATOR_KM
    north = (normal_km * (1.0 - flat) + altitude_km) * math.sin(latitude) / _POLE_KM
    away = math.hypot(axis, north)
    c, s = axis / away, north / away
    near, wide = 1.0 / away, math.sqrt(1.0 - 1.0 / (away * away))
    ring = []
    for step in range(points + 1):
        bearing = 2.0 * math.pi * step / points
        up, east = wide * math.cos(bearing), wide * math.sin(bearing)
        outward, z = near * c - up * s, near * s + up * c
        # A place's vertical stands on its tangent plane: geodetic latitude at once, not that of the sphere.
        level = math.hypot(outward, east)
        place = math.atan2(z * _EQUATOR_KM, level * _POLE_KM)
        turned = math.degrees(longitude + math.atan2(east, outward))
        ring.append((math.degrees(place), (turned + 180.0) % 360.0 - 180.0))
    return tuple(ring)


def radius_km(altitude_km: float) -> float:
    """Return how far over ground the ring lies from the point under the satellite, on a mean sphere; to 1 percent."""
    if not altitude_km > 0.0:
        return 0.0
    return _MEAN_KM * math.acos(_MEAN_KM / (_MEAN_KM + altitude_km))
