"""Maps of the geostationary arc with a base that is turned and tilted: by the simulator, and by formulae of our own."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from datetime import UTC, datetime

from birdcage.sim.settings import SimSettings
from birdcage.sim.sky import SimSky
from birdcage.sim.stance import Stance
from birdcage.skymap.plan import MapPlan

from tests.skymap.made import made_map

NIGHT = datetime(2026, 3, 20, 6, tzinfo=UTC)
KANSAS = {"latitude_deg": 39.1, "longitude_deg": -95.7}
ROTTERDAM = {"latitude_deg": 51.92, "longitude_deg": 4.48}
BEAM = {"beam_az_deg": 6.4, "beam_el_deg": 6.3}
WHOLE = MapPlan(100.0, 260.0, 18.0, 60.0, 2.0)


def simulated_arc(heading, north, east, plan=WHOLE, settings=SimSettings, beam=BEAM, **other):
    """Return counts as the simulated dish hears them; it leans to the north and to the east."""
    chosen = settings(heading=heading, tilt_north=north, tilt_east=east, **other)
    sky, stance, dice = SimSky(chosen), Stance(chosen), random.Random(1)
    return made_map(
        plan, lambda az, el: sky.level(NIGHT, *stance.beam(az, el)) + dice.gauss(0.0, 0.5), about={**KANSAS, **beam}
    )


@dataclass(frozen=True)
class OwnArc:
    """Satellites over the equator of an ellipsoid, seen by vectors, by a dish that is turned and then leant."""

    sent: dict[float, float]
    """Degrees east, and power over that of the empty sky."""
    turn_deg: float
    north_deg: float
    east_deg: float
    width_deg: float

    def decibels(self, plan, noise_db=0.1, seed=1):
        seen = [(self._to_dish(self._vector(slot)), power) for slot, power in self.sent.items()]
        dice = random.Random(seed)

        def level(az_deg, el_deg):
            look = _unit(az_deg, el_deg)
            heard = sum(power * self._pattern(_angle(look, way)) for way, power in seen)
            return 10.0 * math.log10(1.0 + 0.01 / math.sin(math.radians(el_deg)) + heard) + dice.gauss(0.0, noise_db)

        about = {**ROTTERDAM, "beam_az_deg": self.width_deg, "beam_el_deg": self.width_deg}
        return made_map(plan, level, decibels=True, unit="dB", about=about)

    def _vector(self, slot_deg):
        """Return east, north, up of a satellite, as a unit."""
        lat, lon = math.radians(ROTTERDAM["latitude_deg"]), math.radians(slot_deg - ROTTERDAM["longitude_deg"])
        e2 = 0.00669438
        n = 6378.137 / math.sqrt(1 - e2 * math.sin(lat) ** 2)
        x, y = 42164.2 * math.cos(lon) - n * math.cos(lat), 42164.2 * math.sin(lon)
        z = -n * (1 - e2) * math.sin(lat)
        east, north = y, -math.sin(lat) * x + math.cos(lat) * z
        up = math.cos(lat) * x + math.sin(lat) * z
        length = math.sqrt(east**2 + north**2 + up**2)
        return east / length, north / length, up / length

    def _to_dish(self, way):
        """Lean the sky back, then turn it back."""
        tilt = math.radians(math.hypot(self.north_deg, self.east_deg))
        toward = math.atan2(self.east_deg, self.north_deg)
        east, north, up = way
        along = east * math.sin(toward) + north * math.cos(toward)
        side = east * math.cos(toward) - north * math.sin(toward)
        along, up = along * math.cos(tilt) - up * math.sin(tilt), along * math.sin(tilt) + up * math.cos(tilt)
        az = math.atan2(along * math.sin(toward) + side * math.cos(toward),
                        along * math.cos(toward) - side * math.sin(toward)) - math.radians(self.turn_deg)  # fmt: skip
        level = math.sqrt(1.0 - up**2)
        return math.sin(az) * level, math.cos(az) * level, up

    def _pattern(self, away_deg):
        """A cosine-squared aperture: side lobes at -23 dB and flanks that are no Gaussian's."""
        u = 1.4430 * away_deg / self.width_deg
        if abs(u - 1.0) < 1e-6:
            return 0.25
        return (math.sin(math.pi * u) / (math.pi * u) / (1.0 - u * u)) ** 2 if u > 1e-9 else 1.0


def _unit(az_deg, el_deg):
    az, el = math.radians(az_deg), math.radians(el_deg)
    return math.sin(az) * math.cos(el), math.cos(az) * math.cos(el), math.sin(el)


def _angle(one, other):
    return math.degrees(math.acos(min(1.0, sum(a * b for a, b in zip(one, other, strict=True)))))
