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


def offset(az1_deg: float, el1_deg: float, az2_deg: float, el2_deg: float) -> tuple[float, float]:
    """Return how far the second direction lies to the right of the first and above it, in degrees on the sky.

    Both together are the separation, whatever its size.
    """
    el1, el2, turn = math.radians(el1_deg), math.radians(el2_deg), math.radians(az2_deg - az1_deg)
    right = math.cos(el2) * math.sin(turn)
    up = math.cos(el1) * math.sin(el2) - math.sin(el1) * math.cos(el2) * math.cos(turn)
    aside = math.hypot(right, up)
    scale = separation(az1_deg, el1_deg, az2_deg, el2_deg) / aside if aside else 0.0
    return right * scale, up * scale


def beside(az_deg: float, el_deg: float, right_deg: float, up_deg: float) -> tuple[float, float]:
    """Return the direction that lies so far to the right of another and above it: `offset` backwards."""
    away, el = math.radians(math.hypot(right_deg, up_deg)), math.radians(el_deg)
    bearing = math.atan2(right_deg, up_deg)
    height = math.sin(el) * math.cos(away) + math.cos(el) * math.sin(away) * math.cos(bearing)
    there = math.asin(min(1.0, max(-1.0, height)))
    turn = math.atan2(math.sin(bearing) * math.sin(away) * math.cos(el), math.cos(away) - math.sin(el) * height)
    return wrap_360(az_deg + math.degrees(turn)), math.degrees(there)


def separation(az1_deg: float, el1_deg: float, az2_deg: float, el2_deg: float) -> float:
    """Return the angle on the sky between two directions, in [0, 180] (haversine, exact for small angles)."""
    d_az = math.radians(az2_deg - az1_deg)
    el1, el2 = math.radians(el1_deg), math.radians(el2_deg)
    h = math.sin((el2 - el1) / 2) ** 2 + math.cos(el1) * math.cos(el2) * math.sin(d_az / 2) ** 2
    return math.degrees(2 * math.asin(math.sqrt(min(max(h, 0.0), 1.0))))
