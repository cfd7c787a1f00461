"""A day of a target that does not pass: whether it is always up, and what of that is in reach."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from birdcage.sky.reach_model import LossReason, PassReach
from birdcage.tracking.curve import Curve

HOURS = 24.0
"""How far ahead is looked: what is up all that time is up for good, as the Earth turns once."""


@dataclass(frozen=True, slots=True, eq=False)
class Day:
    """The next 24 hours of a slot, a star, a body, or a satellite that keeps its place."""

    sky: Curve
    """Where it stands, true degrees."""
    reach: PassReach
    limits: tuple[str, ...] = ()
    """What keeps it out of reach, each once, in words: `below the 18° floor`."""
    horizon_deg: float = 0.0
    """The elevation in `sky` of what stands on the geometric horizon: so far the air lifts it there."""

    @property
    def always_up(self) -> bool:
        """Whether it is above the horizon all day."""
        return bool(self.sky.el_deg.min() > self.horizon_deg)

    @property
    def never_up(self) -> bool:
        """Whether it is below the horizon all day."""
        return bool(self.sky.el_deg.max() <= self.horizon_deg)

    @property
    def always_in_reach(self) -> bool:
        """Whether the dish can point at it all day, and nothing hides it."""
        return bool(self.reach.intervals) and not self.reach.lost

    @property
    def never_in_reach(self) -> bool:
        """Whether the dish can point at it at no time of the day; behind the horizon mask counts as out of reach."""
        return not self.reach.intervals

    @property
    def az_drift_deg(self) -> float:
        """How far it wanders in azimuth, from its westernmost to its easternmost place."""
        return float(np.ptp(self.sky.az_deg))

    @property
    def el_drift_deg(self) -> float:
        """How far it wanders in elevation."""
        return float(np.ptp(self.sky.el_deg))

    def reach_end_s(self, at_s: float) -> float | None:
        """Return when the stretch in reach at a time ends (POSIX seconds).

        None: it is not in reach then, or stays so to the end of the day.
        """
        for one in self.reach.intervals:
            if one.start.timestamp() - 1.0 <= at_s < one.end.timestamp():
                end_s = one.end.timestamp()
                return None if end_s >= self.sky.end_s - 1.0 else end_s
        return None

    def reach_start_s(self, at_s: float) -> float | None:
        """Return when it comes into reach next after a time; None: not within the day."""
        starts = (one.start.timestamp() for one in self.reach.intervals)
        return next((start_s for start_s in starts if start_s > at_s), None)

    def horizon_s(self, at_s: float) -> tuple[str, float] | None:
        """Return `rises` or `sets`, and when, for what comes first after a time; None: neither within the day."""
        times, above = self.sky.t_s, self.sky.el_deg - self.horizon_deg
        up = above > 0.0
        for index in np.flatnonzero(up[1:] != up[:-1]).tolist():
            first, last = above[index], above[index + 1]
            crosses_s = float(times[index] + (times[index + 1] - times[index]) * first / (first - last))
            if crosses_s > at_s:
                return ("rises" if up[index + 1] else "sets"), crosses_s
        return None

    @property
    def standing(self) -> str:
        """Whether it is always up, and why not in reach then; empty if the time of day decides."""
        if self.never_up:
            return "never up here"
        if not self.always_up:
            return ""
        if self.always_in_reach:
            return "always up"
        if not self.never_in_reach:
            return ""
        if self.hidden:
            return f"always up, {_joined(self.limits)}"
        return f"always up, out of reach: {_joined(self.limits)}"

    @property
    def hidden(self) -> bool:
        """Whether only the horizon mask is in the way, all day: the dish follows, and nothing is heard."""
        return self.never_in_reach and self.reach.reasons == (LossReason.HORIZON,)


def _joined(words: Sequence[str]) -> str:
    return ", ".join(words)
