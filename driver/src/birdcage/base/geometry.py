"""Angles. Degrees in, degrees out."""

from __future__ import annotations

import math


def wrap_360(angle_deg: float) -> float:
    """Return the same direction in [0, 360)."""
    wrapped = angle_deg % 360.0
    return 0.0 if wrapped == 360.0 else wrapped


def shortest_turn(start_deg: float, end_deg: float) -> float:
    """Return the signed turn from start to end, in [-180, 180); positive is clockwise for azimuths."""
    return (end_deg - start_deg + 180.0) % 360.0 - 180.0


def separation(az1_deg: float, el1_deg: float, az2_deg: float, el2_deg: float) -> float:
    """Return the angle on the sky between two directions, in [0, 180] (haversine, exact for small angles)."""
    d_az = math.radians(az2_deg - az1_deg)
    el1, el2 = math.radians(el1_deg), math.radians(el2_deg)
    h = math.sin((el2 - el1) / 2) ** 2 + math.cos(el1) * math.cos(el2) * math.sin(d_az / 2) ** 2
    return math.degrees(2 * math.asin(min(1.0, math.sqrt(h))))
