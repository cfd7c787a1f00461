"""How gain and pointing drift while a map is made: what its reference crosses tell, and the map without that."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from itertools import groupby
from statistics import median

from birdcage.base.geometry import shortest_turn
from birdcage.signal.beam_fit import BeamFit, HeardDirection, beam_points, fit_beam, noise_of
from birdcage.skymap.sky_map import MapSample, SkyMap

LOST_SIGMAS = 4.0
"""A shift so many times its own uncertainty is no noise."""
LEAST_LOST_DEG = 0.25
"""And so large it is worth a word: the gears' play is smaller."""


@dataclass(frozen=True, slots=True)
class ReferenceCross:
    """One reference cross, as it was heard: a source at rest on the sky, so what changes is the dish."""

    number: int
    utc: datetime
    """Its middle."""
    fit: BeamFit | None
    """None where no source stood out."""


@dataclass(frozen=True, slots=True)
class Drift:
    """What has changed from the first cross to another one."""

    utc: datetime
    right_deg: float
    """How far right of where it was the source seems to be, on the sky: so far left the dish looks."""
    up_deg: float
    sigma_deg: float
    gain: float
    """Its rise over the floor in parts of the first one's; on a map in decibels how much its level has risen."""
    floor: float
    """How much the floor has risen, in the map's unit."""

    @property
    def lost_steps(self) -> bool:
        """Whether the dish points elsewhere than it says: its motors have lost steps, or the mount was moved."""
        off = math.hypot(self.right_deg, self.up_deg)
        return off > max(LEAST_LOST_DEG, LOST_SIGMAS * self.sigma_deg)


def crosses_in(points: Sequence[MapSample], *, decibels: bool) -> list[ReferenceCross]:
    """Return the reference crosses that points in the order of time make, each with the beam that fits it."""
    made = []
    for number, cross in groupby(points, key=lambda each: each.cross_number):
        heard = list(cross)
        at = sorted(each.utc for each in heard if each.utc is not None)
        if number is not None and at:
            made.append(ReferenceCross(number, at[len(at) // 2], fit_cross(heard, decibels=decibels)))
    return made


def fit_cross(points: Sequence[MapSample], *, decibels: bool) -> BeamFit | None:
    """Return the beam that fits the points of one cross; None where no source stands out of them."""
    heard = [HeardDirection(each.az_deg, each.el_deg, (each.value,)) for each in points]
    noise = noise_of(heard) or _noise(points)
    fit = fit_beam(beam_points(heard, noise, decibels=decibels), None)
    return fit if fit is None or not decibels else fit.in_decibels(max(each.value for each in points))


def _noise(points: Sequence[MapSample]) -> float:
    scatters = [each.scatter / math.sqrt(each.n) for each in points if each.scatter and each.n]
    return median(scatters) if scatters else 0.0


def drift_of(crosses: Sequence[ReferenceCross], *, decibels: bool) -> list[Drift]:
    """Return what has changed since the first cross that found its source, cross by cross; none where none did."""
    found = [(each.utc, each.fit) for each in crosses if each.fit is not None]
    return [drift_between(found[0][1], fit, utc, decibels=decibels) for utc, fit in found]


def drift_between(first: BeamFit, now: BeamFit, utc: datetime, *, decibels: bool) -> Drift:
    """Return what has changed from one cross to another."""
    right_deg = shortest_turn(first.az_deg, now.az_deg) * math.cos(math.radians(first.el_deg))
    gain = now.floor + now.rise - first.floor - first.rise if decibels else now.rise / first.rise
    sigma_deg = math.hypot(first.sigma_deg, now.sigma_deg)
    return Drift(utc, right_deg, now.el_deg - first.el_deg, sigma_deg, gain, now.floor - first.floor)


def without_drift(sky_map: SkyMap) -> SkyMap:
    """Return the map with the drift of gain and floor taken out: a value over its floor is divided by the gain.

    Between two crosses both change evenly with time. Decibels have the gain subtracted. Directions are those that the
    dish told: `Drift.lost_steps` says where these are in doubt. A map with fewer than two crosses comes back as it is.
    """
    crosses = crosses_in(sky_map.crosses, decibels=sky_map.decibels)
    drift = drift_of(crosses, decibels=sky_map.decibels)
    if len(drift) < 2:
        return sky_map
    times = [each.utc.timestamp() for each in drift]
    floor = next(each.fit.floor for each in crosses if each.fit is not None)

    def flat(sample: MapSample) -> MapSample:
        if sample.utc is None:
            return sample
        gain, risen = _at(sample.utc.timestamp(), times, drift)
        if sky_map.decibels:
            return replace(sample, value=sample.value - gain)
        scatter = None if sample.scatter is None else sample.scatter / gain
        return replace(sample, value=floor + (sample.value - floor - risen) / gain, scatter=scatter)

    return replace(
        sky_map, samples=tuple(flat(each) for each in sky_map.samples),
        about={**sky_map.about, "drift_removed": True},
    )  # fmt: skip


def _at(now_s: float, times: Sequence[float], drift: Sequence[Drift]) -> tuple[float, float]:
    after = bisect_right(times, now_s)
    if after in (0, len(times)):
        edge = drift[min(after, len(times) - 1)]
        return edge.gain, edge.floor
    before, then = drift[after - 1], drift[after]
    part = (now_s - times[after - 1]) / (times[after] - times[after - 1])
    return before.gain + part * (then.gain - before.gain), before.floor + part * (then.floor - before.floor)
