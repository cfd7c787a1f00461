"""The three motors of a Trav'ler and its cable. Figures without a source are assumed."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.chance import seeded
from birdcage.sim.dish import DishMechanics, DishTruth
from birdcage.sim.hal.knobs import HalSettings
from birdcage.sim.hal.law import rate_for

STEPS = 36000
"""The position is read to 0.01 degrees (`docs/reference/travler.md`, *Position*)."""
AZ_STOPS_DEG, EL_STOPS_DEG, SK_STOPS_DEG = (-2.0, 457.0), (-3.0, 93.0), (-2.0, 182.0)
"""Elevation passes 0 and 90, and the cable holds 455 degrees (`docs/reference/travler.md`, *Elevation* and *Cable*)."""
HOMES_DEG = 0.0, 30.0, 90.0
SKEW_DEG = 0.0, 180.0
HOMING_TIMEOUT_S = 10.0
HOMING_SHARE = 0.7
"""How much of the time for homing the way from one end to the other and back may take."""


class LawAxis(AxisMechanics):
    """An axis whose every move takes the time of the measured law, unless a rate is given."""

    speed_deg_s: float | None = None
    """Its greatest speed, where it goes by speed and acceleration instead (setting `speed`)."""

    def retarget(self, now_s: float, target_deg: float, *, rate_deg_s: float | None = None) -> None:
        """Go to another target."""
        turn_deg = abs(target_deg - self.count(now_s)[0])
        super().retarget(
            now_s, target_deg, rate_deg_s=rate_deg_s or self.speed_deg_s or rate_for(turn_deg, self.data.accel_deg_s2)
        )


class HalDish(DishMechanics):
    """Azimuth, elevation and skew. Which of them move at once is the firmware's affair."""

    def __init__(self, settings: HalSettings, look: Callable[[], DishTruth]) -> None:
        self._settings = settings
        self._wrap_deg = 360.0 if settings.wrap == "360" else 455.0
        rng = seeded("mechanics", settings.seed)
        unknown = settings.unhomed or settings.boot
        places = (settings.az, settings.el, settings.sk)
        if unknown:
            places = rng.uniform(0.0, 360.0), rng.uniform(20.0, 60.0), rng.uniform(*SKEW_DEG)
        share_s = max(settings.boot_home_s / 3.0, 1.0) * HOMING_SHARE
        axes = []
        for name, stops, home, place in zip(
            ("AZ", "EL", "SK"), (AZ_STOPS_DEG, EL_STOPS_DEG, SK_STOPS_DEG), HOMES_DEG, places, strict=True
        ):
            low, high = stops
            homing_rate = 2.0 * (high - low) / share_s
            data = AxisData(
                name, STEPS, 20.0, settings.accel, low, high, low, home, homing_rate, HOMING_TIMEOUT_S,
                overshoot=settings.overshoot, backlash_deg=settings.backlash,
            )  # fmt: skip
            axes.append(LawAxis(data, place, rng))
            axes[-1].homed = not unknown
            axes[-1].speed_deg_s = (settings.speed or None) if name != "SK" else None
        super().__init__(tuple(axes), look)

    def wrap(self, now_s: float) -> float:
        """Return the wrap position: where the cable ends, or 0 once it was reset (setting `wrap`)."""
        if self._settings.wrap == "0" and self.axes[0].count(now_s)[0] > 360.0:
            self._wrap_deg = 0.0
        return self._wrap_deg

    def cable_target(self, now_s: float, az_deg: float) -> float:
        """Return the cable angle that serves an azimuth: the nearest that fits, so the other way round at the end."""
        end = self.wrap(now_s) or 360.0
        here = self.axes[0].count(now_s)[0]
        turns = [turn for turn in (az_deg % 360.0, az_deg % 360.0 + 360.0) if turn <= end]
        return min(turns, key=lambda turn: abs(turn - here))

    def power_on(self, now_s: float) -> None:
        """Forget where it is, and where the cable was found to end."""
        super().power_on(now_s)
        self._wrap_deg = 360.0 if self._settings.wrap == "360" else 455.0
