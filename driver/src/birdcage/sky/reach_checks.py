"""The single limits of `birdcage.sky.reach`: how far inside each the satellite is, and when it crosses it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from birdcage.base.no_go import NoGoSector
from birdcage.sky.reach_limits import Horizon, ReachLimits
from birdcage.sky.reach_model import LossCause, LossReason

Floats = NDArray[np.float64]

EDGE_S = 0.01
"""How exactly a crossing is placed on the interpolated path."""
_HAIR_DEG = 1e-3
"""A tenth of a motor's step: a pass that begins at the floor does not begin below it."""
CABLE = LossCause(LossReason.CABLE)
_MASK_STEPS = 1440
"""A horizon mask is looked up every quarter of a degree to find a crossing, and as it is to place it."""


class SampledTrack(Protocol):
    """What `birdcage.sky.propagate.track` returns, as far as it is needed here."""

    @property
    def t_s(self) -> Floats:
        """POSIX seconds."""

    @property
    def az_deg(self) -> Floats:
        """True, 0 to 360."""

    @property
    def el_deg(self) -> Floats:
        """Geometric."""


class SkyPath:
    """A track with its azimuth unrolled, to be asked between its samples. Times are seconds after the first."""

    def __init__(self, track: SampledTrack) -> None:
        self.begin = float(track.t_s[0])
        self.t: Floats = np.asarray(track.t_s, dtype=np.float64) - self.begin
        self.el: Floats = np.asarray(track.el_deg, dtype=np.float64)
        self.az: Floats = np.unwrap(np.asarray(track.az_deg, dtype=np.float64), period=360.0)

    def __len__(self) -> int:
        return len(self.t)

    def between(self, index: int) -> Callable[[float], tuple[float, float]]:
        """Return a cubic through the four samples about the interval that begins at `index`: time to az and el."""
        first = min(max(index - 1, 0), max(len(self.t) - 4, 0))
        knots = slice(first, first + 4)
        t0 = float(self.t[index])
        t, az, el = (self.t[knots] - t0).tolist(), self.az[knots].tolist(), self.el[knots].tolist()

        def at(when: float) -> tuple[float, float]:
            x, azimuth, elevation = when - t0, 0.0, 0.0
            for i, ti in enumerate(t):
                weight = math.prod((x - tj) / (ti - tj) for j, tj in enumerate(t) if j != i)
                azimuth += weight * az[i]
                elevation += weight * el[i]
            return azimuth, elevation

        return at


@dataclass(frozen=True, slots=True)
class LimitCheck:
    """One limit. Both functions take unrolled azimuth and elevation and return how far inside it they are."""

    cause: LossCause
    of_samples: Callable[[Floats, Floats], Floats]
    of_point: Callable[[float, float], float]


def checks_of(limits: ReachLimits) -> list[LimitCheck]:
    """Return the limits that depend on the direction alone, in the order in which they are named as a reason."""
    floor, ceiling = limits.el_floor_deg - _HAIR_DEG, limits.el_ceiling_deg + _HAIR_DEG
    checks = [
        LimitCheck(LossCause(LossReason.FLOOR), lambda _az, el: el - floor, lambda _az, el: el - floor),
        LimitCheck(LossCause(LossReason.CEILING), lambda _az, el: ceiling - el, lambda _az, el: ceiling - el),
    ]
    if not limits.follows:
        checks = [
            LimitCheck(LossCause(LossReason.NO_TRACKING), lambda az, _el: np.full_like(az, -1.0), lambda _az, _el: -1.0)
        ]
    if limits.horizon is not None:
        checks.append(_horizon_check(limits.horizon))
    checks.extend(_sector_check(sector) for sector in limits.no_go)
    return checks


def cable_check(low_deg: float, high_deg: float, turns: Sequence[int], az_offset_deg: float) -> LimitCheck:
    """Return the check that the cable allows every one of some turns."""
    low = low_deg + az_offset_deg - 360.0 * min(turns)
    high = high_deg + az_offset_deg - 360.0 * max(turns)
    return LimitCheck(
        CABLE,
        lambda az, _el: np.minimum(az - low, high - az),
        lambda az, _el: min(az - low, high - az),
    )


def crossing(path: SkyPath, check: LimitCheck, index: int) -> float:
    """Return when the path crosses a limit that it keeps at one end of the interval after `index` only.

    Regula falsi (Illinois) on the interpolated path.
    """
    at = path.between(index)
    low, high = float(path.t[index]), float(path.t[index + 1])
    f_low, f_high = check.of_point(*at(low)), check.of_point(*at(high))
    if (f_low < 0.0) == (f_high < 0.0):
        return low if abs(f_low) < abs(f_high) else high
    for _ in range(40):
        guess = (low * f_high - high * f_low) / (f_high - f_low)
        value = check.of_point(*at(guess))
        if (value < 0.0) == (f_high < 0.0):
            done = abs(high - guess) < EDGE_S
            high, f_high, f_low = guess, value, f_low / 2.0
        else:
            done = abs(guess - low) < EDGE_S
            low, f_low, f_high = guess, value, f_high / 2.0
        if done or high - low < EDGE_S or value == 0.0:
            return guess
    return (low + high) / 2.0


def _horizon_check(mask: Horizon) -> LimitCheck:
    azimuths, lowest = _mask_table(mask)
    return LimitCheck(
        LossCause(LossReason.HORIZON),
        lambda az, el: el - np.interp(az % 360.0, azimuths, lowest),
        lambda az, el: el - mask.at(az % 360.0),
    )


@lru_cache(maxsize=8)
def _mask_table(mask: Horizon) -> tuple[Floats, Floats]:
    azimuths = np.linspace(0.0, 360.0, _MASK_STEPS + 1)
    return azimuths, np.array([mask.at(az % 360.0) for az in azimuths.tolist()])


def _sector_check(sector: NoGoSector) -> LimitCheck:
    half = sector.width_deg / 2.0
    middle, below = sector.az_from_deg + half, sector.el_below_deg

    def of_samples(az: Floats, el: Floats) -> Floats:
        beside = np.abs((az - middle + 180.0) % 360.0 - 180.0) - half
        inside: Floats = np.maximum(beside, el - below)
        return inside

    def of_point(az: float, el: float) -> float:
        return max(abs((az - middle + 180.0) % 360.0 - 180.0) - half, el - below)

    return LimitCheck(LossCause(LossReason.NO_GO, sector.reason), of_samples, of_point)
