"""The mean elements of one satellite, as a TLE or an OMM gives them (CCSDS 502.0-B, SGP4 theory)."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime


@dataclass(frozen=True, slots=True)
class ElementSet:
    """One set of elements: plain data, without the propagator that turns it into positions."""

    name: str
    norad_id: int
    """The catalogue number, up to nine digits; 0 where the source gives none."""
    epoch: datetime
    """UTC, aware."""
    inclination_deg: float
    raan_deg: float
    """Right ascension of the ascending node."""
    eccentricity: float
    argument_of_perigee_deg: float
    mean_anomaly_deg: float
    mean_motion_rev_day: float
    """Kozai mean motion, as published."""
    bstar: float = 0.0
    """Drag term, in reciprocal Earth radii."""
    mean_motion_dot: float = 0.0
    """Half the first derivative of the mean motion, in rev/day^2, as published."""
    mean_motion_ddot: float = 0.0
    """A sixth of the second derivative, in rev/day^3."""
    international_designator: str = ""
    """`1998-067A`."""
    revolution: int = 0
    """Revolution number at epoch."""
    source: str = ""
    """Where it came from: a file, a group, `frozen` for what ships with birdcage, `demo` for a made-up orbit."""

    @property
    def period_s(self) -> float:
        """The time of one revolution."""
        return 86400.0 / self.mean_motion_rev_day
