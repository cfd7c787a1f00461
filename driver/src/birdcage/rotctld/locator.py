"""Hamlib's computations for operators: Maidenhead locators, degrees and minutes, distance and bearing. No dish needed.

They agree with its rotctld 4.5.4 to the last digit that it prints, its quirks included (docs/reference/rotctld.md,
*Locator commands*).
"""

from __future__ import annotations

import math
from string import ascii_uppercase, digits

KM_PER_DEG = 111.2
"""Of a great circle, as Hamlib has it."""
ROUND_THE_EARTH_KM = 360.0 * KM_PER_DEG
_ALPHABETS = (ascii_uppercase[:18], digits, ascii_uppercase[:24], digits, ascii_uppercase[:24], digits)
"""Of the pairs of a locator: fields of 20° x 10°, in 10 x 10 squares, in 24 x 24 subsquares, and so on."""
MOST_PAIRS = len(_ALPHABETS)


def to_locator(lon_deg: float, lat_deg: float, pairs: int) -> str:
    """Return the locator of a place in 1 to 6 pairs of characters. ValueError for other numbers, or far outside."""
    if not 1 <= pairs <= MOST_PAIRS:
        raise ValueError(f"{pairs} pairs")
    halves = []
    for half_deg in (lon_deg / 2.0, lat_deg):
        # From the south-west corner of the grid. The millionth keeps a place on an edge out of the square before it.
        left = math.fmod(half_deg + 270.000001, 180.0)
        if left < 0.0:
            raise ValueError(f"{half_deg} is no angle on the Earth")
        square, half = 180.0, []
        for alphabet in _ALPHABETS[:pairs]:
            square /= len(alphabet)
            index = min(int(left / square), len(alphabet) - 1)
            left -= square * index
            half.append(alphabet[index])
        halves.append(half)
    return "".join(east + north for east, north in zip(*halves, strict=True))


def from_locator(locator: str) -> tuple[float, float]:
    """Return longitude and latitude of the middle of a locator: its first 6 pairs. ValueError where it is none."""
    pairs = min(len(locator) // 2, MOST_PAIRS)
    if pairs < 1:
        raise ValueError(f"{locator} has no pair of characters")
    halves = []
    for offset in (0, 1):
        degrees, squares = -90.0, 1
        for pair, alphabet in enumerate(_ALPHABETS[:pairs]):
            squares *= len(alphabet)
            degrees += alphabet.index(locator[2 * pair + offset].upper()) * 180.0 / squares
        halves.append(degrees + 90.0 / squares)
    return halves[0] * 2.0, halves[1]


def from_dms(degrees: float, minutes: float, seconds: float, *, negative: bool) -> float:
    """Return decimal degrees. The sign comes from `negative` alone: 0° 30' south has no other place for it."""
    value = abs(degrees) + abs(minutes) / 60.0 + abs(seconds) / 3600.0
    return -value if negative else value


def to_dms(value_deg: float) -> tuple[int, int, float, bool]:
    """Return degrees, minutes, seconds, and whether it is negative, of an angle that is first brought to ±180°."""
    half_turn = 180.0 if value_deg >= 0.0 else -180.0
    angle = math.fmod(value_deg + half_turn, 360.0) - half_turn
    negative = angle < 0.0 and angle != -180.0
    angle = abs(angle)
    degrees = math.floor(angle)
    minutes_left = 60.0 * (angle - degrees)
    minutes = math.floor(minutes_left)
    return degrees, minutes, 60.0 * (minutes_left - minutes), negative


def distance_and_bearing(lon_deg: float, lat_deg: float, to_lon_deg: float, to_lat_deg: float) -> tuple[float, float]:
    """Return the short way along a great circle in km, and its bearing to a whole degree.

    Both are 0 for the same place, and the bearing is 0 for the opposite one. ValueError beyond ±180° and ±90°.
    """
    if max(abs(lat_deg), abs(to_lat_deg)) > 90.0 or max(abs(lon_deg), abs(to_lon_deg)) > 180.0:
        raise ValueError("no place on the Earth")
    lat, to_lat = (math.radians(math.copysign(min(abs(each), 89.999999999), each)) for each in (lat_deg, to_lat_deg))
    across = math.radians(to_lon_deg) - math.radians(lon_deg)
    cosine = math.sin(lat) * math.sin(to_lat) + math.cos(lat) * math.cos(to_lat) * math.cos(across)
    if cosine > 0.999999999999999:
        return 0.0, 0.0
    if cosine < -0.999999:
        return 180.0 * KM_PER_DEG, 0.0
    north = math.cos(lat) * math.sin(to_lat) - math.sin(lat) * math.cos(to_lat) * math.cos(across)
    bearing = math.degrees(math.atan2(math.sin(across) * math.cos(to_lat), north))
    return KM_PER_DEG * math.degrees(math.acos(cosine)), math.floor(math.fmod(bearing + 360.0, 360.0) + 0.5)
