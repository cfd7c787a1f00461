"""Where the dish may point, in its own degrees: what a plan must never leave."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.antenna.turning import CLEAR_DEG, borders
from birdcage.base.geometry import shortest_turn
from birdcage.tracking.curve import Floats
from birdcage.tracking.mount import Mount

CABLE_MARGIN_DEG = 0.05
SECTOR_MARGIN_DEG = 0.1
"""How far a plan keeps off a no-go sector: more than an axis overshoots (0.06 degrees; `docs/reference/consoles.md`,
*Overshoot*)."""
BORDER_HALF_DEG = CLEAR_DEG + 0.2
"""How far a plan keeps off where the dish may turn the other way round: beyond what the gate asks for, as above."""
_HAIR_DEG = 1e-6
"""Where a way over a sector ends, the dish stands at its very edge."""


@dataclass(frozen=True, slots=True)
class Keepout:
    """What a plan keeps off, in the dish's own degrees: a no-go sector with the margin, or a border."""

    middle_deg: float
    half_deg: float
    below_deg: float
    is_border: bool = False
    """Whether nothing stands there, but the dish may turn the other way round, through what stands elsewhere."""

    def swept(self, start_deg: float, turn_deg: float) -> bool:
        """Return whether an azimuth sweep from `start_deg` through `turn_deg` touches its azimuths."""
        centre = start_deg + turn_deg / 2.0
        return abs(shortest_turn(self.middle_deg, centre)) <= self.half_deg + abs(turn_deg) / 2.0

    def beside(self, az_deg: Floats) -> tuple[Floats, Floats]:
        """Return how far the azimuth may turn back and on from each angle until it meets the sector; 0 inside."""
        off = (az_deg - self.middle_deg) % 360.0
        back, on = off - self.half_deg, 360.0 - off - self.half_deg
        inside = (back < 0.0) | (on < 0.0)
        return np.where(inside, 0.0, back), np.where(inside, 0.0, on)


@dataclass(frozen=True, slots=True)
class PlanBounds:
    """The limits of one mount."""

    low_el_deg: float
    high_el_deg: float
    cable: tuple[float, float] | None
    """None if nothing winds up."""
    turn_known: bool
    """Whether the azimuth tells the turn of the cable; True where nothing winds up."""
    keepouts: tuple[Keepout, ...]
    """The no-go sectors. While the turn of the cable is not known also where the dish may turn the other way round,
    below the highest of them."""

    @classmethod
    def of(cls, mount: Mount) -> PlanBounds:
        """Take the limits of a mount."""
        elevation, limits = mount.model.elevation, mount.limits
        low = elevation.min_deg if mount.el_min_deg is None else mount.el_min_deg
        high = elevation.max_deg if mount.el_max_deg is None else mount.el_max_deg
        cable = limits.cable
        if cable is not None:
            cable = cable[0] + CABLE_MARGIN_DEG, cable[1] - CABLE_MARGIN_DEG
        turn_known = cable is None or limits.turn_known
        keepouts = _keepouts(mount)
        if keepouts and not turn_known:
            highest = max(keepout.below_deg for keepout in keepouts)
            keepouts += tuple(
                Keepout(border, BORDER_HALF_DEG, highest, is_border=True) for border in borders(mount.model)
            )
        return cls(low, high, cable, turn_known, keepouts)

    def blocked(self, az_deg: Floats, el_deg: Floats, *, borders_only: bool = False) -> NDArray[np.bool_]:
        """Return which directions lie in a no-go sector, its margin included; or only where the dish may turn round."""
        inside = np.zeros(len(az_deg), dtype=np.bool_)
        for keepout in self.keepouts:
            if borders_only and not keepout.is_border:
                continue
            back, on = keepout.beside(az_deg)
            inside |= (el_deg < keepout.below_deg - _HAIR_DEG) & (np.minimum(back, on) <= 0.0)
        return inside


def _keepouts(mount: Mount) -> tuple[Keepout, ...]:
    """Return the sectors as the gate has them: it lets every motion of a plan through."""
    found = []
    for one in mount.limits.no_go:
        sector = mount.alignment.sector_to_dish(one.az_from_deg, one.az_to_deg, one.el_below_deg)
        half = sector.width_deg / 2.0
        found.append(
            Keepout(
                (sector.az_from_deg + half) % 360.0,
                min(half + SECTOR_MARGIN_DEG, 180.0),
                sector.el_below_deg + SECTOR_MARGIN_DEG,
            )
        )
    return tuple(found)
