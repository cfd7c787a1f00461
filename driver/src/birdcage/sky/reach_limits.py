"""What keeps a dish from pointing somewhere, as plain data: for `birdcage.sky.reach`, which knows no hardware."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from birdcage.base.no_go import NoGoSector

DEFAULT_TOLERANCE_DEG = 1.0
"""How far a dish may lag behind a satellite near the zenith, where no beam width is known."""


class Horizon(Protocol):
    """A horizon mask. Hashable, as what is derived from it is kept."""

    def at(self, az_deg: float) -> float:
        """Return the lowest clear elevation in a direction, in true degrees."""

    def __hash__(self) -> int: ...


@dataclass(frozen=True, slots=True)
class ReachLimits:
    """The limits of one dish at one place. The defaults limit nothing but to what is above the horizon."""

    el_floor_deg: float = 0.0
    """True: the dish's own floor plus the offset of the alignment."""
    el_ceiling_deg: float = 90.0
    """True."""
    horizon: Horizon | None = None
    no_go: tuple[NoGoSector, ...] = ()
    cable_min_deg: float | None = None
    """How far the cable lets the azimuth turn, in the dish's own frame; None if nothing winds up."""
    cable_max_deg: float | None = None
    az_offset_deg: float = 0.0
    """True azimuth = the dish's + this."""
    turn_known: bool = False
    """Whether it is, or will be, known how far the cable has turned. If not, only what is safe for every turn counts.
    """
    az_rate_deg_s: float | None = None
    """The greatest speed of the azimuth; None for no limit."""
    el_rate_deg_s: float | None = None
    tolerance_deg: float = DEFAULT_TOLERANCE_DEG
    """How far off the dish may be while it cannot turn fast enough: half a beam, the narrower way."""
    follows: bool = True
    """Whether the dish follows anything at all: a motor along an arc does not."""

    @property
    def cable(self) -> tuple[float, float] | None:
        """The range of the cable; None if there is no such limit."""
        if self.cable_min_deg is None or self.cable_max_deg is None:
            return None
        return self.cable_min_deg, self.cable_max_deg
