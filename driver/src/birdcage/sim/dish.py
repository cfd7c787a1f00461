"""The mechanical dish: an azimuth and an elevation motor, a cable, and the truth about them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.base.geometry import wrap_360
from birdcage.sim.axis import Axis, AxisData
from birdcage.sim.chance import seeded
from birdcage.sim.g2.knobs import G2Settings

CABLE_LOW_DEG, CABLE_HIGH_DEG = -423.33, 23.33
"""The stops of the cable (reference section 7.4, [S1])."""
EL_STOP_LOW_DEG, EL_STOP_HIGH_DEG = 17.5, 65.5
"""Solid mechanical stops [V zleffke], a little outside NVS 101 and 102 [I]."""
AZ_STEPS, EL_STEPS = 40000, 24960
SAG_RATE_DEG_S = 10.0


@dataclass(frozen=True, slots=True)
class Truth:
    """What the dish really does, whatever its console says."""

    az_deg: float
    """Dish azimuth, 0..360."""
    el_deg: float
    cable_deg: float
    """Turn of the azimuth cable, -423.33..+23.33; 0 is home."""
    moving: bool
    homed: bool
    """Both axes."""
    az_homed: bool
    el_homed: bool
    released: bool
    stalled: tuple[str, ...]
    """Names of blocked axes: `az`, `el`."""
    shell_alive: bool
    powered: bool
    menu: str


class Dish:
    """Two axes. All times are seconds of dish time."""

    def __init__(self, settings: G2Settings, look: Callable[[], Truth]) -> None:
        self._look = look
        self._settings = settings
        rng = seeded("mechanics", settings.seed)
        unknown = settings.unhomed or settings.boot
        cable = rng.uniform(-360.0, 0.0) if unknown else settings.az
        el = rng.uniform(20.0, 60.0) if unknown else settings.el
        shared = {"overshoot": settings.overshoot, "backlash_deg": settings.backlash}
        az_data = AxisData(
            "AZ", AZ_STEPS, 65.0, 400.0, CABLE_LOW_DEG, CABLE_HIGH_DEG, CABLE_HIGH_DEG, 0.01, 65.0, 8.0, **shared
        )
        el_data = AxisData(
            "EL", EL_STEPS, 45.0, 400.0, EL_STOP_LOW_DEG, EL_STOP_HIGH_DEG, EL_STOP_HIGH_DEG, 65.0, 45.0, 2.0, **shared
        )
        self.axes = (Axis(az_data, cable, rng), Axis(el_data, el, rng))
        for axis in self.axes:
            axis.homed = not unknown

    def truth(self) -> Truth:
        """Return what the dish really does at this moment."""
        return self._look()

    def shafts(self, now_s: float) -> tuple[float, float]:
        """Return where azimuth (0..360) and elevation really are."""
        return wrap_360(self.axes[0].shaft(now_s)), self.axes[1].shaft(now_s)

    def look(self, now_s: float, *, shell_alive: bool, powered: bool, menu: str) -> Truth:
        """Put the truth together."""
        az, el = self.axes
        az_deg, el_deg = self.shafts(now_s)
        return Truth(
            az_deg=az_deg,
            el_deg=el_deg,
            cable_deg=az.shaft(now_s),
            moving=az.moving(now_s) or el.moving(now_s),
            homed=az.homed and el.homed,
            az_homed=az.homed,
            el_homed=el.homed,
            released=az.released,
            stalled=tuple(axis.data.name.lower() for axis in self.axes if axis.stalled),
            shell_alive=shell_alive,
            powered=powered,
            menu=menu,
        )

    def set_speeds(self, az_deg_s: float, az_accel_deg_s2: float, el_deg_s: float, home_el_deg: float) -> None:
        """Take the figures of the NVS at power-on; options of the address go first."""
        az, el = (axis.data for axis in self.axes)
        az.max_rate_deg_s = self._settings.az_speed or az_deg_s
        az.accel_deg_s2 = az_accel_deg_s2
        el.max_rate_deg_s = self._settings.el_speed or el_deg_s
        el.home_deg = min(home_el_deg, EL_STOP_HIGH_DEG)

    def cable_target(self, now_s: float, az_deg: float) -> float | None:
        """Return the cable angle that serves an azimuth (setting `az_map`); None when none fits."""
        if self._settings.az_map == "literal":
            turns = [az_deg]
        elif self._settings.az_map == "home":
            turns = [-((-az_deg) % 360.0)]
        else:
            turns = [az_deg % 360.0 + 360.0 * turn for turn in (-2, -1, 0)]
        fitting = [turn for turn in turns if CABLE_LOW_DEG <= turn <= CABLE_HIGH_DEG]
        here = self.axes[0].count(now_s)[0]
        return min(fitting, key=lambda turn: abs(turn - here), default=None)

    def release(self, now_s: float) -> None:
        """Cut the current of both motors: the elevation sinks, and the position may be forgotten."""
        az, el = self.axes
        az.halt(now_s)
        el.fall(now_s, self._settings.release_sag, SAG_RATE_DEG_S)
        for axis in self.axes:
            axis.released = True
            axis.homed = axis.homed and not self._settings.release_forgets

    def engage(self, now_s: float) -> None:
        """Give the motors current again, wherever they are."""
        for axis in self.axes:
            if axis.released:
                axis.released = False
                axis.halt(now_s)

    def power_on(self, now_s: float) -> None:
        """Forget where it is; the shaft stays where it was."""
        for axis in self.axes:
            axis.halt(now_s)
            axis.homed = False
            axis.released = False
