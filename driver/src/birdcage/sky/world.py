"""What a map of the world shows: immutable, made by `birdcage.sky.look_down` for faces."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

from birdcage.sky.observer import Observer
from birdcage.sky.terminator import SubSolar

Places = tuple[tuple[float, float], ...]
"""Latitude and longitude in degrees, from point to point."""


@dataclass(frozen=True, slots=True)
class SubPoint:
    """A satellite as the map has it: the point under it (geodetic), and how high it is above that."""

    name: str
    norad_id: int
    latitude_deg: float
    longitude_deg: float
    """-180 to 180."""
    altitude_km: float
    favourite: bool = False


@dataclass(frozen=True, slots=True)
class WorldView:
    """The world at one moment."""

    utc: datetime
    sun: SubSolar
    observer: Observer | None = None
    satellites: tuple[SubPoint, ...] = ()
    """Without the chosen one."""
    chosen: SubPoint | None = None
    """None if nothing is chosen, or its elements give no position at that time."""
    behind: Places = ()
    """The ground track of the chosen satellite: the orbit up to now, ending under it."""
    ahead: Places = ()
    """The orbit from now on, beginning under it."""
    footprint: Places = ()
    """From where the chosen satellite is seen in the horizon; a closed ring."""
