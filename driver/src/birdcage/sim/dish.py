"""The mechanical dish: its axes, and the truth about them. What they are made of comes from the firmware's own file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from birdcage.base.geometry import wrap_360
from birdcage.sim.axis import AxisMechanics
from birdcage.sim.stance import Stance


@dataclass(frozen=True, slots=True)
class DishTruth:
    """What the dish really does, whatever its console says."""

    az_deg: float
    """Dish azimuth, 0..360."""
    el_deg: float
    skew_deg: float | None
    """None on a dish that has no skew axis."""
    cable_deg: float
    """Turn of the azimuth cable, on the firmware's own scale: a G2 has -423.33..+23.33, with 0 at home."""
    moving: bool
    homed: bool
    """All axes."""
    az_homed: bool
    el_homed: bool
    released: bool
    stalled: tuple[str, ...]
    """Names of blocked axes: `az`, `el`, `sk`."""
    shell_alive: bool
    powered: bool
    menu: str
    beam_az_deg: float
    """True azimuth of the beam, 0..360: after heading, tilt and collimation."""
    beam_el_deg: float
    """True elevation of the beam."""


class DishMechanics:
    """Azimuth, elevation, and perhaps skew, in this order. All times are seconds of dish time."""

    def __init__(self, axes: tuple[AxisMechanics, ...], look: Callable[[], DishTruth]) -> None:
        self.axes = axes
        self._look = look

    def truth(self) -> DishTruth:
        """Return what the dish really does at this moment."""
        return self._look()

    def shafts(self, now_s: float) -> tuple[float, float]:
        """Return where azimuth (0..360) and elevation really are."""
        return wrap_360(self.axes[0].shaft(now_s)), self.axes[1].shaft(now_s)

    def moving(self, now_s: float) -> bool:
        """Whether any motor turns."""
        return any(axis.moving(now_s) for axis in self.axes)

    def look(self, now_s: float, stance: Stance, *, shell_alive: bool, powered: bool, menu: str) -> DishTruth:
        """Put the truth together."""
        az, el = self.axes[:2]
        az_deg, el_deg = self.shafts(now_s)
        beam_az_deg, beam_el_deg = stance.beam(az_deg, el_deg)
        return DishTruth(
            az_deg=az_deg,
            el_deg=el_deg,
            skew_deg=self.axes[2].shaft(now_s) if len(self.axes) > 2 else None,
            cable_deg=az.shaft(now_s),
            moving=self.moving(now_s),
            homed=all(axis.homed for axis in self.axes),
            az_homed=az.homed,
            el_homed=el.homed,
            released=az.released,
            stalled=tuple(axis.data.name.lower() for axis in self.axes if axis.stalled),
            shell_alive=shell_alive,
            powered=powered,
            menu=menu,
            beam_az_deg=beam_az_deg,
            beam_el_deg=beam_el_deg,
        )

    def power_on(self, now_s: float) -> None:
        """Forget where it is; the shaft stays where it was."""
        for axis in self.axes:
            axis.halt(now_s)
            axis.homed = False
            axis.released = False
