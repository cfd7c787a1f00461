"""Where the dish may point, in its own degrees: what a plan must never leave."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from birdcage.base.geometry import shortest_turn
from birdcage.tracking.curve import Floats
from birdcage.tracking.mount import Mount

CABLE_MARGIN_DEG = 0.05
SECTOR_MARGIN_DEG = 0.1
"""How far a plan keeps off a no-go sector: more than an axis overshoots (reference section 7.1: 0.06 degrees)."""


@dataclass(frozen=True, slots=True)
class Keepout:
    """A no-go sector in the dish's own degrees, with the margin."""

    middle_deg: float
    half_deg: float
    below_deg: float

    def swept(self, start_deg: float, turn_deg: float) -> bool:
        """Return whether an azimuth sweep from `start_deg` through `turn_deg` touches its azimuths."""
        centre = start_deg + turn_deg / 2.0
        return abs(shortest_turn(self.middle_deg, centre)) <= self.half_deg + abs(turn_deg) / 2.0

    def holds(self, az_deg: float, el_deg: float) -> bool:
        """Return whether a direction lies in it."""
        return el_deg < self.below_deg and self.swept(az_deg, 0.0)

    def beside(self, az_deg: Floats) -> tuple[Floats, Floats]:
        """Return how far the azimuth may turn back and on from each angle until it meets the sector; 0 inside."""
        off = (az_deg - self.middle_deg) % 360.0
        back, on = off - self.half_deg, 360.0 - off - self.half_deg
        inside = (back < 0.0) | (on < 0.0)
        return np.where(inside, 0.0, back), np.where(inside, 0.0, on)


@dataclass(frozen=True, slots=True)
class Bounds:
    """The limits of one mount."""

    low_el_deg: float
    high_el_deg: float
    cable: tuple[float, float] | None
    """None where nothing winds up."""
    turn_known: bool
    """Whether the azimuth tells the turn of the cable; True where nothing winds up."""
    keepouts: tuple[Keepout, ...]

    @classmethod
    def of(cls, mount: Mount) -> Bounds:
        """Take the limits of a mount."""
        elevation, limits = mount.model.elevation, mount.limits
        low = elevation.min_deg if mount.el_min_deg is None else mount.el_min_deg
        high = elevation.max_deg if mount.el_max_deg is None else mount.el_max_deg
        cable = limits.cable
        if cable is not None:
            cable = cable[0] + CABLE_MARGIN_DEG, cable[1] - CABLE_MARGIN_DEG
        return cls(low, high, cable, cable is None or limits.turn_known, _keepouts(mount))

    def blocked(self, az_deg: float, el_deg: float) -> bool:
        """Return whether a direction lies in a no-go sector."""
        return any(keepout.holds(az_deg, el_deg) for keepout in self.keepouts)


def _keepouts(mount: Mount) -> tuple[Keepout, ...]:
    found = []
    for sector in mount.limits.no_go:
        width = (sector.az_to_deg - sector.az_from_deg) % 360.0
        corners = [mount.alignment.to_dish(az, sector.el_below_deg) for az in (sector.az_from_deg, sector.az_to_deg)]
        # A leaning base turns both edges a little differently: the wider of both counts.
        begin = corners[0][0]
        dish_width = width + shortest_turn(begin + width, corners[1][0])
        half = min(max(width, dish_width) / 2.0 + SECTOR_MARGIN_DEG, 180.0)
        found.append(Keepout((begin + dish_width / 2.0) % 360.0, half,
            max(el for _, el in corners) + SECTOR_MARGIN_DEG))  # fmt: skip
    return tuple(found)
