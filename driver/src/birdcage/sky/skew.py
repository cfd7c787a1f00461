"""How far a feed is turned for linear polarisation: what the geometry asks for, and what the slot adds of its own.

Angles are in degrees, clockwise positive, looking from behind the dish towards the satellite.
"""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.sky.geostationary import look_at_slot
from birdcage.sky.observer import Observer
from birdcage.sky.slots import Slot


@dataclass(frozen=True, slots=True)
class Skew:
    """The skew of one slot at one place."""

    geometry_deg: float
    """Between the observer's vertical and the Earth's axis."""
    tilt_deg: float | None
    """By how much the slot's satellites are turned themselves; None if no source says it."""

    @property
    def feed_deg(self) -> float | None:
        """How far the feed is to be turned in all, -90 to 90; None if the tilt is not known."""
        return None if self.tilt_deg is None else (self.geometry_deg + self.tilt_deg + 90.0) % 180.0 - 90.0

    def values(self) -> dict[str, float | None]:
        """Return it for JSON."""
        return {
            "skew_deg": _rounded(self.geometry_deg),
            "slot_tilt_deg": _rounded(self.tilt_deg),
            "feed_skew_deg": _rounded(self.feed_deg),
        }

    def words(self) -> tuple[str, str]:
        """Return the geometry and the tilt in words."""
        geometry = f"{_turned(self.geometry_deg)} by geometry (from behind the dish, linear)"
        if self.tilt_deg is None or self.feed_deg is None:
            return geometry, "the slot's own is not known"
        return geometry, f"{_turned(self.tilt_deg)} of the slot's own: {_turned(self.feed_deg)} in all"

    def brief(self) -> str:
        """Return it in forty columns; clockwise is positive."""
        geometry = f"Skew {self.geometry_deg:+.1f}° geometry"
        if self.tilt_deg is None or self.feed_deg is None:
            return f"{geometry}, slot's own unknown"
        return f"{geometry} {self.tilt_deg:+.1f}° slot = {self.feed_deg:+.1f}°"


def skew_of(slot: Slot, observer: Observer) -> Skew | None:
    """Return the skew of a slot; None if it is circular. Where that is not known, it is of a linear one."""
    if slot.polarization == "circular":
        return None
    return Skew(look_at_slot(observer, slot.longitude_deg).skew_deg, slot.tilt_deg)


def _turned(deg: float) -> str:
    return f"{abs(deg):.1f}° {'counterclockwise' if deg < 0.0 else 'clockwise'}"


def _rounded(deg: float | None) -> float | None:
    return None if deg is None else round(deg, 2) + 0.0
