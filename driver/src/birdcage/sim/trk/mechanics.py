"""The two motors of a G2 and its cable (docs/reference/g2-motors.md); those of its kin are like them (assumed)."""

from __future__ import annotations

from collections.abc import Callable

from birdcage.sim.axis import AxisData, AxisMechanics
from birdcage.sim.chance import seeded
from birdcage.sim.dish import DishMechanics, DishTruth
from birdcage.sim.trk.knobs import TrkSettings

CABLE_LOW_DEG, CABLE_HIGH_DEG = -423.33, 23.33
"""The stops of the cable (noted: docs/reference/g2-motors.md, *Limits*)."""
EL_STOP_LOW_DEG, EL_STOP_HIGH_DEG = 17.5, 65.5
"""Solid mechanical stops (written: zleffke), a little outside NVS 101 and 102 (assumed)."""
AZ_STEPS, EL_STEPS = 40000, 24960


def _check(name: str, deg: float, low: float, high: float) -> None:
    """Raise ValueError for a start beyond the stops: no dish stands there, and its count would be wrong from then."""
    if not low <= deg <= high:
        raise ValueError(f"{name}={deg:g}: it is from {low:g} to {high:g}")


class TrkDish(DishMechanics):
    """An azimuth and an elevation motor that move at once."""

    def __init__(self, settings: TrkSettings, look: Callable[[], DishTruth]) -> None:
        self._settings = settings
        rng = seeded("mechanics", settings.seed)
        unknown = settings.unhomed or settings.boot
        cable = rng.uniform(-360.0, 0.0) if unknown else settings.az
        el = rng.uniform(20.0, 60.0) if unknown else settings.el
        _check("az", cable, CABLE_LOW_DEG, CABLE_HIGH_DEG)
        _check("el", el, EL_STOP_LOW_DEG, EL_STOP_HIGH_DEG)
        shared = {"overshoot": settings.overshoot, "backlash_deg": settings.backlash}
        az_data = AxisData(
            "AZ", AZ_STEPS, 65.0, 400.0, CABLE_LOW_DEG, CABLE_HIGH_DEG, CABLE_HIGH_DEG, 0.01, 65.0, 8.0, **shared
        )
        el_data = AxisData(
            "EL", EL_STEPS, 45.0, 400.0, EL_STOP_LOW_DEG, EL_STOP_HIGH_DEG, EL_STOP_HIGH_DEG, 65.0, 45.0, 2.0, **shared
        )
        super().__init__((AxisMechanics(az_data, cable, rng), AxisMechanics(el_data, el, rng)), look)
        for axis in self.axes:
            axis.homed = not unknown

    def set_speeds(self, az_deg_s: float, az_accel_deg_s2: float, el_deg_s: float, home_el_deg: float) -> None:
        """Take the figures of the NVS at power-on; options of the address go first."""
        az, el = (axis.data for axis in self.axes)
        az.max_rate_deg_s = self._settings.az_speed or az_deg_s
        az.accel_deg_s2 = az_accel_deg_s2
        el.max_rate_deg_s = self._settings.el_speed or el_deg_s
        el.home_deg = min(home_el_deg, EL_STOP_HIGH_DEG)

    def engage(self, now_s: float) -> None:
        """Give the motors current again, wherever they are."""
        for axis in self.axes:
            if axis.released:
                axis.released = False
                axis.halt(now_s)
