"""The two motors of a simulated rotator."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.chance import seeded
from birdcage.sim.dish import DishMechanics, DishTruth
from birdcage.sim.rotctl.knobs import RotctlSettings

STEPS = 36000
"""Of a turn: angles are printed in hundredths."""


class RotatorMechanics(DishMechanics):
    """Azimuth, counted beyond the circle where its range goes so far, and elevation."""

    def __init__(self, settings: RotctlSettings, look: Callable[[], DishTruth]) -> None:
        self.level = 100
        """The speed level, 1 to 100."""
        rng = seeded("mechanics", settings.seed)
        ends = (settings.min_az, settings.max_az), (settings.min_el, settings.max_el)
        axes = []
        for name, (low, high), place in zip(("AZ", "EL"), ends, (settings.az, settings.el), strict=True):
            data = AxisData(
                name, STEPS, settings.speed, settings.accel, low, high, low, low, settings.speed, 60.0,
                overshoot=settings.overshoot, backlash_deg=settings.backlash,
            )  # fmt: skip
            axes.append(AxisMechanics(data, min(max(place, low), high), rng))
            axes[-1].homed = True
        super().__init__(tuple(axes), look)

    def go(self, now_s: float, index: int, deg: float, level: int | None = None) -> None:
        """Send one axis somewhere, at a speed level."""
        axis = self.axes[index]
        axis.retarget(now_s, deg, rate_deg_s=axis.data.max_rate_deg_s * (level or self.level) / 100.0)

    def brake(self, now_s: float) -> None:
        """Stop both axes."""
        for axis in self.axes:
            if axis.moving(now_s):
                axis.brake(now_s)

    def power_on(self, now_s: float) -> None:
        """It keeps where it is: absolute encoders."""
        for axis in self.axes:
            axis.halt(now_s)
