"""How near to the Sun a satellite passes: the Sun is the strongest source of noise in the sky."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime

import numpy as np

from birdcage.sky.observer import Observer
from birdcage.sky.reach_checks import SampledTrack
from birdcage.sky.sun_vectors import sun_vectors, unit_vectors


@dataclass(frozen=True, slots=True)
class SunApproach:
    """The moment of a pass in which the satellite is nearest to the Sun."""

    at: datetime
    separation_deg: float


def sun_approach(track: SampledTrack, observer: Observer) -> SunApproach | None:
    """Return the nearest approach along a track, while the Sun is up; None if it is not up during any of it.

    Between two samples the satellite is taken to go straight.
    """
    if len(track.t_s) < 2:
        raise ValueError("a track of fewer than two samples")
    suns = sun_vectors(observer, track.t_s)
    directions = unit_vectors(track.az_deg, track.el_deg)
    path = directions - suns
    step = np.diff(path, axis=0)
    length = np.einsum("ij,ij->i", step, step)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(length > 0.0, -np.einsum("ij,ij->i", path[:-1], step) / length, 0.0)
    share = np.clip(share, 0.0, 1.0)
    # The chord between two samples runs below the sphere, by 0.05 degrees half way between two that are 5 apart.
    nearest = directions[:-1] + share[:, None] * np.diff(directions, axis=0)
    nearest /= np.linalg.norm(nearest, axis=1, keepdims=True)
    chord = np.linalg.norm(nearest - suns[:-1] - share[:, None] * np.diff(suns, axis=0), axis=1)
    chord[suns[:-1, 2] < 0.0] = np.inf
    if not np.isfinite(chord).any():
        return None
    best = int(np.nanargmin(chord))
    at_s = float(track.t_s[best] + share[best] * (track.t_s[best + 1] - track.t_s[best]))
    separation_deg = float(np.degrees(2.0 * np.arcsin(min(chord[best] / 2.0, 1.0))))
    return SunApproach(datetime.fromtimestamp(at_s, UTC), separation_deg)
