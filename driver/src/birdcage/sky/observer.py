"""Where somebody stands who looks at the sky."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Observer:
    """A place on Earth, in WGS84. ValueError for a place that is none."""

    latitude_deg: float
    """Geodetic, -90 to 90, north positive."""
    longitude_deg: float
    """East positive, -180 to 180."""
    height_m: float = 0.0
    """Above the ellipsoid."""
    name: str = ""

    def __post_init__(self) -> None:
        numbers = (self.latitude_deg, self.longitude_deg, self.height_m)
        if not all(map(math.isfinite, numbers)) or abs(self.latitude_deg) > 90.0 or abs(self.longitude_deg) > 180.0:
            raise ValueError(f"no place on Earth: latitude {numbers[0]}, longitude {numbers[1]}, height {numbers[2]} m")
