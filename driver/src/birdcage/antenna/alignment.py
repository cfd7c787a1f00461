"""Between the base and the world: what the dish counts, and what is true (SEAMS *Frames*)."""

from __future__ import annotations

from dataclasses import dataclass

from birdcage.base.geometry import wrap_360
from birdcage.protocol.gate import Sector


@dataclass(frozen=True, slots=True)
class Alignment:
    """True = dish + offset, in degrees. Zero until an alignment was made; shown whenever it is not."""

    az_offset_deg: float = 0.0
    el_offset_deg: float = 0.0

    def to_true(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return the true direction of dish angles."""
        if self.az_offset_deg:
            az_deg = wrap_360(az_deg + self.az_offset_deg)
        return az_deg, el_deg + self.el_offset_deg

    def to_dish(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return the dish angles of a true direction; without an offset nothing is folded into the circle."""
        if self.az_offset_deg:
            az_deg = wrap_360(az_deg - self.az_offset_deg)
        return az_deg, el_deg - self.el_offset_deg

    def sector_to_dish(self, from_az_deg: float, to_az_deg: float, below_el_deg: float, reason: str = "") -> Sector:
        """Return a no-go sector, given in true angles, in the dish's frame."""
        return Sector(
            wrap_360(from_az_deg - self.az_offset_deg),
            wrap_360(to_az_deg - self.az_offset_deg),
            below_el_deg - self.el_offset_deg,
            reason,
        )
