"""Day and night on Earth: where the Sun stands overhead, and the line along which it rises and sets."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime

from birdcage.base.geometry import shortest_turn
from birdcage.sky.sun import sun


@dataclass(frozen=True, slots=True)
class SubSolar:
    """The place that has the Sun overhead; degrees, geodetic, longitude -180 to 180.

    Right to a hundredth of a degree (`sky.sun`). Sunrise here is the Sun's centre at 0 degrees, without refraction.
    """

    latitude_deg: float
    longitude_deg: float

    def elevation_deg(self, latitude_deg: float, longitude_deg: float) -> float:
        """Return how high the Sun stands over a place; negative by night."""
        latitude, overhead = math.radians(latitude_deg), math.radians(self.latitude_deg)
        hour = math.radians(longitude_deg - self.longitude_deg)
        rise = math.sin(latitude) * math.sin(overhead) + math.cos(latitude) * math.cos(overhead) * math.cos(hour)
        return math.degrees(math.asin(min(1.0, max(-1.0, rise))))

    def terminator_deg(self, longitude_deg: float) -> float:
        """Return the latitude at which the Sun stands in the horizon of a meridian, -90 to 90.

        At an equinox the line runs along two meridians, and from pole to pole between them: then one of the poles.
        """
        hour = math.radians(longitude_deg - self.longitude_deg)
        overhead = math.radians(self.latitude_deg)
        # From tan(latitude) = -cos(hour) / tan(overhead), which has one answer on every meridian.
        rise = math.copysign(1.0, overhead)
        return math.degrees(math.atan2(-math.cos(hour) * math.cos(overhead) * rise, abs(math.sin(overhead))))


def sub_solar(when: datetime) -> SubSolar:
    """Return where the Sun stands overhead. `when` is aware; ValueError otherwise."""
    # At the north pole the Sun's elevation is its declination, and its azimuth counts the hours from Greenwich.
    az_deg, el_deg = sun(when, 90.0, 0.0)
    return SubSolar(el_deg, shortest_turn(az_deg, 180.0))
