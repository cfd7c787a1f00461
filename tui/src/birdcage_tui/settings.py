"""What the app is told before it begins."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Place:
    """Where the dish stands, in degrees; east and north are positive."""

    latitude_deg: float
    longitude_deg: float
    name: str = ""


@dataclass(frozen=True, slots=True)
class AppSettings:
    """The app's own settings, from flags and `birdcage.toml`."""

    theme: str = "dusk"
    place: Place | None = None
    """None while the user has not told it: then no geostationary arc is drawn."""
    tour: bool = False
    """Whether the dish shows itself off until the first key. Only with a simulated dish."""
    notice: str = ""
    """A sentence about the settings that a person must see (a damaged file, say)."""
