"""The two motors of a Carryout of 2003 and its cable. Figures without a source are assumed.

It has no limit switches: `docs/reference/carryout-2003.md`, *Limits*.
"""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.carryout.knobs import CarryoutSettings
from birdcage.sim.chance import seeded
from birdcage.sim.dish import DishMechanics, DishTruth

STEPS = 36000
"""Records have a resolution of 0.01 degrees (`docs/reference/carryout-2003.md`, *Moving*)."""
BEYOND_DEG = 2.0
"""How far the stops of the cable lie beyond its turn."""
EL_STOPS_DEG = 20.0, 92.0
"""Its owner: it "can't physically drop below about 22"; and: the motors "can technically go farther" (both written)."""
AZ_HOME_DEG, EL_HOME_DEG = 0.0, 45.0
HOMING_TIMEOUT_S = 10.0
HOMING_SHARE = 0.35
"""How much of the time for homing one axis takes for the way from one end to the other and back."""


class CarryoutDish(DishMechanics):
    """Azimuth and elevation. Whether both move at once is the firmware's affair."""

    def __init__(self, settings: CarryoutSettings, look: Callable[[], DishTruth]) -> None:
        self._settings = settings
        self._turn_deg = float(settings.wrap)
        rng = seeded("mechanics", settings.seed)
        unknown = settings.unhomed or settings.boot
        places = (rng.uniform(0.0, 360.0), rng.uniform(25.0, 70.0)) if unknown else (settings.az, settings.el)
        ends = (-BEYOND_DEG, self._turn_deg + BEYOND_DEG), EL_STOPS_DEG
        share_s = max(settings.boot_home_s, 1.0) * HOMING_SHARE
        axes = []
        for name, (low, high), home, place in zip(("AZ", "EL"), ends, (AZ_HOME_DEG, EL_HOME_DEG), places, strict=True):
            data = AxisData(
                name, STEPS, settings.speed, settings.accel, low, high, low, home, 2.0 * (high - low) / share_s,
                HOMING_TIMEOUT_S, overshoot=settings.overshoot, backlash_deg=settings.backlash,
            )  # fmt: skip
            axes.append(AxisMechanics(data, place, rng))
            axes[-1].homed = not unknown
        super().__init__(tuple(axes), look)

    def cable_target(self, now_s: float, az_deg: float) -> float:
        """Return the cable angle that serves an azimuth: the nearest that fits."""
        if self._turn_deg <= 360.0:
            return az_deg
        here = self.axes[0].count(now_s)[0]
        turns = [turn for turn in (az_deg % 360.0, az_deg % 360.0 + 360.0) if turn <= self._turn_deg]
        return min(turns, key=lambda turn: abs(turn - here))
