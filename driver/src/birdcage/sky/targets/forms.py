"""Targets typed as numbers: a place on the arc, a point among the stars, a direction."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from birdcage.sky.galactic import equatorial
from birdcage.sky.slots import Slot, slots
from birdcage.sky.targets.angles import angle_deg
from birdcage.sky.targets.direction import read_direction, refuse_two_ways
from birdcage.sky.targets.model import Fixed, SlotTarget, Star, Target

_SAME_SLOT_DEG = 0.15
"""What is typed and what stands in the table are then the same place."""
_WHOLE_SLOT_DEG = 0.75
"""After a network's name: `dish 61` is 61.5 W, `dish 72` 72.7 W."""
_NUMBERS = re.compile(r"[-+−]?[\d.]+°?[\s,;/][-+−\d.,;/\s°º]*|(?:az|el|azimuth|elevation)\b.*", re.IGNORECASE)


def read_form(typed: str) -> Target | None:
    """Return the target that numbers name; None if it is no such form. ValueError says what is wrong with one."""
    refuse_two_ways(typed)
    for form, make in _FORMS:
        found = form.fullmatch(typed)
        if found is not None:
            return make(found)
    return _network(typed) or _direction(typed)


def slot_at(longitude_deg: float) -> SlotTarget:
    """Return the place on the arc at a longitude, east positive, with what is known of it."""
    known = min(slots(), key=lambda slot: abs(_turn(slot.longitude_deg - longitude_deg)))
    if abs(_turn(known.longitude_deg - longitude_deg)) >= _SAME_SLOT_DEG:
        return SlotTarget(Slot(longitude_deg, ""))
    return SlotTarget(replace(known, longitude_deg=longitude_deg))


def _slot(found: re.Match[str]) -> SlotTarget:
    longitude_deg = float(found["lon"].replace(",", "."))
    if longitude_deg > 180.0:
        raise ValueError(f"{found[0]} is not a longitude. Type 0 to 180 with E or W.")
    return slot_at(-longitude_deg if found["half"][0].upper() == "W" else longitude_deg)


def _network(typed: str) -> SlotTarget | None:
    """Return the slot of `dish 119` or `bell 91w`."""
    found = _NETWORK.fullmatch(typed)
    asked = "" if found is None else found["network"].casefold()
    of = [slot for slot in slots() if asked in map(str.casefold, slot.networks)]
    if found is None or not of:
        return None
    longitude_deg, half = float(found["lon"].replace(",", ".")), (found["half"] or "").upper()
    near = [
        slot
        for slot in of
        if abs(abs(slot.longitude_deg) - longitude_deg) < _WHOLE_SLOT_DEG
        and (not half or half == ("W" if slot.longitude_deg < 0 else "E"))
    ]
    if len(near) != 1:
        network = next(name for name in of[0].networks if name.casefold() == asked)
        known = ", ".join(slot.label.replace("°", "") for slot in of)
        raise ValueError(f"No slot of {network} is known at {found['lon']}. Known: {known}.")
    return SlotTarget(near[0])


def _direction(typed: str) -> Fixed | None:
    """Return a direction of two absolute angles. ValueError for one that is typed wrong, or counts from somewhere."""
    try:
        wish = read_direction(typed)
    except ValueError:
        if _NUMBERS.fullmatch(typed):
            raise
        return None
    if wish.az is None or wish.el is None or wish.az.relative or wish.el.relative:
        raise ValueError(f"{typed} counts from where the dish points. Type both: 180 45 or az 180 el -3.")
    return _fixed_at(wish.az.deg, wish.el.deg)


def _equatorial(found: re.Match[str]) -> Star:
    ra_deg = _within("right ascension", angle_deg(found["ra"], hours=True), 0.0, 360.0)
    dec_deg = _within("declination", angle_deg(found["dec"]), -90.0, 90.0)
    return Star(f"RA {ra_deg:.4f}° Dec {dec_deg:+.4f}°", ra_deg, dec_deg)


def _galactic(found: re.Match[str]) -> Star:
    l_deg = _within("galactic longitude", angle_deg(found["l"]), -360.0, 360.0) % 360.0
    b_deg = _within("galactic latitude", angle_deg(found["b"]), -90.0, 90.0)
    return Star(f"l {l_deg:.2f}° b {b_deg:+.2f}°", *equatorial(l_deg, b_deg))


def _fixed(found: re.Match[str]) -> Fixed:
    return _fixed_at(angle_deg(found["az"]), angle_deg(found["el"]))


def _fixed_at(az_deg: float, el_deg: float) -> Fixed:
    az_deg = _within("azimuth", az_deg, -360.0, 360.0) % 360.0
    el_deg = _within("elevation", el_deg, -90.0, 90.0)
    return Fixed(f"az {az_deg:.2f}° el {el_deg:.2f}°", az_deg, el_deg)


def _turn(degrees: float) -> float:
    return (degrees + 180.0) % 360.0 - 180.0


def _within(what: str, value: float, low: float, high: float) -> float:
    if not low <= value <= high:
        raise ValueError(f"A {what} is {low:g} to {high:g} degrees, not {value:g}.")
    return value


def _pair(first: str, second: str) -> str:
    """Return the pattern of `first VALUE second VALUE`, with equals signs, colons and commas as one likes."""
    return rf"{first}\s*[=:]?\s*(?P<{first}>[^=,a-z][^=,]*?)\s*,?\s*{second}\s*[=:]?\s*(?P<{second}>[^=,a-z][^=,]*)"


_LONGITUDE = r"(?P<lon>\d+(?:[.,]\d+)?)\s*°?"
_NETWORK = re.compile(rf"(?P<network>[a-z]+)\s*(?:network\s*)?{_LONGITUDE}\s*(?P<half>[ew])?", re.IGNORECASE)
_FORMS: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], Target]], ...] = (
    (re.compile(rf"{_LONGITUDE}\s*(?P<half>[ew]|east|west)", re.IGNORECASE), _slot),
    (re.compile(rf"(?P<half>[ew]|east|west)\s*{_LONGITUDE}", re.IGNORECASE), _slot),
    (re.compile(_pair("ra", "dec"), re.IGNORECASE), _equatorial),
    (re.compile(r"gal(?:actic)?\s+" + _pair("l", "b"), re.IGNORECASE), _galactic),
    (re.compile(_pair("l", "b"), re.IGNORECASE), _galactic),
    (re.compile(r"gal(?:actic)?\s*[=:]?\s*(?P<l>[^,\s]+)(?:\s*,\s*|\s+)(?P<b>[^,\s]+)", re.IGNORECASE), _galactic),
    (re.compile(_pair("az", "el"), re.IGNORECASE), _fixed),
)
