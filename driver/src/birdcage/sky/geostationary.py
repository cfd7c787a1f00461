"""Where geostationary satellites stand, seen from a place on the ground.

Ellipsoidal: the observer's position is that of a point on WGS84 (NGA.STND.0036, version 1.0.0, section 3: a and 1/f),
turned into local east, north and up (Montenbruck and Gill, "Satellite Orbits", sections 2.2 and 5.5: topocentric
coordinates); the satellite is taken to stand exactly over the equator at the radius of the geostationary orbit.
Refraction is left out: it is under 0.1 degrees above 8 degrees of elevation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from birdcage.sky.observer import Observer
from birdcage.sky.slots import Slot, slots

WGS84_A_KM = 6378.137
WGS84_F = 1 / 298.257223563
GEOSTATIONARY_RADIUS_KM = 42164.17
"""The semi-major axis of an orbit with the period of one sidereal day (mu = 398600.4418 km3/s2)."""


def look_angle(latitude_deg: float, longitude_deg: float, slot_deg: float) -> tuple[float, float]:
    """Return (azimuth, elevation) in degrees of a satellite over `slot_deg` east, seen from sea level at that place.

    Latitude is geodetic, -90 to 90; longitudes are positive eastwards, and whole turns do not matter. Azimuth is
    clockwise from true north, 0 to 360. Elevation is geometric, and negative when the satellite is below the horizon.
    ValueError when a number is not finite or the latitude is outside -90 to 90.
    """
    east, north, up = _line_of_sight(latitude_deg, longitude_deg, slot_deg)
    return _azimuth(east, north), math.degrees(math.atan2(up, math.hypot(east, north)))


@dataclass(frozen=True, slots=True)
class SlotLook:
    """What an observer needs to know of a place on the arc."""

    az_deg: float
    el_deg: float
    range_km: float
    skew_deg: float
    """How far a feed must be turned for linear polarisation, -90 to 90: clockwise is positive, looking from behind the
    dish towards the satellite. The slot's own tilt, some degrees on a few of them, comes on top (`sky.skew`)."""

    @property
    def visible(self) -> bool:
        """Whether it stands above the geometric horizon."""
        return self.el_deg > 0.0


def look_at_slot(observer: Observer, slot_deg: float) -> SlotLook:
    """Return where a satellite over `slot_deg` east stands for an observer, how far, and with which skew.

    The skew is the angle at the line of sight between the observer's vertical and the Earth's axis, from their
    projections on the plane across it (exact; the usual formula
    atan(sin(site - satellite) / tan(latitude)) is up to 0.4 degrees off). ValueError when the slot is not finite.
    """
    east, north, up = _line_of_sight(observer.latitude_deg, observer.longitude_deg, slot_deg, observer.height_m)
    far_km = math.sqrt(east * east + north * north + up * up)
    latitude = math.radians(observer.latitude_deg)
    # Across the line of sight: the right hand is (north, -east), which is level; the vertical is what is left of up.
    level_km = math.hypot(east, north)
    if level_km < 1e-6 * far_km:  # in the zenith no direction is up: the dish's top is taken to point north
        skew = 0.0
    else:
        to_the_right = -math.cos(latitude) * east / level_km
        upwards = (math.sin(latitude) * level_km - math.cos(latitude) * north * up / level_km) / far_km
        skew = math.degrees(math.atan2(to_the_right, upwards))
    skew = skew - 180.0 if skew > 90.0 else skew + 180.0 if skew <= -90.0 else skew
    return SlotLook(_azimuth(east, north), math.degrees(math.atan2(up, level_km)), far_km, skew)


def _line_of_sight(
    latitude_deg: float, longitude_deg: float, slot_deg: float, height_m: float = 0.0
) -> tuple[float, float, float]:
    """Return the way from a place to a satellite in km: east, north, up."""
    if not all(map(math.isfinite, (latitude_deg, longitude_deg, slot_deg))) or abs(latitude_deg) > 90:
        raise ValueError(f"no place on Earth: latitude {latitude_deg}, longitude {longitude_deg}, slot {slot_deg}")
    latitude, turn = math.radians(latitude_deg), math.radians(slot_deg - longitude_deg)
    sin_lat, cos_lat = math.sin(latitude), math.cos(latitude)
    e2 = WGS84_F * (2 - WGS84_F)
    normal_km, height_km = WGS84_A_KM / math.sqrt(1 - e2 * sin_lat**2), height_m / 1000.0
    # Earth-fixed axes, turned so that the observer's meridian is the x axis.
    x = GEOSTATIONARY_RADIUS_KM * math.cos(turn) - (normal_km + height_km) * cos_lat
    y = GEOSTATIONARY_RADIUS_KM * math.sin(turn)
    z = -(normal_km * (1 - e2) + height_km) * sin_lat
    return y, -sin_lat * x + cos_lat * z, cos_lat * x + sin_lat * z


def _azimuth(east: float, north: float) -> float:
    az_deg = math.degrees(math.atan2(east, north)) % 360.0
    return 0.0 if az_deg == 360.0 else az_deg


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
    latitude_deg: float,
    longitude_deg: float,
    el_min_deg: float = 0.0,
    el_max_deg: float = 90.0,
    band: str | None = "Ku",
) -> list[tuple[Slot, float, float]]:
    """Return (slot, azimuth, elevation) of well-known slots between two elevations, in order of azimuth.

    `band`: `Ku`, which the dish was made for, `L`, `Ka`, or None for all.
    """
    found = []
    for slot in slots():
        if band not in (None, slot.band):
            continue
        az_deg, el_deg = look_angle(latitude_deg, longitude_deg, slot.longitude_deg)
        if el_min_deg <= el_deg <= el_max_deg:
            found.append((slot, az_deg, el_deg))
    return sorted(found, key=lambda entry: entry[1])
