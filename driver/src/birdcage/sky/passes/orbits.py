"""Step 1: the shape of each orbit, who can never be up, and who may share a time grid."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from birdcage.sky.frames import SIDEREAL_RATE_RAD_S, Floats
from birdcage.sky.passes.ground import ObserverTrack

MU_KM3_S2 = 398600.8
"""WGS72, as in SGP4."""

NODES_PER_PERIGEE_TURN = 5.0
"""With four, passes of 11 and 25 s were missed among 12 791; with five, none: 600 satellites over five places, held
against an exact search every 10 s."""

_CLASSES_PER_OCTAVE = 3.0
_SMALLEST_EARTH_KM = 6356.0
_PLUMB_RAD = 0.0034
"""The most by which geodetic and geocentric latitude differ."""
_SLACK_RAD = 0.01


@dataclass(frozen=True, slots=True)
class Orbits:
    """What the search needs to know of each orbit, from its state at the start of the search.

    The state and not the elements: those of a distant satellite may be years old, and its inclination has drifted.
    """

    perigee_rad_s: Floats
    """Angular rate at perigee."""
    apogee_km: Floats
    """Greatest distance from the Earth's centre, with 1 % and 30 km to spare."""
    inclination_rad: Floats

    @classmethod
    def of(cls, r: Floats, v: Floats) -> Orbits:
        """Return the osculating orbits of TEME states (n, 3); NaN gives NaN."""
        distance = np.sqrt(np.einsum("nk,nk->n", r, r))
        momentum = np.cross(r, v)
        h = np.sqrt(np.einsum("nk,nk->n", momentum, momentum))
        semi_latus = h * h / MU_KM3_S2
        binding = np.maximum(2.0 / distance - np.einsum("nk,nk->n", v, v) / MU_KM3_S2, 1e-7)
        eccentricity = np.sqrt(np.clip(1.0 - semi_latus * binding, 0.0, 0.9999))
        perigee = semi_latus / (1.0 + eccentricity)
        return cls(
            perigee_rad_s=h / (perigee * perigee),
            apogee_km=(1.0 + eccentricity) / binding * 1.01 + 30.0,
            inclination_rad=np.arccos(np.clip(momentum[:, 2] / h, -1.0, 1.0)),
        )

    def may_rise(self, ground: ObserverTrack) -> NDArray[np.bool_]:
        """Return who comes near enough to the observer's latitude to be seen above the mask; False for NaN."""
        mask = math.asin(ground.sin_mask)
        cap = np.arccos(np.clip(math.cos(mask) * _SMALLEST_EARTH_KM / self.apogee_km, -1.0, 1.0)) - mask
        reach = np.minimum(self.inclination_rad, math.pi - self.inclination_rad) + cap + _SLACK_RAD
        return np.asarray(abs(ground.site.latitude_rad) - _PLUMB_RAD <= reach)

    def step_s(self, chosen: NDArray[np.intp]) -> Floats:
        """Return the step between nodes, rounded down to thirds of an octave so that similar orbits share it."""
        rate = np.maximum(self.perigee_rad_s[chosen], 2.0 * SIDEREAL_RATE_RAD_S)
        thirds = np.floor(np.log2(2.0 * math.pi / (NODES_PER_PERIGEE_TURN * rate)) * _CLASSES_PER_OCTAVE)
        step: Floats = 2.0 ** (thirds / _CLASSES_PER_OCTAVE)
        return step
