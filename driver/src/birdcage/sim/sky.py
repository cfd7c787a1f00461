"""What a dish hears: slots of the geostationary arc, the Sun, and a floor that rises toward the horizon."""

from __future__ import annotations

import math
from datetime import datetime

from birdcage.base.geometry import separation, shortest_turn
from birdcage.sim.almanac import geostationary, sun
from birdcage.sim.beam import gain
from birdcage.sim.settings import Settings

SLOTS: dict[float, float] = {
    -61.5: 118.0,
    -72.7: 126.0,
    -77.0: 112.0,
    -91.0: 48.0,
    -99.2: 62.0,
    -101.0: 150.0,
    -103.0: 66.0,
    -110.0: 138.0,
    -119.0: 143.0,
    -129.0: 124.0,
}
"""Degrees east to counts above the floor at the centre of the beam. Real peaks are 112 to 160 (section 7.6); the
strength of each slot [I]."""
SUN_COUNTS = 25.0
"""About 70 K in a 6.4 degree beam over a 100 K receiver. [I]"""
AIR_COUNTS = 1.44
"""Counts for each thickness of the atmosphere: 400 at elevation 58, 402 to 403 at 18 to 22 (section 7.6)."""
FLOOR_EL_DEG = 58.0
REACH_DEG = 12.0
"""Beyond this the beam hears nothing of a source."""


class Sky:
    """The sky over one place."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        place = settings.lat, settings.lon
        self.slots = [(geostationary(slot, *place), counts) for slot, counts in SLOTS.items()]

    def level(self, when: datetime, az_deg: float, el_deg: float) -> float:
        """Return the noise-free level in counts with the beam at a true direction."""
        sources = [*self.slots, (sun(when, self._settings.lat, self._settings.lon), SUN_COUNTS)]
        heard = sum(
            counts * _gain(az_deg, el_deg, az, el)
            for (az, el), counts in sources
            if el > 0.0 and separation(az_deg, el_deg, az, el) < REACH_DEG
        )
        return self.floor(el_deg) + heard

    def strongest(self, az_deg: float, el_deg: float) -> float | None:
        """Return the slot, in degrees east, that is heard best with the beam at a true direction; None for none."""
        heard = {
            slot: counts * _gain(az_deg, el_deg, az, el)
            for slot, ((az, el), counts) in zip(SLOTS, self.slots, strict=True)
            if el > 0.0 and separation(az_deg, el_deg, az, el) < REACH_DEG
        }
        return max(heard, key=heard.__getitem__, default=None)

    def floor(self, el_deg: float) -> float:
        """Return the level of the empty sky."""
        return self._settings.rssi_floor + AIR_COUNTS * (_air(el_deg) - _air(FLOOR_EL_DEG))


def _air(el_deg: float) -> float:
    return 1.0 / math.sin(math.radians(max(el_deg, 5.0)))


def _gain(az_deg: float, el_deg: float, source_az_deg: float, source_el_deg: float) -> float:
    right = shortest_turn(source_az_deg, az_deg) * math.cos(math.radians(source_el_deg))
    return gain(right, el_deg - source_el_deg)
