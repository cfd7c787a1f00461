"""A made-up pass by its greatest elevation and its duration: a circular orbit that makes it, laid over any place.

On a sphere of radius R, a satellite at height h that goes by at the central angle a from the place stands at its
greatest elevation e there, with a = acos(R cos e / (R + h)) - e, and is up for 2 p / n, with cos p = cos H / cos a,
cos H = R / (R + h), and n its mean motion. The Earth turns beneath it and is flat: the search for passes tells by how
much the pass misses what was wanted, and that is added to what the sphere is asked for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime, timedelta

from birdcage.base.errors import BirdcageError, OutOfRange
from birdcage.base.reason import Reason
from birdcage.sky.demo_orbits import FIRST_ID, turning_orbit
from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.passes.model import Pass

NORAD_ID = FIRST_ID - 1
_EARTH_KM, _MU_KM3_S2 = 6378.135, 398600.8
LOWEST_KM, HIGHEST_KM = 200.0, 2000.0
"""Of the orbits: lower ones do not last, and higher ones are hardly flown."""
EL_DEG = (5.0, 90.0)
ZENITH_DEG = 80.0
"""Above this a pass may go by on the other side of the zenith than it was laid."""
TROPIC_DEG = 5.0
"""Nearer to the equator than this each pass is laid on the side of the pole."""
_TURNS = 12
_CLOSE = 0.01, 0.05, 0.05
"""Degrees of elevation, and seconds of duration and rise, that the pass may miss what was wanted."""


@dataclass(frozen=True, slots=True)
class PassWish:
    """What a pass is to be like."""

    max_el_deg: float = 60.0
    duration_s: float = 600.0
    rises_in_s: float = 60.0
    """From the epoch of the elements to its rise."""


def durations_s(max_el_deg: float) -> tuple[float, float]:
    """Return the shortest and the longest time that a pass of this greatest elevation may last."""
    return _lasts_s(LOWEST_KM, max_el_deg), _lasts_s(HIGHEST_KM, max_el_deg)


def made_up_pass(wish: PassWish, now: datetime, observer: Observer) -> ElementSet:
    """Return elements that make it over this place, with `now` (aware) as their epoch.

    OutOfRange for a pass that no orbit makes. The time and the greatest elevation are without refraction.
    """
    asked = checked(wish)
    for _ in range(_TURNS):
        elements = _laid(asked, wish, now, observer)
        found = _found(elements, wish, now, observer)
        rises_s = (found.aos - now).total_seconds()
        el_deg = _signed_el_deg(found, observer)
        missed = wish.max_el_deg - el_deg, wish.duration_s - found.duration_s, wish.rises_in_s - rises_s
        if all(abs(by) <= close for by, close in zip(missed, _CLOSE, strict=True)):
            return elements
        up, longer, later = missed
        # Beyond 90 it goes by on the other side, which the Earth's flattening may ask for.
        el_deg = min(max(asked.max_el_deg + up, 0.0), 100.0)
        asked = PassWish(el_deg, asked.duration_s + longer, asked.rises_in_s + later)
    raise BirdcageError("No orbit was found that makes this pass here.", reason=Reason.NO_POSITION)


def checked(wish: PassWish) -> PassWish:
    """Return a wish that can be met. OutOfRange says what can be asked for."""
    if not EL_DEG[0] <= wish.max_el_deg <= EL_DEG[1]:
        raise OutOfRange(f"The greatest elevation is {wish.max_el_deg:g}°. Give {EL_DEG[0]:g} to {EL_DEG[1]:g}.")
    shortest, longest = durations_s(wish.max_el_deg)
    if not shortest <= wish.duration_s <= longest:
        raise OutOfRange(
            f"A pass up to {wish.max_el_deg:g}° does not last {wish.duration_s / 60.0:.1f} min. Give "
            f"{math.ceil(shortest / 6.0) / 10.0:.1f} to {math.floor(longest / 6.0) / 10.0:.1f} min."
        )
    return wish


def _signed_el_deg(found: Pass, observer: Observer) -> float:
    """Return its greatest elevation, above 90 degrees for one on the other side of the zenith than it was laid."""
    polewards = math.cos(math.radians(found.tca_azimuth_deg)) * math.copysign(1.0, observer.latitude_deg) > 0.0
    laid_polewards = abs(observer.latitude_deg) < TROPIC_DEG
    near_zenith = found.max_elevation_deg > ZENITH_DEG
    return 180.0 - found.max_elevation_deg if polewards != laid_polewards and near_zenith else found.max_elevation_deg


def _lasts_s(height_km: float, max_el_deg: float) -> float:
    """Return how long a pass of a circular orbit lasts, on a sphere at rest."""
    ratio = _EARTH_KM / (_EARTH_KM + height_km)
    half = math.acos(min(1.0, ratio / math.cos(math.radians(_aside_deg(height_km, max_el_deg)))))
    return 2.0 * half / math.sqrt(_MU_KM3_S2 / (_EARTH_KM + height_km) ** 3)


def _aside_deg(height_km: float, max_el_deg: float) -> float:
    elevation = math.radians(max_el_deg)
    return math.degrees(math.acos(_EARTH_KM / (_EARTH_KM + height_km) * math.cos(elevation)) - elevation)


def _height_km(max_el_deg: float, duration_s: float) -> float:
    """Return the height of the orbit whose pass lasts so long: the higher, the longer."""
    low, high = LOWEST_KM / 2.0, HIGHEST_KM * 2.0
    while high - low > 1e-6:
        middle = (low + high) / 2.0
        low, high = (middle, high) if _lasts_s(middle, max_el_deg) < duration_s else (low, middle)
    return (low + high) / 2.0


def _laid(asked: PassWish, wish: PassWish, now: datetime, observer: Observer) -> ElementSet:
    """Return an orbit that turns beside the place: on the side of the equator, or beyond it where that is too near."""
    height_km = _height_km(asked.max_el_deg, asked.duration_s)
    aside_deg = _aside_deg(height_km, asked.max_el_deg)
    latitude_deg = abs(observer.latitude_deg) - aside_deg
    if latitude_deg < 0.0 or abs(observer.latitude_deg) < TROPIC_DEG:
        latitude_deg = abs(observer.latitude_deg) + aside_deg
    place = math.copysign(latitude_deg, observer.latitude_deg), observer.longitude_deg
    name = f"DEMO pass to {wish.max_el_deg:g} deg in {wish.duration_s / 60.0:g} min"
    return turning_orbit(name, NORAD_ID, now, asked.rises_in_s + asked.duration_s / 2.0, height_km, place)


def _found(elements: ElementSet, wish: PassWish, now: datetime, observer: Observer) -> Pass:
    """Return the pass that the elements make nearest to when it is wanted."""
    from birdcage.sky.passes.search import search
    from birdcage.sky.propagate import Fleet

    begin, middle = now - timedelta(hours=0.5), now + timedelta(seconds=wish.rises_in_s + wish.duration_s / 2.0)
    hours = (middle - begin).total_seconds() / 3600.0 + 0.75
    passes = list(search(Fleet([elements]), observer, begin, hours))
    if not passes:
        raise BirdcageError("No orbit was found that makes this pass here.", reason=Reason.NO_POSITION)
    return min(passes, key=lambda each: abs((each.tca - middle).total_seconds()))
