"""One measurement: the dish was on an object, and read this."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING, Literal

from birdcage.base.geometry import shortest_turn

if TYPE_CHECKING:
    from birdcage.base.beam import Beam

Found = Literal["hand", "rssi"]
"""How the dish was put on the object: nudged by a person, or by its own signal strength."""

UNKNOWN_SIGMA_DEG = 0.3
"""Of a peak by hand where beam or signal are not known."""
LEAST_SIGMA_DEG = 0.05
"""Backlash and step of these gears: no peak is better, however strong the signal."""
SEEN_DB = 0.05
"""The change of level that a person sees on a meter."""
SLOT_RISE_DB = 1.2
"""What a television satellite adds to the level in the stock feed: 112 to 160 counts on 400
(*Beam*, on the pages of the dishes)."""


@dataclass(frozen=True, slots=True)
class MeasuredPeak:
    """A peak. Angles in degrees."""

    utc: datetime
    target: str
    true_az_deg: float
    """Where the object stood then, refraction included."""
    true_el_deg: float
    dish_az_deg: float
    """What the dish read, in its own frame: without any alignment."""
    dish_el_deg: float
    sigma_deg: float
    """Standard deviation of this measurement on the sky, in each of its two directions."""
    found: Found = "hand"
    rise_db: float | None = None
    """The signal that was to be expected; None if unknown."""
    number: int = 0
    """Its number in the file; 0 while it is in none."""

    @property
    def weight(self) -> float:
        """What it counts in the fit."""
        return 1.0 / self.sigma_deg**2

    def off(self, az_deg: float, el_deg: float) -> tuple[float, float]:
        """Return how far the object lay from that true direction: to the right, and above, on the sky."""
        across = shortest_turn(az_deg, self.true_az_deg) * math.cos(math.radians(self.true_el_deg))
        return across, self.true_el_deg - el_deg


def sigma_by_hand(rise_db: float | None, beam: Beam | None) -> float:
    """Return how well a person finds the middle of a source that adds `rise_db` in a Gaussian beam, in degrees.

    By going to half the signal on both sides, where the level changes most, and halving: a level read to `SEEN_DB`.
    In both axes, so it is as good as in the wider one. Never worse than half a beam, where a person would see that
    there is nothing.
    """
    if rise_db is None or beam is None:
        return UNKNOWN_SIGMA_DEG
    beam_deg = max(beam.az_deg, beam.el_deg)
    signal: float = (10.0 ** (rise_db / 10.0) - 1.0) / 2.0
    db_per_deg = 10.0 / math.log(10.0) * signal / (1.0 + signal) * 4.0 * math.log(2.0) / beam_deg
    if not db_per_deg:
        return beam_deg / 2.0
    found = SEEN_DB / db_per_deg / math.sqrt(2.0)
    return min(max(found, LEAST_SIGMA_DEG), beam_deg / 2.0)
