"""The beam: a G2's as measured on an isolated cluster of satellites at elevation 27.

Source: docs/reference/g2-signal.md, *Beam*.

Another dish has the same shape, narrower as its reflector is larger, in each direction by itself.
"""

from __future__ import annotations

import math
from itertools import pairwise

FLOOR, PEAK = 402.0, 544.0
EL_PROFILE = (407, 411, 439, 478, 514, 537, 544, 538, 518, 485, 446, 416, 407)
"""Counts at -6..+6 degrees of elevation from the peak."""
AZ_PROFILE = (409, 431, 465, 500, 525, 541, 544, 537, 520, 491, 459, 428, 413)
"""Counts at -6..+6 degrees of azimuth; on the sky these are cos(27 deg) apart."""
SIDELOBE = ((7.0, 410.0), (8.0, 416.0), (8.5, 418.0), (9.0, 416.0), (10.0, 408.0), (12.0, FLOOR))
"""First sidelobe 415 to 420 at 8 to 9 degrees; the shape around it (assumed)."""

MEASURED_IN = (12.0, 12.0)
"""Width and height of the reflector that it was measured with, in inches."""
COMPRESSION = 1.4
"""How the detector squeezes what it hears: counts go with the 1/1.4th power of what arrives, and what arrives adds up.

A scan cannot tell 1.2 from 2. 1.4 is what makes of the 5.5 degrees, which theory gives a 12 inch reflector at
12.45 GHz, the 6.4 degrees that a scan in counts shows (assumed).
"""

Profile = tuple[tuple[float, float], ...]


def _profile(counts: tuple[int, ...], step_deg: float) -> Profile:
    main = tuple((index * step_deg, float(count)) for index, count in enumerate(counts))
    return main + tuple(point for point in SIDELOBE if point[0] > main[-1][0])


_UP = _profile(EL_PROFILE[6:], 1.0)
_DOWN = _profile(EL_PROFILE[6::-1], 1.0)
_RIGHT = _profile(AZ_PROFILE[6:], math.cos(math.radians(27.0)))
_LEFT = _profile(AZ_PROFILE[6::-1], math.cos(math.radians(27.0)))


def gain(right_deg: float, up_deg: float, reflector_in: tuple[float, float] = MEASURED_IN) -> float:
    """Return what the beam lets through in counts, 1 at its centre.

    `reflector_in`: width and height of the reflector. `right_deg` and `up_deg` are how far the beam's centre stands
    from the source on the sky. Between the measured cuts the profiles are blended by direction.
    """
    right_deg *= reflector_in[0] / MEASURED_IN[0]
    up_deg *= reflector_in[1] / MEASURED_IN[1]
    away = math.hypot(right_deg, up_deg)
    if away == 0.0:
        return 1.0
    vertical = _counts(_UP if up_deg > 0 else _DOWN, away)
    horizontal = _counts(_RIGHT if right_deg > 0 else _LEFT, away)
    share = (up_deg / away) ** 2
    return (share * vertical + (1.0 - share) * horizontal - FLOOR) / (PEAK - FLOOR)


def power_toward(
    az_deg: float, el_deg: float, source_az_deg: float, source_el_deg: float, reflector_in: tuple[float, float]
) -> float:
    """Return what share of a source's power a beam lets through that looks elsewhere, anywhere in the sky."""
    el, source_el = math.radians(el_deg), math.radians(source_el_deg)
    turn = math.radians(az_deg - source_az_deg)
    right = math.cos(el) * math.sin(turn)
    up = math.sin(el) * math.cos(source_el) - math.cos(el) * math.sin(source_el) * math.cos(turn)
    ahead = math.sin(el) * math.sin(source_el) + math.cos(el) * math.cos(source_el) * math.cos(turn)
    aside = math.hypot(right, up)
    away_deg = math.degrees(math.atan2(aside, ahead))
    # As far away as on the sphere, in the direction in which it is seen from the source.
    scale = away_deg / aside if aside else 0.0
    return math.pow(max(gain(right * scale, up * scale, reflector_in), 0.0), COMPRESSION)


def _counts(profile: Profile, away_deg: float) -> float:
    for (near, more), (far, less) in pairwise(profile):
        if away_deg <= far:
            return more + (less - more) * (away_deg - near) / (far - near)
    return FLOOR
