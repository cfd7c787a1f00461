"""Where geostationary satellites stand, seen from a place on the ground.

Ellipsoidal: the observer's position is that of a point on WGS84 (NGA.STND.0036, version 1.0.0, section 3: a and 1/f),
turned into local east, north and up (Montenbruck and Gill, "Satellite Orbits", sections 2.2 and 5.5: topocentric
coordinates); the satellite is taken to stand exactly over the equator at the radius of the geostationary orbit.
Refraction is left out: it is under 0.1 degrees above 8 degrees of elevation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

WGS84_A_KM = 6378.137
WGS84_F = 1 / 298.257223563
GEOSTATIONARY_RADIUS_KM = 42164.17
"""The semi-major axis of an orbit with the period of one sidereal day (mu = 398600.4418 km3/s2)."""


@dataclass(frozen=True, slots=True)
class Slot:
    """A place on the arc, in degrees east (negative is west), and who is known to stand there."""

    longitude_deg: float
    name: str

    @property
    def label(self) -> str:
        """The longitude as people write it: `101°W`, `28.2°E`."""
        half = "E" if self.longitude_deg >= 0 else "W"
        return f"{abs(self.longitude_deg):g}°{half}"


SLOTS = (
    Slot(-139.0, "AMC 18"),
    Slot(-129.0, "Ciel 2"),
    Slot(-119.0, "EchoStar 14"),
    Slot(-110.0, "EchoStar 10"),
    Slot(-101.0, "SES 1"),
    Slot(-95.0, "Galaxy 3C"),
    Slot(-91.0, "Galaxy 17"),
    Slot(-82.0, "Nimiq 4"),
    Slot(-72.7, "Nimiq 5"),
    Slot(-61.5, "EchoStar 16"),
    Slot(-30.0, "Hispasat"),
    Slot(-15.0, "Telstar 12V"),
    Slot(-5.0, "Eutelsat 5W"),
    Slot(-0.8, "Thor"),
    Slot(4.8, "Astra 4A"),
    Slot(9.0, "Eutelsat 9"),
    Slot(13.0, "Hot Bird"),
    Slot(19.2, "Astra 19"),
    Slot(23.5, "Astra 23"),
    Slot(25.9, "Es'hail"),
    Slot(28.2, "Astra 28"),
    Slot(42.0, "Türksat"),
    Slot(52.5, "Yahsat"),
    Slot(66.0, "Intelsat 17"),
    Slot(83.0, "GSAT"),
    Slot(100.5, "AsiaSat 5"),
    Slot(110.5, "ChinaSat 10"),
    Slot(124.0, "JCSAT 4B"),
    Slot(138.0, "Telstar 18V"),
    Slot(156.0, "Optus"),
    Slot(166.0, "Intelsat 19"),
    Slot(-177.0, "NSS 9"),
)
"""Well-known slots all round the arc, by customary nominal longitudes. Satellites move house: a name is a hint."""


def look_angle(latitude_deg: float, longitude_deg: float, slot_deg: float) -> tuple[float, float]:
    """Return (azimuth, elevation) in degrees of a satellite over `slot_deg` east, seen from sea level at that place.

    Latitude is geodetic, -90 to 90; longitudes are positive eastwards, and whole turns do not matter. Azimuth is
    clockwise from true north, 0 to 360. Elevation is geometric, and negative when the satellite is below the horizon.
    ValueError when a number is not finite or the latitude is outside -90 to 90.
    """
    if not all(map(math.isfinite, (latitude_deg, longitude_deg, slot_deg))) or abs(latitude_deg) > 90:
        raise ValueError(f"no place on Earth: latitude {latitude_deg}, longitude {longitude_deg}, slot {slot_deg}")
    latitude, turn = math.radians(latitude_deg), math.radians(slot_deg - longitude_deg)
    sin_lat, cos_lat = math.sin(latitude), math.cos(latitude)
    e2 = WGS84_F * (2 - WGS84_F)
    normal_km = WGS84_A_KM / math.sqrt(1 - e2 * sin_lat**2)
    # Earth-fixed axes, turned so that the observer's meridian is the x axis.
    x = GEOSTATIONARY_RADIUS_KM * math.cos(turn) - normal_km * cos_lat
    y = GEOSTATIONARY_RADIUS_KM * math.sin(turn)
    z = -normal_km * (1 - e2) * sin_lat
    north = -sin_lat * x + cos_lat * z
    up = cos_lat * x + sin_lat * z
    az_deg = math.degrees(math.atan2(y, north)) % 360.0
    return (0.0 if az_deg == 360.0 else az_deg), math.degrees(math.atan2(up, math.hypot(y, north)))


def arc(
    latitude_deg: float, longitude_deg: float, step_deg: float = 2.0, el_min_deg: float = 0.0
) -> list[tuple[float, float, float]]:
    """Return (slot, azimuth, elevation) along the visible arc, from west of the observer to east, `step_deg` apart.

    Only what stands at `el_min_deg` or higher is in it; near the poles it is empty. ValueError as `look_angle`, and
    when the step is not positive.
    """
    if not step_deg > 0:
        raise ValueError(f"the step must be positive, not {step_deg}")
    points = []
    for index in range(int(180 / step_deg) + 1):
        slot_deg = longitude_deg - 90 + index * step_deg
        az_deg, el_deg = look_angle(latitude_deg, longitude_deg, slot_deg)
        if el_deg >= el_min_deg:
            points.append(((slot_deg + 180) % 360 - 180, az_deg, el_deg))
    return points


def slots_in_sight(
    latitude_deg: float, longitude_deg: float, el_min_deg: float = 0.0, el_max_deg: float = 90.0
) -> list[tuple[Slot, float, float]]:
    """Return (slot, azimuth, elevation) of well-known slots between two elevations, in order of azimuth."""
    found = []
    for slot in SLOTS:
        az_deg, el_deg = look_angle(latitude_deg, longitude_deg, slot.longitude_deg)
        if el_min_deg <= el_deg <= el_max_deg:
            found.append((slot, az_deg, el_deg))
    return sorted(found, key=lambda entry: entry[1])
