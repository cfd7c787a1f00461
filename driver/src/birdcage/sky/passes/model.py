"""One pass."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

DAY_S = 86_160.0
"""One turn of the Earth, rounded down: what is up all that time is up for good."""


@dataclass(frozen=True, slots=True)
class Pass:
    """A satellite above the search's least elevation (0 degrees geometric unless asked otherwise), from rise to set.

    Times are UTC and aware; azimuths are degrees clockwise from true north, without refraction.
    """

    name: str
    norad_id: int
    aos: datetime
    tca: datetime
    """Of the highest elevation, which is the time of closest approach as amateurs use the word."""
    los: datetime
    aos_azimuth_deg: float
    tca_azimuth_deg: float
    los_azimuth_deg: float
    max_elevation_deg: float
    already_up: bool = False
    """It was up when the search began: `aos` is that moment."""
    still_up: bool = False
    """It was up when the search ended: `los` is that moment."""

    @property
    def duration_s(self) -> float:
        """From AOS to LOS."""
        return (self.los - self.aos).total_seconds()

    @property
    def always_up(self) -> bool:
        """Whether it was up during all of a search over a day or more: then it has no AOS, LOS or duration."""
        return self.already_up and self.still_up and self.duration_s >= DAY_S
