"""What is known to stand in the sky of a map: the geostationary arc, and the Sun on its way."""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from birdcage.signal.slots_heard import SlotSeen, seen_at
from birdcage.sky.observer import Observer
from birdcage.sky.slots import slots
from birdcage.sky.sun import sun
from birdcage.skymap.map_levels import LessonRefused

if TYPE_CHECKING:
    from birdcage.skymap.sky_map import SkyMap
    from birdcage.tracking.planning.refraction import Refraction

SUN_EVERY = timedelta(minutes=20)
"""The Sun moves five degrees meanwhile."""
DEAF_BANDS = ("L",)
"""What a dish for Ku band does not hear."""


def observer_of(sky_map: SkyMap, otherwise: Observer | None = None) -> Observer:
    """Return where a map was made, by what it tells, else `otherwise`. LessonRefused where that is not known."""
    place = sky_map.place()
    if place is not None:
        height_m = sky_map.about.get("height_m")
        return Observer(*place, float(height_m) if isinstance(height_m, int | float) else 0.0)
    if otherwise is None:
        raise LessonRefused("The map does not tell where it was made. Set that place: `birdcage place`.")
    return otherwise


def arc_over(observer: Observer, refraction: Refraction) -> tuple[SlotSeen, ...]:
    """Return the slots above the horizon that may be heard in Ku band, occupied or not: operators move satellites."""
    seen = (seen_at(slot, observer, refraction) for slot in slots() if slot.band not in DEAF_BANDS)
    return tuple(each for each in seen if each is not None)


def sources_over(sky_map: SkyMap, observer: Observer, refraction: Refraction) -> tuple[tuple[float, float], ...]:
    """Return true directions of the slots, and of the Sun while the map was made; those below the horizon left out."""
    found = [(seen.az_deg, seen.el_deg) for seen in arc_over(observer, refraction)]
    times = [sample.utc for sample in sky_map.samples if sample.utc is not None]
    if times:
        found += _sun_between(min(times), max(times), observer)
    return tuple(found)


def _sun_between(begin: datetime, end: datetime, observer: Observer) -> list[tuple[float, float]]:
    found, when = [], begin
    while when <= end + SUN_EVERY:
        az_deg, el_deg = sun(min(when, end), observer.latitude_deg, observer.longitude_deg)
        if el_deg > 0.0:
            found.append((az_deg, el_deg))
        when += SUN_EVERY
    return found
