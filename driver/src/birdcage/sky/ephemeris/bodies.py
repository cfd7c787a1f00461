"""Sun, Moon and planets: apparent places for an observer, with light time, aberration and parallax."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from types import MappingProxyType
from typing import Any

from birdcage.sky.ephemeris.worker import ephemeris, standpoint
from birdcage.sky.look import LookAngle
from birdcage.sky.observer import Observer


@dataclass(frozen=True, slots=True)
class Body:
    """One body of the solar system."""

    name: str
    key: str
    """Its name in the ephemeris: from Jupiter on the middle of planet and moons, 0.1 arcseconds from the planet's."""
    radius_km: float
    """Mean radius (IAU working group on cartographic coordinates, report of 2015)."""

    def look(self, observer: Observer, when: datetime) -> LookAngle:
        """Return where its middle stands. NotCovered outside 2020 to 2053, ValueError for a naive time."""
        return _look(standpoint(observer, when).observe(ephemeris()[self.key]))

    def width_deg(self, range_km: float) -> float:
        """Return how wide its disc is from that far."""
        return math.degrees(2.0 * math.asin(self.radius_km / range_km))


BODIES = MappingProxyType(
    {
        body.name.lower(): body
        for body in (
            Body("Sun", "sun", 695_700.0),
            Body("Moon", "moon", 1_737.4),
            Body("Mercury", "mercury", 2_439.4),
            Body("Venus", "venus", 6_051.8),
            Body("Mars", "mars", 3_389.5),
            Body("Jupiter", "jupiter barycenter", 69_911.0),
            Body("Saturn", "saturn barycenter", 58_232.0),
            Body("Uranus", "uranus barycenter", 25_362.0),
            Body("Neptune", "neptune barycenter", 24_622.0),
        )
    }
)
"""By name in small letters, in the order in which they are shown."""


def look_at_star(observer: Observer, when: datetime, ra_deg: float, dec_deg: float) -> LookAngle:
    """Return where a point of the sky stands: right ascension and declination in degrees, ICRS (as good as J2000).

    NotCovered outside 2020 to 2053, ValueError for a naive time.
    """
    from skyfield.api import Star  # type: ignore[import-untyped]

    seen = _look(standpoint(observer, when).observe(Star(ra_hours=ra_deg / 15.0, dec_degrees=dec_deg)))
    return LookAngle(seen.az_deg, seen.el_deg)


def _look(astrometric: Any) -> LookAngle:  # noqa: ANN401 - skyfield has no types
    el, az, distance = astrometric.apparent().altaz()
    away_km_s = float(astrometric.position.km @ astrometric.velocity.km_per_s) / float(distance.km)
    az_deg = float(az.degrees) % 360.0
    return LookAngle(0.0 if az_deg == 360.0 else az_deg, float(el.degrees), float(distance.km), away_km_s)
