"""The three motors of a Trav'ler and its cable. Figures without a source are assumed."""

from __future__ import annotations

import math
from collections.abc import Callable

from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.chance import seeded
from birdcage.sim.dish import DishMechanics, DishTruth
from birdcage.sim.hal.knobs import HalSettings

STEPS = 36000
"""The position is read to 0.01 degrees (`docs/reference/travler.md`, *Position*)."""
AZ_STOPS_DEG, EL_LOW_STOP_DEG, SK_STOPS_DEG = (-2.0, 457.0), -3.0, (-2.0, 182.0)
"""Elevation passes 0 and 90, and the cable holds 455 degrees (`docs/reference/travler.md`, *Elevation* and *Cable*)."""
HOMES_DEG = 0.0, 30.0, 90.0
SKEW_DEG = 0.0, 180.0
HOMING_TIMEOUT_S = 10.0
HOMING_SHARE = 0.7
"""How much of the time for homing the way from one end to the other and back may take."""
LINE_DEG = 1.0, 2.0


def move_time(turn_deg: float) -> float:
    """Return the seconds that a turn of so many degrees takes: `docs/reference/travler.md`, *Times*.

    t = 0.3 s below 0.5 degrees, 0.5 s up to 1 degree, else 3.23 ln(0.84 d) - 0.48 seconds, from rest to rest. Between
    1 and 2 degrees the source takes the absolute value of a sum that changes its sign there; here a straight line joins
    the two ends. The same for azimuth and elevation; for skew (assumed).
    """
    if turn_deg <= 0.0:
        return 0.0
    if turn_deg < 0.5:
        return 0.3
    start, end = LINE_DEG
    if turn_deg <= start:
        return 0.5
    if turn_deg < end:
        return 0.5 + (turn_deg - start) / (end - start) * (_law(end) - 0.5)
    return _law(turn_deg)


def rate_for(turn_deg: float, accel_deg_s2: float) -> float:
    """Return the highest rate of the trapezoid that takes `move_time`; inf when speeding up takes longer than that."""
    time_s = move_time(turn_deg)
    room = (accel_deg_s2 * time_s) ** 2 - 4.0 * accel_deg_s2 * turn_deg
    if time_s == 0.0 or room <= 0.0:
        return math.inf
    return (accel_deg_s2 * time_s - math.sqrt(room)) / 2.0


def _law(turn_deg: float) -> float:
    return 3.23 * math.log(0.84 * turn_deg) - 0.48


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
        axes, el_stops = [], (EL_LOW_STOP_DEG, settings.el_stop)
        for name, stops, home, place in zip(
            ("AZ", "EL", "SK"), (AZ_STOPS_DEG, el_stops, SK_STOPS_DEG), HOMES_DEG, places, strict=True
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
