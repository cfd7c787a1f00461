"""What the sky looks like now: immutable, published by `birdcage.sky.watch` for faces."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from birdcage.sky.elements import ElementSet
from birdcage.sky.observer import Observer
from birdcage.sky.pass_row import PassRow


@dataclass(frozen=True, slots=True)
class UpNow:
    """A satellite above the horizon."""

    name: str
    norad_id: int
    az_deg: float
    el_deg: float
    range_km: float
    range_rate_km_s: float
    """Positive while it moves away."""
    sunlit: bool
    favourite: bool
    elements: ElementSet
    """By which it is drawn."""


@dataclass(frozen=True, slots=True)
class SkyNow:
    """One look at the sky."""

    utc: datetime
    """The time that is looked at: the clock's, or that of the time machine."""
    live: bool
    """Whether it is the clock's."""
    observer: Observer | None
    """None while no place is set: then nothing is up and nothing passes."""
    up: tuple[UpNow, ...] = ()
    """Highest first."""
    passes: tuple[PassRow, ...] = ()
    """Those that are not over, in order of AOS: of favourites two days, of the others the next thousand or so."""
    searching: float | None = None
    """How much of the search is done, 0 to 1; None when it is over."""
    satellites: int = 0
    """How many are known."""
    note: str = ""
    """What has to be said: that the elements are those that ship, or why the catalogue could not be read."""
