"""How a simulated dish stands: where its beam truly looks when its shafts are at some angles."""

from __future__ import annotations

import math

from birdcage.base.geometry import wrap_360
from birdcage.sim.settings import SimSettings

Vector = tuple[float, float, float]
"""East, north, up."""


class Stance:
    """A base turned by `heading`, leaning by `tilt_north` and `tilt_east`, with a beam `collimation` to the left."""

    def __init__(self, settings: SimSettings) -> None:
        self._settings = settings
        lean = math.radians(math.hypot(settings.tilt_north, settings.tilt_east))
        towards = math.atan2(settings.tilt_east, settings.tilt_north)
        # The axis leans towards `towards`: everything turns about the level line a quarter turn clockwise of that.
        self._about = (math.sin(towards + math.pi / 2), math.cos(towards + math.pi / 2), 0.0)
        self._lean = lean
        self._level = not lean and not settings.collimation

    def beam(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return the true azimuth (0..360) and elevation of the beam for the dish's own."""
        az_deg += self._settings.heading
        if self._level:
            return wrap_360(az_deg), el_deg
        az, el, aside = (math.radians(angle) for angle in (az_deg, el_deg, self._settings.collimation))
        ahead = (math.sin(az) * math.cos(el), math.cos(az) * math.cos(el), math.sin(el))
        left = (-math.cos(az), math.sin(az), 0.0)
        east, north, up = self._leaned(
            (
                ahead[0] * math.cos(aside) + left[0] * math.sin(aside),
                ahead[1] * math.cos(aside) + left[1] * math.sin(aside),
                ahead[2] * math.cos(aside),
            )
        )
        return wrap_360(math.degrees(math.atan2(east, north))), math.degrees(math.atan2(up, math.hypot(east, north)))

    def _leaned(self, way: Vector) -> Vector:
        """Turn a vector by the lean of the axis (Rodrigues' formula; clockwise seen along the line it turns about)."""
        x, y, z = way
        a, b, c = self._about
        cos, sin = math.cos(self._lean), -math.sin(self._lean)
        dot = (a * x + b * y + c * z) * (1.0 - cos)
        return (
            x * cos + (b * z - c * y) * sin + a * dot,
            y * cos + (c * x - a * z) * sin + b * dot,
            z * cos + (a * y - b * x) * sin + c * dot,
        )
