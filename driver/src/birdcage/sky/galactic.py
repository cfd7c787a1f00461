"""Galactic longitude and latitude (IAU 1958, in the form of the Hipparcos catalogue, ESA SP-1200, section 1.5.3)."""

from __future__ import annotations

import math

# Right ascension and declination (ICRS) of the galactic pole, and the longitude of the celestial pole.
_POLE_RA_DEG, _POLE_DEC_DEG, _NORTH_L_DEG = 192.85948, 27.12825, 122.93192


def equatorial(l_deg: float, b_deg: float) -> tuple[float, float]:
    """Return right ascension (0 to 360) and declination in degrees, ICRS, of a galactic direction."""
    pole, latitude = math.radians(_POLE_DEC_DEG), math.radians(b_deg)
    turn = math.radians(_NORTH_L_DEG - l_deg)
    east = math.cos(latitude) * math.sin(turn)
    towards = math.cos(pole) * math.sin(latitude) - math.sin(pole) * math.cos(latitude) * math.cos(turn)
    up = math.sin(pole) * math.sin(latitude) + math.cos(pole) * math.cos(latitude) * math.cos(turn)
    ra_deg = (_POLE_RA_DEG + math.degrees(math.atan2(east, towards))) % 360.0
    return (0.0 if ra_deg == 360.0 else ra_deg), math.degrees(math.atan2(up, math.hypot(east, towards)))
