"""Which made-up satellites the demo has: by the pass that each makes, or by where it stands now."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Low:
    """A low orbit by the pass that it makes."""

    kind: str
    height_km: float
    inclination_deg: float
    tca_min: float
    """Minutes from now to the closest approach."""
    aside_deg: float
    """How far beside the place it goes by, as an angle at the Earth's centre, positive to the right of its way."""
    northbound: bool


LOW = (
    Low("polar", 830.0, 98.7, 1.5, 4.0, True),
    Low("station", 420.0, 51.6, 5.5, 2.0, True),
    Low("imager", 500.0, 97.4, 11.0, -5.0, False),
    Low("cubesat", 550.0, 64.5, 17.0, 3.0, False),
    Low("weather", 820.0, 98.6, 24.0, -9.0, False),
    Low("amateur", 680.0, 82.5, 33.0, 1.0, True),
    Low("cubesat", 480.0, 43.0, 42.0, -3.0, True),
    Low("imager", 700.0, 98.2, 51.0, 8.0, True),
    Low("amateur", 1330.0, 101.5, 62.0, -6.0, False),
    Low("polar", 850.0, 98.8, 74.0, 0.3, False),
    Low("cubesat", 600.0, 97.8, 86.0, 10.0, True),
    Low("station", 400.0, 41.5, 97.0, -4.0, True),
    Low("science", 520.0, 74.0, 110.0, 5.0, False),
    Low("weather", 835.0, 98.7, 125.0, -2.0, True),
)


@dataclass(frozen=True, slots=True)
class Medium:
    """A navigation satellite by where it stands now."""

    kind: str
    height_km: float
    inclination_deg: float
    bearing_deg: float
    """From the place to below the satellite."""
    distance_deg: float
    """As an angle at the Earth's centre."""
    northbound: bool


MEDIUM = (
    Medium("GPS", 20180.0, 55.0, 20.0, 40.0, True),
    Medium("GPS", 20180.0, 55.0, 130.0, 25.0, False),
    Medium("GPS", 20180.0, 55.0, 250.0, 45.0, True),
    Medium("Galileo", 23222.0, 56.0, 80.0, 35.0, False),
    Medium("Galileo", 23222.0, 56.0, 310.0, 15.0, True),
    Medium("Glonass", 19130.0, 64.8, 190.0, 40.0, False),
)


@dataclass(frozen=True, slots=True)
class High:
    """A long ellipse, with its apogee over the observer's half of the Earth."""

    kind: str
    mean_motion_rev_day: float
    eccentricity: float
    inclination_deg: float
    since_apogee_min: float
    east_deg: float
    """Where the apogee would stand now, in degrees of longitude from the place."""


HIGH = (
    High("Molniya", 2.0063, 0.72, 63.4, 0.0, 20.0),
    High("Molniya", 2.0063, 0.70, 63.4, 150.0, -40.0),
    High("transfer", 2.27, 0.73, 26.0, 40.0, 10.0),
)

STATIONARY = (-52, -33, -14, 2, 21, 44)
"""Degrees of longitude from the place."""
