"""A target as one dish sees it: in the dish's own degrees, with what of it may be followed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import datetime

import numpy as np
from numpy.typing import NDArray

from birdcage.base.geometry import shortest_turn
from birdcage.base.no_go import NoGoSector
from birdcage.sky.reach import reach
from birdcage.sky.reach_limits import ReachLimits
from birdcage.sky.reach_model import LossReason, PassReach
from birdcage.tracking.curve import Curve, Floats
from birdcage.tracking.mount import Mount
from birdcage.tracking.planning.bounds import SECTOR_MARGIN_DEG, PlanBounds

_DENSE = 4000
"""Points for which the alignment is asked one by one; of a longer path every so many, and a line between them."""
_HAIR_DEG = 0.01


@dataclass(frozen=True, slots=True)
class _Track:
    """A path as `birdcage.sky.reach` takes one."""

    t_s: Floats
    az_deg: Floats
    el_deg: Floats


@dataclass(frozen=True, slots=True, eq=False)
class TargetTrack:
    """All that a plan needs of a target and a mount."""

    sky: Curve
    mount: Mount
    bounds: PlanBounds
    dish: Curve
    """The target in the dish's own degrees, at turn 0, wherever that is; at the times of `sky`."""
    low_deg: Floats
    high_deg: Floats
    """Between what the elevation of the dish may be."""

    @classmethod
    def of(cls, sky: Curve, mount: Mount) -> TargetTrack:
        """Look at a path in the sky with a mount."""
        bounds, limits = PlanBounds.of(mount), mount.limits
        az, el = _to_dish(sky, mount)
        shift = el - sky.el_deg
        low = np.clip(limits.el_floor_deg + shift, bounds.low_el_deg, bounds.high_el_deg)
        high = np.clip(limits.el_ceiling_deg + shift, low, bounds.high_el_deg)
        return cls(sky, mount, bounds, Curve(sky.t_s, az, el), low, high)

    @property
    def az_deg(self) -> Floats:
        """Dish azimuth of turn 0, unrolled."""
        return self.dish.az_deg

    @property
    def el_deg(self) -> Floats:
        """Dish elevation of the target, wherever that is."""
        return self.dish.el_deg

    @property
    def pointed_el_deg(self) -> Floats:
        """Where the elevation stands that follows: at the floor or the ceiling, where the target is beyond."""
        pointed: Floats = np.clip(self.el_deg, self.low_deg, self.high_deg)
        return pointed

    def elevations(self, t_s: Floats) -> tuple[Floats, Floats]:
        """Return the least and the greatest elevation at some times."""
        return np.interp(t_s, self.sky.t_s, self.low_deg), np.interp(t_s, self.sky.t_s, self.high_deg)

    def at(self, t_s: float, turn: int) -> tuple[float, float]:
        """Return where the dish points that follows at that turn of the cable."""
        az, el = self.dish.at(t_s)
        low, high = (float(np.interp(t_s, self.sky.t_s, values)) for values in (self.low_deg, self.high_deg))
        return az + 360.0 * turn, min(max(el, low), high)

    def reached(self) -> PassReach:
        """Return the reach as every other page tells it, but for refraction, and for which turn of the cable is taken.

        Where the turn is known the cable is left out: which turn, and when to rewind, is for the plan.
        """
        return reach(_Track(self.sky.t_s, self.sky.az_deg, self.sky.el_deg), _uncabled(self.mount.limits))

    def spans(self) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
        """Return when the target may be followed, the keyhole included, and when a cable of unknown turn is in the way.

        A little less than `reached` beside no-go sectors, and more above the ceiling: the dish stays at it while it
        still points within the tolerance. The horizon mask tells what is heard; the dish follows behind it all the
        same.
        """
        limits = self.mount.limits
        sky, ceiling = self.sky, limits.el_ceiling_deg
        el = np.minimum(sky.el_deg, np.maximum(ceiling, sky.el_deg - limits.tolerance_deg))
        wider = replace(_uncabled(limits), horizon=None, no_go=tuple(_wider(sector) for sector in limits.no_go))
        found = reach(_Track(sky.t_s, sky.az_deg, el), wider)
        kept = [(one.start, one.end) for one in found.intervals]
        kept += [(lost.start, lost.end) for lost in found.lost if lost.reason is LossReason.KEYHOLE]
        cable = [
            (lost.start.timestamp(), lost.end.timestamp()) for lost in found.lost if lost.reason is LossReason.CABLE
        ]
        return self._clear(_joined(sorted(kept))), cable

    def hidden(self, t_s: Floats) -> NDArray[np.bool_]:
        """Return whether the horizon mask hides the target, at some times."""
        mask = self.mount.limits.horizon
        if mask is None:
            return np.zeros(len(t_s), dtype=np.bool_)
        az, el = (np.interp(t_s, self.sky.t_s, values) for values in (self.sky.az_deg, self.sky.el_deg))
        return el < np.array([mask.at(az_deg % 360.0) for az_deg in az.tolist()])

    def _clear(self, spans: list[tuple[float, float]]) -> list[tuple[float, float]]:
        """Return spans without what the dish itself cannot point at: sectors and its stops count in its own degrees.

        Where its base leans these are not quite what `reach` takes them for.
        """
        t, pointed = self.sky.t_s, self.pointed_el_deg
        blocked = self.bounds.blocked(self.az_deg, pointed)
        blocked |= np.abs(self.el_deg - pointed) > self.mount.limits.tolerance_deg + _HAIR_DEG
        for index in np.flatnonzero(np.diff(blocked.astype(np.int8))).tolist():
            blocked[index : index + 2] = True
        if not blocked.any():
            return spans
        edges = np.flatnonzero(np.diff(np.concatenate(([False], blocked, [False])).astype(np.int8)))
        for first, after in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
            cut = [
                part
                for start, end in spans
                for part in ((start, min(end, float(t[first]))), (max(start, float(t[after - 1])), end))
            ]
            spans = [(start, end) for start, end in cut if end > start]
        return spans


def _to_dish(sky: Curve, mount: Mount) -> tuple[Floats, Floats]:
    """Return dish azimuth and elevation; the azimuth begins at the true one less the offset, as reach counts turns."""
    every = max(1, len(sky.t_s) // _DENSE)
    some = np.unique(np.append(np.arange(0, len(sky.t_s), every), len(sky.t_s) - 1))
    true_az, true_el = sky.az_deg[some], sky.el_deg[some]
    pairs = np.array(
        [mount.alignment.to_dish(az, el) for az, el in zip((true_az % 360.0).tolist(), true_el.tolist(), strict=True)]
    )
    counted = float(true_az[0]) - mount.limits.az_offset_deg
    az = np.unwrap(pairs[:, 0], period=360.0)
    az += counted + shortest_turn(counted, float(az[0])) - az[0]
    if every == 1:
        return az, pairs[:, 1]
    return (
        sky.az_deg + np.interp(sky.t_s, sky.t_s[some], az - true_az),
        sky.el_deg + np.interp(sky.t_s, sky.t_s[some], pairs[:, 1] - true_el),
    )


def _uncabled(limits: ReachLimits) -> ReachLimits:
    return replace(limits, cable_min_deg=None, cable_max_deg=None) if limits.turn_known else limits


def _wider(sector: NoGoSector) -> NoGoSector:
    by = SECTOR_MARGIN_DEG
    higher = sector._replace(el_below_deg=sector.el_below_deg + by)
    if sector.width_deg + 2.0 * by >= 360.0:
        return higher
    return higher._replace(az_from_deg=sector.az_from_deg - by, az_to_deg=sector.az_to_deg + by)


def _joined(spans: list[tuple[datetime, datetime]]) -> list[tuple[float, float]]:
    """Return spans of POSIX seconds, those in one that touch."""
    found: list[tuple[float, float]] = []
    for start, end in ((a.timestamp(), b.timestamp()) for a, b in spans):
        if found and start - found[-1][1] < 2e-3:
            found[-1] = found[-1][0], end
        else:
            found.append((start, end))
    return found
