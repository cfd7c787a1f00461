"""A no-go sector: where something stands in the way of the dish."""

from __future__ import annotations

from typing import NamedTuple


class NoGoSector(NamedTuple):
    """From one azimuth clockwise to another, below an elevation: degrees.

    True in settings, state and the limits of reach; the dish's own within the gate.
    """

    az_from_deg: float
    az_to_deg: float
    """Clockwise from `az_from_deg`; the sector may contain north."""
    el_below_deg: float
    reason: str = ""
    """What stands there: `mast`. Said where a motion is refused."""

    @property
    def width_deg(self) -> float:
        """How far it reaches in azimuth; 0 for a single direction."""
        return (self.az_to_deg - self.az_from_deg) % 360.0

    def overlaps(self, start_deg: float, turn_deg: float) -> bool:
        """Return whether an azimuth sweep from `start_deg` through `turn_deg` touches the sector's azimuths."""
        low = start_deg if turn_deg >= 0 else start_deg + turn_deg
        return (low - self.az_from_deg) % 360.0 <= self.width_deg or (self.az_from_deg - low) % 360.0 <= abs(turn_deg)
