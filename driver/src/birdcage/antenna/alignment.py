"""Between the base and the world: what the dish counts, and what is true."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from birdcage.antenna.pointing_model import PointingModel
from birdcage.base.geometry import wrap_360
from birdcage.base.no_go import NoGoSector

_ALL_ROUND_DEG = 360.0 - 1e-9
"""The width of a sector that leaves no azimuth out: one of 360 would read as one of 0."""


@dataclass(frozen=True, slots=True)
class Alignment:
    """How the dish stands, in degrees: true = dish + offsets, then collimation and tilt (see `pointing_model`).

    Zero until an alignment was made; shown whenever it is not.
    """

    az_offset_deg: float = 0.0
    """Added to the dish's azimuth: TPOINT's -IA."""
    el_offset_deg: float = 0.0
    """Added to the dish's elevation: TPOINT's IE."""
    ca_deg: float = 0.0
    """How far the beam looks to the left of the elevation circle."""
    an_deg: float = 0.0
    """How far the azimuth axis leans to the north."""
    aw_deg: float = 0.0
    """How far it leans to the west."""
    model: PointingModel | None = field(init=False, repr=False, compare=False)
    """Collimation and tilt; None if there is neither, and true and dish differ by the offsets alone."""

    def __post_init__(self) -> None:
        leans = self.ca_deg or self.an_deg or self.aw_deg
        model = PointingModel(self.ca_deg, self.an_deg, self.aw_deg) if leans else None
        object.__setattr__(self, "model", model)

    def to_true(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return the true direction of dish angles."""
        model = self.model
        if model is not None:
            return model.to_true(az_deg + self.az_offset_deg, el_deg + self.el_offset_deg)
        if self.az_offset_deg:
            az_deg = wrap_360(az_deg + self.az_offset_deg)
        return az_deg, el_deg + self.el_offset_deg

    def to_dish(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return the dish angles of a true direction; without an alignment nothing is folded into the circle."""
        model = self.model
        if model is not None:
            az_deg, el_deg = model.to_mount(az_deg, el_deg)
            return wrap_360(az_deg - self.az_offset_deg), el_deg - self.el_offset_deg
        if self.az_offset_deg:
            az_deg = wrap_360(az_deg - self.az_offset_deg)
        return az_deg, el_deg - self.el_offset_deg

    def sector_to_dish(self, from_az_deg: float, to_az_deg: float, below_el_deg: float, reason: str = "") -> NoGoSector:
        """Return a no-go sector, given in true angles, in the dish's frame.

        With collimation or tilt its edges are no straight lines there: it is taken as large as it can be.
        """
        start, end = from_az_deg - self.az_offset_deg, to_az_deg - self.az_offset_deg
        below = below_el_deg - self.el_offset_deg
        model = self.model
        if model is not None:
            shift = model.largest_shift_deg
            start, end, width = self._widened(start, end, (to_az_deg - from_az_deg) % 360.0, below_el_deg, shift)
            below += shift
            if width >= _ALL_ROUND_DEG:
                return NoGoSector(0.0, _ALL_ROUND_DEG, below, reason)
        return NoGoSector(wrap_360(start), wrap_360(end), below, reason)

    @staticmethod
    def _widened(
        start_deg: float, end_deg: float, width_deg: float, below_el_deg: float, shift_deg: float
    ) -> tuple[float, float, float]:
        """Return start, end and width of a sector with the azimuth added that `shift` makes at its highest."""
        reach = math.cos(math.radians(min(90.0, abs(below_el_deg))))
        sine = math.sin(math.radians(min(90.0, shift_deg)))
        margin = 360.0 if sine >= reach else math.degrees(math.asin(sine / reach))
        return start_deg - margin, end_deg + margin, width_deg + 2.0 * margin

    def words(self) -> str:
        """Return what is not zero, for people: `az +1.20°, el -0.30°, tilt 0.52° to 45°, beam 0.10° left`; else ``."""
        offsets = f"az {self.az_offset_deg:+.2f}°, el {self.el_offset_deg:+.2f}°"
        parts = (offsets if self.az_offset_deg or self.el_offset_deg else "", self.lean_words())
        return ", ".join(part for part in parts if part)

    def lean_words(self) -> str:
        """Return tilt and collimation alone, for people; empty if there is neither."""
        parts = []
        if self.an_deg or self.aw_deg:
            towards = wrap_360(math.degrees(math.atan2(-self.aw_deg, self.an_deg)))
            parts.append(f"tilt {math.hypot(self.an_deg, self.aw_deg):.2f}° to {towards:.0f}°")
        if self.ca_deg:
            parts.append(f"beam {abs(self.ca_deg):.2f}° {'left' if self.ca_deg > 0 else 'right'}")
        return ", ".join(parts)
