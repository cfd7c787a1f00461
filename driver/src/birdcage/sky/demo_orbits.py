"""Made-up satellites for the demo, laid so that the sky over one place is never empty and passes come one by one.

Every orbit is of a kind that is really flown, and each is named `DEMO` and by its kind: nothing here is a satellite
that exists. A low orbit is laid backwards: from where it has to be at its closest approach to the element set that
brings it there, with the drift of node and perigee by the Earth's flattening (J2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import UTC, datetime

from birdcage.sky.demo_plan import HIGH, LOW, MEDIUM, STATIONARY, High, Low, Medium
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer

SOURCE = "demo"
FIRST_ID = 999_000_001
"""Nine digits, where no catalogue has numbers yet, so that no real satellite is meant."""

_EARTH_KM = 6378.135
_MU_KM3_S2 = 398600.8
_J2 = 1.082616e-3
"""WGS72, as SGP4 has it."""
_SIDEREAL_DEG_S = 360.98564736629 / 86400.0
_J2000 = datetime(2000, 1, 1, 12, tzinfo=UTC)


def demo_orbits(now: datetime, observer: Observer) -> tuple[ElementSet, ...]:
    """Return 29 made-up satellites with `now` (aware) as their epoch, laid for the sky over this place.

    One passes above 30 degrees within two minutes, another rises within them, and for two hours a pass comes about
    every ten minutes; satellites of medium and high orbits are up all the time, geostationary ones wherever the place
    sees any. Latitudes that an inclination does not reach get the same height on a polar orbit.
    """
    if now.tzinfo is None:
        raise ValueError("the time must say its zone")
    greenwich_deg = _greenwich_deg(now)
    laid = [
        *(_low(one, number, observer, greenwich_deg) for number, one in enumerate(LOW, 1)),
        *(_medium(one, number, observer, greenwich_deg) for number, one in enumerate(MEDIUM, 1)),
        *(_high(one, number, observer, greenwich_deg) for number, one in enumerate(HIGH, 1)),
        *(_stationary(offset, observer, greenwich_deg) for offset in STATIONARY),
    ]
    return tuple(_elements(orbit, f"DEMO {orbit.name}", FIRST_ID + index, now) for index, orbit in enumerate(laid))


def turning_orbit(
    name: str, norad_id: int, now: datetime, tca_s: float, height_km: float, place: tuple[float, float]
) -> ElementSet:
    """Return the elements, with `now` (aware) as their epoch, of a circular orbit eastward that turns at a place.

    `tca_s` seconds later it is there: latitude and longitude in degrees, the latitude its northernmost or southernmost.
    """
    latitude_deg, longitude_deg = place
    along_deg = math.copysign(90.0, latitude_deg)
    node_deg_s, along_deg_s = _drifts(height_km, abs(latitude_deg))
    orbit = _Orbit(
        name, abs(latitude_deg),
        _greenwich_deg(now) + _SIDEREAL_DEG_S * tca_s + longitude_deg - along_deg - node_deg_s * tca_s,
        along_deg - along_deg_s * tca_s, _mean_motion(height_km),
    )  # fmt: skip
    return _elements(orbit, name, norad_id, now)


def _drifts(height_km: float, inclination_deg: float) -> tuple[float, float]:
    """Return how fast J2 turns the node, and how fast the argument of latitude of a circular orbit grows, in deg/s."""
    mean_motion_deg_s = _mean_motion(height_km) / 240.0
    drift = 1.5 * _J2 * (_EARTH_KM / (_EARTH_KM + height_km)) ** 2 * mean_motion_deg_s
    cosine = math.cos(math.radians(inclination_deg))
    return -drift * cosine, mean_motion_deg_s + drift * (2.5 * cosine**2 - 0.5)


def _greenwich_deg(now: datetime) -> float:
    return (280.46061837 + 360.98564736629 * (now - _J2000).total_seconds() / 86400.0) % 360.0


def _elements(orbit: _Orbit, name: str, norad_id: int, now: datetime) -> ElementSet:
    return ElementSet(
        name=name,
        norad_id=norad_id,
        epoch=now,
        inclination_deg=orbit.inclination_deg,
        raan_deg=round(orbit.raan_deg % 360.0, 4),
        eccentricity=orbit.eccentricity,
        argument_of_perigee_deg=orbit.perigee_deg,
        mean_anomaly_deg=round(orbit.mean_anomaly_deg % 360.0, 4),
        mean_motion_rev_day=round(orbit.mean_motion_rev_day, 8),
        source=SOURCE,
    )


@dataclass(frozen=True, slots=True)
class _Orbit:
    name: str
    inclination_deg: float
    raan_deg: float
    mean_anomaly_deg: float
    mean_motion_rev_day: float
    eccentricity: float = 0.0002
    perigee_deg: float = 0.0


def _mean_motion(height_km: float) -> float:
    """Return revolutions a day of a circular orbit."""
    return 86400.0 / (2.0 * math.pi) * math.sqrt(_MU_KM3_S2 / (_EARTH_KM + height_km) ** 3)


def _beside(observer: Observer, bearing_deg: float, distance_deg: float) -> tuple[float, float]:
    """Return latitude and longitude so far away in that direction, on a sphere."""
    latitude, bearing, distance = (math.radians(x) for x in (observer.latitude_deg, bearing_deg, distance_deg))
    sine = math.sin(latitude) * math.cos(distance) + math.cos(latitude) * math.sin(distance) * math.cos(bearing)
    there = math.asin(max(-1.0, min(1.0, sine)))
    east = math.atan2(
        math.sin(bearing) * math.sin(distance) * math.cos(latitude),
        math.cos(distance) - math.sin(latitude) * math.sin(there),
    )
    return math.degrees(there), observer.longitude_deg + math.degrees(east)


def _over(latitude_deg: float, inclination_deg: float, *, northbound: bool) -> tuple[float, float]:
    """Return the argument of latitude above a latitude, and how far east of the node that is, both in degrees."""
    inclination = math.radians(inclination_deg)
    along = math.asin(max(-1.0, min(1.0, math.sin(math.radians(latitude_deg)) / math.sin(inclination))))
    if not northbound:
        along = math.pi - along
    east = math.atan2(math.cos(inclination) * math.sin(along), math.cos(along))
    return math.degrees(along), math.degrees(east)


def _reaching(inclination_deg: float, latitude_deg: float) -> float:
    """Return the inclination, or a steeper one where it does not come to that latitude."""
    highest_deg = min(inclination_deg, 180.0 - inclination_deg)
    return inclination_deg if abs(latitude_deg) < highest_deg - 1.0 else 90.0


def _heading(observer: Observer, inclination_deg: float, *, northbound: bool) -> float:
    """Return the direction in which a satellite overhead moves, in degrees from north, on a sphere at rest."""
    cosine = math.cos(math.radians(inclination_deg)) / max(0.02, math.cos(math.radians(observer.latitude_deg)))
    heading_deg = math.degrees(math.asin(max(-1.0, min(1.0, cosine))))
    return heading_deg if northbound else 180.0 - heading_deg


def _low(one: Low, number: int, observer: Observer, greenwich_deg: float) -> _Orbit:
    inclination_deg = _reaching(one.inclination_deg, observer.latitude_deg)
    heading_deg = _heading(observer, inclination_deg, northbound=one.northbound)
    latitude_deg, longitude_deg = _beside(observer, heading_deg + 90.0, one.aside_deg)
    if abs(latitude_deg) >= min(inclination_deg, 180.0 - inclination_deg):
        latitude_deg, longitude_deg = _beside(observer, heading_deg - 90.0, one.aside_deg)
    along_deg, east_deg = _over(latitude_deg, inclination_deg, northbound=one.northbound)
    seconds = one.tca_min * 60.0
    node_deg_s, along_deg_s = _drifts(one.height_km, inclination_deg)
    return _Orbit(
        name=f"LEO {number} {one.kind}",
        inclination_deg=inclination_deg,
        raan_deg=greenwich_deg + _SIDEREAL_DEG_S * seconds + longitude_deg - east_deg - node_deg_s * seconds,
        mean_anomaly_deg=along_deg - along_deg_s * seconds,
        mean_motion_rev_day=_mean_motion(one.height_km),
    )


def _medium(one: Medium, number: int, observer: Observer, greenwich_deg: float) -> _Orbit:
    latitude_deg, longitude_deg = _beside(observer, one.bearing_deg, one.distance_deg)
    latitude_deg = max(2.0 - one.inclination_deg, min(one.inclination_deg - 2.0, latitude_deg))
    along_deg, east_deg = _over(latitude_deg, one.inclination_deg, northbound=one.northbound)
    return _Orbit(
        name=f"MEO {number} {one.kind}",
        inclination_deg=one.inclination_deg,
        raan_deg=greenwich_deg + longitude_deg - east_deg,
        mean_anomaly_deg=along_deg,
        mean_motion_rev_day=_mean_motion(one.height_km),
    )


def _high(one: High, number: int, observer: Observer, greenwich_deg: float) -> _Orbit:
    # The perigee lies on the other half of the Earth.
    perigee_deg, apogee_from_node_deg = (270.0, 90.0) if observer.latitude_deg >= 0.0 else (90.0, -90.0)
    return _Orbit(
        name=f"HEO {number} {one.kind}",
        inclination_deg=one.inclination_deg,
        raan_deg=greenwich_deg + observer.longitude_deg + one.east_deg - apogee_from_node_deg,
        mean_anomaly_deg=180.0 + one.since_apogee_min * one.mean_motion_rev_day / 4.0,
        mean_motion_rev_day=one.mean_motion_rev_day,
        eccentricity=one.eccentricity,
        perigee_deg=perigee_deg,
    )


def _stationary(offset_deg: int, observer: Observer, greenwich_deg: float) -> _Orbit:
    slot_deg = (round(observer.longitude_deg) + offset_deg + 180) % 360 - 180
    return _Orbit(
        name=f"GEO {abs(slot_deg)}{'W' if slot_deg < 0 else 'E'}",
        inclination_deg=0.03,
        raan_deg=greenwich_deg,
        mean_anomaly_deg=float(slot_deg),
        mean_motion_rev_day=1.00273791,
        eccentricity=0.0001,
    )
