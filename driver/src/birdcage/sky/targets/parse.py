"""From what a person types to a target."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from typing import Protocol

from birdcage.base.errors import BirdcageError
from birdcage.sky.ahead import is_ahead
from birdcage.sky.elements import ElementSet
from birdcage.sky.ephemeris.bodies import BODIES
from birdcage.sky.galactic import equatorial
from birdcage.sky.slots import Slot, slots
from birdcage.sky.targets.angles import angle_deg
from birdcage.sky.targets.model import BodyTarget, Fixed, Satellite, SlotTarget, Star, Target

UNDERSTOOD = (
    "Understood are: a satellite by name or number; sun, moon, mercury, venus, mars, jupiter, saturn, uranus, neptune; "
    "28.2E, 101W or a slot such as QO-100; ra=5h34m,dec=+22d; gal 120,-5; az 180 el 45."
)
TOLD = 8
"""How many candidates an error names."""
LOOKED_AT = 200
"""How many hits are looked through for one of exactly that name."""
_SAME_SLOT_DEG = 0.15
"""What is typed and what stands in the table are then the same place."""


class UnknownTarget(BirdcageError):
    """Nothing is called that, or several are. Reasons: unknown, ambiguous, angle."""

    reason = "unknown"


class Hit(Protocol):
    """A satellite that a search found: `birdcage.sky.catalogue.Entry` is one."""

    @property
    def elements(self) -> ElementSet:
        """Its elements."""

    @property
    def time_offset_s(self) -> float | None:
        """How much later than computed it comes; None where nobody has set it."""


class Searchable(Protocol):
    """Where satellites are looked up: `Catalogue` and `SearchIndex` can both do it."""

    def search(self, text: str, limit: int) -> Sequence[Hit]:
        """Return what a text may mean, best first."""


def parse_target(text: str, catalogue: Searchable | None = None) -> Target:
    """Return the target that is meant; without a catalogue no satellite is known. UnknownTarget with a sentence."""
    typed = " ".join(text.split())
    if not typed:
        raise UnknownTarget(f"No target was named. {UNDERSTOOD}")
    for form, make in _FORMS:
        found = form.fullmatch(typed)
        if found is not None:
            try:
                return make(found)
            except ValueError as error:
                raise UnknownTarget(str(error), reason="angle") from None
    if typed.lower() in BODIES:
        return BodyTarget(BODIES[typed.lower()])
    hits = () if catalogue is None else catalogue.search(typed, LOOKED_AT)
    exact = _exactly(typed, hits)
    if exact is not None:
        return exact
    wanted = _plain(typed)
    named = [slot for slot in slots() if wanted in _names(slot)]
    if len(named) == 1:
        return SlotTarget(named[0])
    found_slots = named or [
        slot for slot in slots() if any(_plain(typed) in _plain(n) for n in (slot.name, *slot.aliases))
    ]
    if len(hits) == 1 and not found_slots:
        return _satellite(hits[0])
    if not hits and len(found_slots) == 1:
        return SlotTarget(found_slots[0])
    candidates = [f"{hit.elements.name} ({hit.elements.norad_id})" for hit in hits]
    candidates += [f"{slot.name} ({slot.label})" for slot in found_slots]
    if not candidates:
        raise UnknownTarget(f"No target is called {typed!r}. {UNDERSTOOD}")
    more = f" and {len(candidates) - TOLD} more" if len(candidates) > TOLD else ""
    raise UnknownTarget(
        f"{typed!r} may be several: {', '.join(candidates[:TOLD])}{more}. Give the whole name or the number.",
        reason="ambiguous",
    )


def _exactly(typed: str, hits: Sequence[Hit]) -> Satellite | None:
    """Return the satellite of exactly that number or name; of several with one name the newest elements."""
    if typed.isdigit():
        same = [hit for hit in hits if hit.elements.norad_id == int(typed)]
    else:
        same = [hit for hit in hits if _plain(hit.elements.name) == _plain(typed)]
    now = datetime.now(UTC)
    newest = max(same, key=lambda hit: (not is_ahead(hit.elements.epoch, now), hit.elements.epoch), default=None)
    return None if newest is None else _satellite(newest)


def _satellite(hit: Hit) -> Satellite:
    return Satellite(hit.elements, hit.time_offset_s or 0.0)


def _plain(name: str) -> str:
    """Return a name without case, blanks and punctuation: QO-100, qo 100 and QO100 are one."""
    return re.sub(r"[\W_]+", "", name.casefold())


def _names(slot: Slot) -> list[str]:
    return [_plain(name) for name in (slot.name, *slot.aliases)]


def _slot(found: re.Match[str]) -> SlotTarget:
    longitude_deg = float(found["lon"])
    if longitude_deg > 180.0:
        raise ValueError(f"{found[0]} is no longitude: 0 to 180, E or W.")
    longitude_deg = -longitude_deg if found["half"].upper() == "W" else longitude_deg
    known = min(slots(), key=lambda slot: abs(_turn(slot.longitude_deg - longitude_deg)))
    near = abs(_turn(known.longitude_deg - longitude_deg)) < _SAME_SLOT_DEG
    return SlotTarget(Slot(longitude_deg, known.name, known.networks, known.band, known.polarization) if near
                      else Slot(longitude_deg, ""))  # fmt: skip


def _turn(degrees: float) -> float:
    return (degrees + 180.0) % 360.0 - 180.0


def _equatorial(found: re.Match[str]) -> Star:
    ra_deg = _within("right ascension", angle_deg(found["ra"], hours=True), 0.0, 360.0)
    dec_deg = _within("declination", angle_deg(found["dec"]), -90.0, 90.0)
    return Star(f"RA {ra_deg:.4f}° Dec {dec_deg:+.4f}°", ra_deg, dec_deg)


def _galactic(found: re.Match[str]) -> Star:
    l_deg = _within("galactic longitude", angle_deg(found["l"]), -360.0, 360.0) % 360.0
    b_deg = _within("galactic latitude", angle_deg(found["b"]), -90.0, 90.0)
    return Star(f"l {l_deg:.2f}° b {b_deg:+.2f}°", *equatorial(l_deg, b_deg))


def _fixed(found: re.Match[str]) -> Fixed:
    az_deg = _within("azimuth", angle_deg(found["az"]), -360.0, 360.0) % 360.0
    el_deg = _within("elevation", angle_deg(found["el"]), -90.0, 90.0)
    return Fixed(f"az {az_deg:.2f}° el {el_deg:.2f}°", az_deg, el_deg)


def _within(what: str, value: float, low: float, high: float) -> float:
    if not low <= value <= high:
        raise ValueError(f"A {what} is {low:g} to {high:g} degrees, not {value:g}.")
    return value


def _pair(first: str, second: str) -> str:
    """Return the pattern of `first VALUE second VALUE`, with equals signs, colons and commas as one likes."""
    return rf"{first}\s*[=:]?\s*(?P<{first}>[^=,a-z][^=,]*?)\s*,?\s*{second}\s*[=:]?\s*(?P<{second}>[^=,a-z][^=,]*)"


_FORMS: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], Target]], ...] = (
    (re.compile(r"(?P<lon>\d+(?:\.\d+)?)\s*°?\s*(?P<half>[ew])", re.IGNORECASE), _slot),
    (re.compile(_pair("ra", "dec"), re.IGNORECASE), _equatorial),
    (re.compile(r"gal(?:actic)?\s+" + _pair("l", "b"), re.IGNORECASE), _galactic),
    (re.compile(_pair("l", "b"), re.IGNORECASE), _galactic),
    (re.compile(r"gal(?:actic)?\s*[=:]?\s*(?P<l>[^,\s]+)(?:\s*,\s*|\s+)(?P<b>[^,\s]+)", re.IGNORECASE), _galactic),
    (re.compile(_pair("az", "el"), re.IGNORECASE), _fixed),
)
