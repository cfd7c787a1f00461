"""The two motors of either rotator. Figures without a source are assumed (`docs/reference/easycomm.md`)."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.chance import seeded
from birdcage.sim.dish import DishMechanics, DishTruth
from birdcage.sim.easycomm.knobs import EasycommSettings
from birdcage.sim.easycomm.pid import Gains, PidLoop
from birdcage.sim.easycomm.servo import ServoAxis

TICKS_PER_DEG = 244.6, 126.1
"""Of azimuth and elevation (written)."""
ENDS = {"AZ": (-365.0, 365.0), "EL": (-5.0, 185.0)}
"""Where the mechanics end, a little beyond what the firmware takes (assumed)."""
STEPS = 86400
"""Microsteps of a turn of the stock rotator: 1600 by a gear of 54 (read)."""
HOMING_TIMEOUT_S = 80.0


class ServoDish(DishMechanics):
    """Two geared motors, each with a loop of its own; both share their gains."""

    def __init__(self, settings: EasycommSettings, look: Callable[[], DishTruth]) -> None:
        self.gains = Gains()
        rng = seeded("mechanics", settings.seed)
        self.az, self.el = (
            ServoAxis(
                AxisData(name, round(360 * per_deg), full, 1.0, *ENDS[name], ENDS[name][0], 0.0, full, 1.0), place, rng,
                PidLoop(self.gains, settings.duty_max), ticks_per_deg=per_deg, full_deg_s=full, lag_s=settings.lag,
                stiction=settings.stiction, switch=settings.endstops,
            )
            for name, place, per_deg, full in zip(
                ("AZ", "EL"), _places(settings, rng.uniform(-90.0, 90.0)), TICKS_PER_DEG,
                (settings.az_full, settings.el_full), strict=True,
            )
        )  # fmt: skip
        for axis in (self.az, self.el):
            axis.homed = not (settings.unhomed or settings.boot)
        super().__init__((self.az, self.el), look)


class StepperDish(DishMechanics):
    """Two steppers that change their rate evenly, with a switch at 0 of each axis."""

    def __init__(self, settings: EasycommSettings, look: Callable[[], DishTruth]) -> None:
        rng = seeded("mechanics", settings.seed)
        axes = []
        for name, place in zip(("AZ", "EL"), _places(settings, rng.uniform(5.0, 90.0)), strict=True):
            data = AxisData(
                name, STEPS, settings.speed, settings.accel, *ENDS[name], 0.0, 0.0, settings.speed, HOMING_TIMEOUT_S,
                overshoot=settings.overshoot, backlash_deg=settings.backlash,
            )  # fmt: skip
            axes.append(AxisMechanics(data, place, rng))
            axes[-1].homed = not (settings.unhomed or settings.boot)
        super().__init__(tuple(axes), look)


def _places(settings: EasycommSettings, somewhere_deg: float) -> tuple[float, float]:
    """Return where the axes stand: somewhere when it gets power, else where the knobs say."""
    if not settings.boot:
        return settings.az, settings.el
    return somewhere_deg, abs(somewhere_deg) / 2.0
