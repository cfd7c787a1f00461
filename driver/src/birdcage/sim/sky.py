"""What a dish hears: slots of the geostationary arc, the Sun, trees, and a floor that rises toward the horizon."""

from __future__ import annotations

import math
from datetime import datetime

from birdcage.base.geometry import separation, shortest_turn
from birdcage.sim.almanac import geostationary, sun
from birdcage.sim.beam import COMPRESSION, MEASURED_IN, gain, power_toward
from birdcage.sim.settings import SimSettings
from birdcage.sim.trees import TreeLine

SLOTS: dict[float, float] = {
    -61.5: 143.0,
    -72.7: 101.0,
    -77.0: 117.0,
    -91.0: 21.0,
    -99.2: 32.0,
    -101.0: 118.0,
    -103.0: 81.0,
    -110.0: 111.0,
    -119.0: 145.0,
    -129.0: 29.0,
}
"""Degrees east to counts above the floor at the centre of the beam, each slot alone.

They are fitted, together with `COMPRESSION`, to the published scan of a real G2 (docs/reference/g2-signal.md, *Beam*):
its five peaks, its ridge between them and the share of its cells above 440 and 500 counts. `scripts/bench/sky_scan.py`
prints both. The figures are assumed.
"""
SUN_COUNTS = 25.0
"""About 70 K in a 6.4 degree beam over a 100 K receiver (assumed)."""
SUN_K = 70.0
RECEIVER_K = 100.0
AIR_COUNTS = 1.44
"""Counts for each thickness of the atmosphere: 400 at elevation 58, 402 to 403 at 18 to 22
(docs/reference/g2-signal.md, *Levels*)."""
FLOOR_EL_DEG = 58.0
REACH_DEG = 12.0
"""Beyond this the beam hears nothing of a source."""

Source = tuple[tuple[float, float], float]
"""Where something stands, true azimuth and elevation, and the counts that it makes alone."""


class SimSky:
    """The sky over one place."""

    def __init__(self, settings: SimSettings) -> None:
        self._settings = settings
        place = settings.lat, settings.lon
        self.slots = [(geostationary(slot, *place), counts) for slot, counts in SLOTS.items()]
        self.trees = TreeLine(settings.trees, settings.reflector_in)

    def level(self, when: datetime, az_deg: float, el_deg: float) -> float:
        """Return the noise-free level in counts with the beam at a true direction."""
        sources = [*self.slots, (sun(when, self._settings.lat, self._settings.lon), SUN_COUNTS)]
        arriving = math.fsum(self._counts_heard(source, az_deg, el_deg) ** COMPRESSION for source in sources)
        arriving += SUN_COUNTS**COMPRESSION * self.trees.kelvins(az_deg, el_deg) / SUN_K
        return self.floor(el_deg) + math.pow(arriving, 1.0 / COMPRESSION)

    def warmth(self, when: datetime, az_deg: float, el_deg: float) -> float:
        """Return by which part of a receiver's own noise Sun and trees raise it, with the beam at a true direction."""
        kelvins = self.trees.kelvins(az_deg, el_deg)
        sun_az_deg, sun_el_deg = sun(when, self._settings.lat, self._settings.lon)
        if sun_el_deg > 0.0 and not self.trees.hides(sun_az_deg, sun_el_deg):
            size = self._settings.reflector_in
            larger = size[0] * size[1] / (MEASURED_IN[0] * MEASURED_IN[1])  # a narrower beam is filled by more of it
            kelvins += SUN_K * larger * power_toward(az_deg, el_deg, sun_az_deg, sun_el_deg, size)
        return kelvins / RECEIVER_K

    def strongest(self, az_deg: float, el_deg: float) -> float | None:
        """Return the slot, in degrees east, that is heard best with the beam at a true direction; None for none."""
        heard = {
            slot: self._counts_heard(source, az_deg, el_deg) for slot, source in zip(SLOTS, self.slots, strict=True)
        }
        best = max(heard, key=heard.__getitem__)
        return best if heard[best] > 0.0 else None

    def _counts_heard(self, source: Source, beam_az_deg: float, beam_el_deg: float) -> float:
        """Return the counts that a source makes alone, with the beam at a true direction."""
        (az_deg, el_deg), counts = source
        if el_deg <= 0.0 or self.trees.hides(az_deg, el_deg):
            return 0.0
        if separation(beam_az_deg, beam_el_deg, az_deg, el_deg) >= REACH_DEG:
            return 0.0
        right_deg = shortest_turn(az_deg, beam_az_deg) * math.cos(math.radians(el_deg))
        return counts * max(gain(right_deg, beam_el_deg - el_deg, self._settings.reflector_in), 0.0)

    def floor(self, el_deg: float) -> float:
        """Return the level of the empty sky."""
        return self._settings.rssi_floor + AIR_COUNTS * (_air(el_deg) - _air(FLOOR_EL_DEG))


def _air(el_deg: float) -> float:
    return 1.0 / math.sin(math.radians(max(el_deg, 5.0)))
